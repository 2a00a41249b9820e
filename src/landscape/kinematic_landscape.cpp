#include "landscape/kinematic_landscape.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {

KinematicMetric::KinematicMetric(const Mixture& model, const ParticleLayout& layout) {
  if (model.has_equal_masses()) return;
  double total = 0.0;
  for (std::size_t s = 0; s < layout.blocks().size(); ++s)
    total += model.species[s].mass * static_cast<double>(layout.blocks()[s].count);
  const double mean = total / static_cast<double>(layout.size());
  scale_.assign(layout.dimension(), 1.0);
  for (std::size_t s = 0; s < layout.blocks().size(); ++s)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto first = scale_.begin() + static_cast<std::ptrdiff_t>(axis * layout.slots() + layout.blocks()[s].begin);
      std::fill_n(first, layout.blocks()[s].count, std::sqrt(model.species[s].mass / mean));
    }
}

AlignedArray KinematicMetric::coordinates(const ParticleLayout& layout, std::span<const double> positions) const {
  AlignedArray q = layout.to_slots(positions);
  to_kinematic(q);
  return q;
}

void KinematicMetric::to_kinematic(AlignedArray& positions) const {
  for (std::size_t k = 0; k < scale_.size(); ++k) positions[k] *= scale_[k];
}

void KinematicMetric::to_positions(AlignedArray& q) const {
  for (std::size_t k = 0; k < scale_.size(); ++k) q[k] /= scale_[k];
}

AlignedArray KinematicMetric::inverse_masses(const ParticleLayout& layout) const {
  AlignedArray scale(layout.dimension(), 1.0);
  to_positions(scale);
  scale.resize(layout.slots());
  for (double& x : scale) x *= x;
  return scale;
}

KinematicLandscape::KinematicLandscape(std::unique_ptr<SoftLandscape> inner, KinematicMetric metric)
    : inner_(std::move(inner)), metric_(std::move(metric)) {}

const AlignedArray& KinematicLandscape::position_of(const AlignedArray& q) {
  position_ = q;
  metric_.to_positions(position_);
  return position_;
}

double KinematicLandscape::energy(const AlignedArray& q) { return inner_->energy(position_of(q)); }

double KinematicLandscape::energy_and_gradient(const AlignedArray& q, AlignedArray& gradient) {
  const double v = inner_->energy_and_gradient(position_of(q), gradient);
  metric_.gradient_to_kinematic(gradient);
  return v;
}

void KinematicLandscape::gradient(const AlignedArray& q, AlignedArray& gradient) {
  inner_->gradient(position_of(q), gradient);
  metric_.gradient_to_kinematic(gradient);
}

}  // namespace lanescape
