#include "landscape/contact_landscape.hpp"

#include <algorithm>
#include <utility>

namespace lanescape {

ContactLandscape::ContactLandscape(const Box& box, const ParticleLayout& layout, const std::vector<double>& radii,
                                   KinematicMetric metric, Isa isa, double reach, double skin)
    : algebra_(kernel_table(isa)),
      metric_(std::move(metric)),
      positions_(layout.dimension(), 1.0),
      spheres_(box, layout, radii, kernel_table(isa)),
      list_(spheres_, reach, skin) {
  metric_.to_positions(positions_);  // 1/sqrt(m/<m>)
  inverse_masses_.assign(positions_.begin(), positions_.begin() + static_cast<std::ptrdiff_t>(layout.slots()));
  for (double& inverse : inverse_masses_) inverse *= inverse;
}

const AlignedArray& ContactLandscape::positions(const AlignedArray& q) {
  if (metric_.is_euclidean()) return q;
  positions_ = q;
  metric_.to_positions(positions_);
  return positions_;
}

const std::vector<PairGap>& ContactLandscape::gaps(const AlignedArray& q) { return list_.at(positions(q)); }

double ContactLandscape::violation(const AlignedArray& q) { return std::max(0.0, -spheres_.smallest_gap(positions(q))); }

}  // namespace lanescape
