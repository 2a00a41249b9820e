#include "interaction/hard_sphere.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace lanescape {
namespace {

constexpr std::size_t float_padding = 16;  // of the widest single-precision vectors

std::size_t padded(std::size_t n, std::size_t unit) { return (n + unit - 1) / unit * unit; }

}  // namespace

HardSphereOverlap::HardSphereOverlap(const Box& box, const ParticleLayout& layout, const std::vector<double>& radii,
                                     const kernels::KernelTable& table)
    : table_(&table),
      box_(box),
      radii_(layout.per_slot(radii, std::numeric_limits<double>::quiet_NaN())),
      fractions_(3 * padded(layout.slots(), float_padding)),
      reaches_(padded(layout.slots(), float_padding)),
      pairs_(16 * layout.size() + 16) {}

kernels::SphereInput HardSphereOverlap::input(const AlignedArray& positions) {
  return {positions.data(),  radii_.data(),   radii_.size(),  {box_.length[0], box_.length[1], box_.length[2]},
          fractions_.data(), reaches_.data(), reaches_.size()};
}

const std::vector<kernels::SpherePair>& HardSphereOverlap::pairs_within(const AlignedArray& positions, double reach) {
  pairs_.resize(pairs_.capacity());
  std::size_t count = table_->sphere_pairs_within(input(positions), reach, pairs_.data(), pairs_.size());
  if (count > pairs_.size()) {
    pairs_.resize(2 * count);
    count = table_->sphere_pairs_within(input(positions), reach, pairs_.data(), pairs_.size());
  }
  pairs_.resize(count);
  return pairs_;
}

HardSphereList::HardSphereList(HardSphereOverlap& spheres, double skin) : spheres_(&spheres) {
  // Of each pair the list knows one image. Another one is at least half a box away when the list is made and comes nearer by less
  // than the skin: it must not reach contact before the list is made anew.
  double largest = 0.0;
  for (const double radius : spheres.radii())
    if (radius > largest) largest = radius;
  skin_ = std::max(0.0, std::min(skin, 0.5 * spheres.box().shortest() - 2.0 * largest));
}

void HardSphereList::renew_where_due(const AlignedArray& positions) {
  const std::size_t slots = positions.size() / 3;
  // A little less than half the skin: the displacement is rounded too.
  const double allowed = 0.499 * skin_;
  if (made_at_.empty() ||
      !(spheres_->table().largest_displacement_squared(made_at_.data(), positions.data(), slots, 0, slots) <= allowed * allowed))
    rebuild(positions);
}

void HardSphereList::rebuild(const AlignedArray& positions) {
  ++rebuilds_;
  made_at_ = positions;
  const auto& pairs = spheres_->pairs_within(positions, skin_);
  const AlignedArray& radii = spheres_->radii();
  const std::size_t slots = radii.size(), count = padded(pairs.size(), kernels::slot_padding);
  if (first_.empty() || first_.size() < count) {
    const std::size_t room = 2 * count + kernels::slot_padding;
    for (auto* array : {&first_, &second_}) array->resize(room);
    for (auto* arrays : {&shift_, &separation_, &force_})
      for (AlignedArray& array : *arrays) array.resize(room);
    for (auto* array : {&contact_, &squared_}) array->resize(room);
    places_.resize(room + 2 * kernels::slot_padding);
    list_ = {first_.data(), second_.data(), shift_[0].data(), shift_[1].data(), shift_[2].data(), contact_.data(), 0};
    contacts_ = {places_.data(),  separation_[0].data(), separation_[1].data(), separation_[2].data(),
                 squared_.data(), force_[0].data(),      force_[1].data(),      force_[2].data()};
  }
  list_.count = count;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto i = static_cast<std::size_t>(pairs[k].first), j = static_cast<std::size_t>(pairs[k].second);
    first_[k] = pairs[k].first;
    second_[k] = pairs[k].second;
    contact_[k] = radii[i] + radii[j];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double length = spheres_->box().length[axis];
      shift_[axis][k] = length * std::nearbyint((positions[axis * slots + j] - positions[axis * slots + i]) / length);
    }
  }
  for (std::size_t k = pairs.size(); k < count; ++k) {
    first_[k] = second_[k] = 0;
    contact_[k] = std::numeric_limits<double>::quiet_NaN();
    for (auto& shift : shift_) shift[k] = 0.0;
  }
}

bool HardSphereList::any_overlap(const AlignedArray& positions) {
  renew_where_due(positions);
  return spheres_->table().sphere_list_any_overlap(list_, positions.data(), positions.size() / 3);
}

ContactPairs HardSphereList::find_contacts(const AlignedArray& positions) {
  renew_where_due(positions);
  contact_count_ = spheres_->table().sphere_list_contacts(list_, positions.data(), positions.size() / 3, contacts_);
  return {places_.data(), first_.data(), second_.data(), contact_count_};
}

void HardSphereList::add_contact_forces(kernels::ContactPotential potential, AlignedArray& force) {
  spheres_->table().sphere_contact_forces(list_, contacts_, contact_count_, potential, force.data(), force.size() / 3);
}

double sphere_gap(const Configuration& configuration, std::size_t i, std::size_t j) {
  std::array<double, 3> d{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    d[axis] = configuration.box.nearest_image(axis, configuration.positions[3 * j + axis] - configuration.positions[3 * i + axis]);
  return std::sqrt((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]) - (configuration.radii[i] + configuration.radii[j]);
}

void check_box_holds_spheres(const Configuration& configuration) {
  const double largest = 2.0 * *std::max_element(configuration.radii.begin(), configuration.radii.end());
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!(configuration.box.length[axis] >= 2.0 * largest))
      throw_bad_input(fmt::format("box edge {} along axis {} is not allowed: at least twice the largest diameter {} is needed",
                                  configuration.box.length[axis], axis + 1, largest));
}

void check_no_overlap(const Configuration& configuration, const kernels::KernelTable& table) {
  check_box_holds_spheres(configuration);
  // One species: slots are particles.
  const ParticleLayout layout(std::vector<int>(configuration.size(), 0), 1);
  HardSphereOverlap spheres(configuration.box, layout, configuration.radii, table);
  const auto& pairs = spheres.pairs_within(layout.to_slots(configuration.positions), 0.0);
  if (pairs.empty()) return;
  const auto gap = [&](const kernels::SpherePair& pair) {
    return sphere_gap(configuration, static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second));
  };
  const auto deepest = *std::min_element(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) { return gap(a) < gap(b); });
  throw_bad_input(fmt::format("particles {} and {} overlap by {}: spheres may touch but not overlap ({} such pairs)", deepest.first,
                              deepest.second, -gap(deepest), pairs.size()));
}

}  // namespace lanescape
