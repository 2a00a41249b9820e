#include "landscape/kinematic_landscape.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {

KinematicLandscape::KinematicLandscape(std::unique_ptr<SoftLandscape> inner, AlignedArray scale)
    : inner_(std::move(inner)), scale_(std::move(scale)), position_(scale_.size(), 0.0) {}

const AlignedArray& KinematicLandscape::to_positions(const AlignedArray& q) {
  for (std::size_t k = 0; k < q.size(); ++k) position_[k] = q[k] / scale_[k];
  return position_;
}

double KinematicLandscape::energy(const AlignedArray& q) { return inner_->energy(to_positions(q)); }

double KinematicLandscape::energy_and_gradient(const AlignedArray& q, AlignedArray& gradient) {
  const double v = inner_->energy_and_gradient(to_positions(q), gradient);
  for (std::size_t k = 0; k < gradient.size(); ++k) gradient[k] /= scale_[k];
  return v;
}

AlignedArray kinematic_scale(const LennardJonesModel& model, const ParticleLayout& layout) {
  double total = 0.0;
  for (std::size_t s = 0; s < layout.blocks().size(); ++s)
    total += model.species[s].mass * static_cast<double>(layout.blocks()[s].count);
  const double mean = total / static_cast<double>(layout.size());
  AlignedArray scale(layout.dimension(), 1.0);
  for (std::size_t s = 0; s < layout.blocks().size(); ++s)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto first = scale.begin() + static_cast<std::ptrdiff_t>(axis * layout.slots() + layout.blocks()[s].begin);
      std::fill_n(first, layout.blocks()[s].count, std::sqrt(model.species[s].mass / mean));
    }
  return scale;
}

bool has_equal_masses(const LennardJonesModel& model) {
  return std::all_of(model.species.begin(), model.species.end(),
                     [&](const Species& s) { return s.mass == model.species.front().mass; });
}

}  // namespace lanescape
