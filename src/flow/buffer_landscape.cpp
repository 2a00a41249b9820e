#include "flow/buffer_landscape.hpp"

#include <algorithm>

namespace lanescape {

BufferLandscape::BufferLandscape(PairLandscape& pairs, const ParticleLayout& layout, const SlabGeometry& geometry,
                                 const Outside::Demands& demands, double mass, double time_step)
    : pairs_(&pairs),
      count_(layout.size()),
      slots_(layout.slots()),
      geometry_(geometry),
      mass_(mass),
      time_step_(time_step),
      ranges_((slots_ + slot_range - 1) / slot_range),
      passages_(geometry.slices),
      forces_across_(geometry.slices, 0.0) {
  for (std::size_t face = 0; face < 2; ++face) {
    const double inwards = face == 0 ? 1.0 : -1.0, area = geometry.area;
    sheared_ = sheared_ || demands[face].shear[0] != 0.0 || demands[face].shear[1] != 0.0;
    total_[face] = {inwards * demands[face].pressure * area, demands[face].shear[0] * area, demands[face].shear[1] * area};
  }
}

template <class Visit>
void BufferLandscape::for_each_range(Visit visit) {
  pairs_->algebra().for_all_slots(slots_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t at = begin; at < end; at += slot_range) visit(at / slot_range);
  });
}

void BufferLandscape::find_bearers(const AlignedArray& position, std::size_t range) {
  Range& found = ranges_[range];
  for (auto& bearers : found.bearers) bearers.clear();
  found.passing.clear();
  const double low = geometry_.buffer, high = geometry_.length - geometry_.buffer, per_width = 1.0 / geometry_.slice_width();
  const std::size_t begin = range * slot_range, end = std::min(begin + slot_range, count_);
  for (std::size_t slot = begin; slot < end; ++slot) {
    const double x = position[slot];
    if (x < low) found.bearers[0].push_back({static_cast<std::uint32_t>(slot), geometry_.weight(0, x), {}});
    if (x > high) found.bearers[1].push_back({static_cast<std::uint32_t>(slot), geometry_.weight(1, x), {}});
    // Both are far below 2^31.
    if (static_cast<int>(x * per_width) != static_cast<int>(before_[slot] * per_width))
      found.passing.push_back(static_cast<std::uint32_t>(slot));
  }
}

void BufferLandscape::share_forces(AlignedArray& gradient) {
  for (std::size_t face = 0; face < 2; ++face) {
    double sum = 0.0;
    for (const Range& range : ranges_)
      for (const Bearer& bearer : range.bearers[face]) sum += bearer.weight;
    if (!(sum > 0.0)) {
      emptied_ = true;
      continue;
    }
    for (Range& range : ranges_)
      for (Bearer& bearer : range.bearers[face])
        for (std::size_t axis = 0; axis < 3; ++axis) {
          bearer.force[axis] = total_[face][axis] * (bearer.weight / sum);
          gradient[axis * slots_ + bearer.slot] -= bearer.force[axis];
        }
  }
}

// The integrator gives a particle half of the force at either end of a step, so that this is the work it does up to the
// integrator's own error.
void BufferLandscape::add_half_of_work(const AlignedArray& position) {
  for (std::size_t face = 0; face < 2; ++face) {
    const double into_slab = face == 0 ? 1.0 : -1.0;
    FaceReport& report = reports_[face];
    for (const Range& range : ranges_)
      for (const Bearer& bearer : range.bearers[face])
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::size_t k = axis * slots_ + bearer.slot;
          report.energy += into_slab * 0.5 * bearer.force[axis] * (position[k] - before_[k]);
          report.impulse[axis] += into_slab * 0.5 * time_step_ * bearer.force[axis];
        }
    report.momentum = report.impulse;
  }
}

void BufferLandscape::count_passages(const AlignedArray& position) {
  const double per_width = 1.0 / geometry_.slice_width();
  const auto last = static_cast<int>(geometry_.slices);
  for (const Range& range : ranges_)
    for (const std::uint32_t slot : range.passing) {
      const double moved = position[slot] - before_[slot];
      const int plane = static_cast<int>(std::max(position[slot], before_[slot]) * per_width) - 1;
      if (plane < 0 || plane >= last) continue;
      passages_.particles[static_cast<std::size_t>(plane)] += moved > 0.0 ? 1.0 : -1.0;
      passages_.momentum[static_cast<std::size_t>(plane)] += mass_ * std::abs(moved) / time_step_;
    }
}

// Forces between the particles before a plane cancel in their sum.
void BufferLandscape::sum_forces_across(const AlignedArray& position, const AlignedArray& gradient) {
  std::fill(forces_across_.begin(), forces_across_.end(), 0.0);
  for (std::size_t slot = 0; slot < count_; ++slot) forces_across_[geometry_.slice_of(position[slot])] += gradient[slot];
  for (std::size_t plane = 1; plane < forces_across_.size(); ++plane) forces_across_[plane] += forces_across_[plane - 1];
}

double BufferLandscape::energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) {
  const double energy = pairs_->energy_and_gradient(position, gradient);
  sum_forces_across(position, gradient);
  before_ = position;
  for_each_range([&](std::size_t range) { find_bearers(position, range); });
  share_forces(gradient);
  return energy;
}

void BufferLandscape::gradient_after(const SlotWork& move, const AlignedArray& position, AlignedArray& gradient) {
  pairs_->gradient_after(move, position, gradient);
  add_half_of_work(position);
  for_each_range([&](std::size_t range) { find_bearers(position, range); });
  share_forces(gradient);
  add_half_of_work(position);
  count_passages(position);
  for_each_range([&](std::size_t range) {
    const std::size_t begin = range * slot_range, end = std::min(begin + slot_range, count_);
    // y and z matter to the work of shear alone.
    for (std::size_t axis = 0; axis < (sheared_ ? 3U : 1U); ++axis)
      std::copy(position.begin() + static_cast<std::ptrdiff_t>(axis * slots_ + begin),
                position.begin() + static_cast<std::ptrdiff_t>(axis * slots_ + end),
                before_.begin() + static_cast<std::ptrdiff_t>(axis * slots_ + begin));
  });
}

Point BufferLandscape::force(std::size_t face) const {
  Point sum{};
  for (const Range& range : ranges_)
    for (const Bearer& bearer : range.bearers[face])
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += bearer.force[axis];
  return sum;
}

}  // namespace lanescape
