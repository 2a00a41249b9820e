#include "landscape/contact_landscape.hpp"

#include <algorithm>
#include <utility>

namespace lanescape {

ContactLandscape::ContactLandscape(const Box& box, const ParticleLayout& layout, const std::vector<double>& radii,
                                   KinematicMetric metric, Isa isa, double reach, double skin)
    : algebra_(kernel_table(isa)),
      metric_(std::move(metric)),
      positions_(layout.dimension()),
      inverse_masses_(metric_.inverse_masses(layout)),
      spheres_(box, layout, radii, kernel_table(isa)),
      list_(spheres_, reach, skin) {}

const AlignedArray& ContactLandscape::positions(const AlignedArray& q) {
  if (metric_.is_euclidean()) return q;
  positions_ = q;
  metric_.to_positions(positions_);
  return positions_;
}

const std::vector<PairGap>& ContactLandscape::gaps(const AlignedArray& q) { return list_.at(positions(q)); }

double ContactLandscape::violation(const AlignedArray& q) { return std::max(0.0, -spheres_.smallest_gap(positions(q))); }

}  // namespace lanescape
