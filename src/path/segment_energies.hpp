#pragma once

#include <cstddef>
#include <vector>

#include "core/aligned_array.hpp"
#include "landscape/soft_landscape.hpp"

namespace lanescape {

// V along straight segments, from energies at equally spaced points between their ends and at the top of the parabola through the
// highest of them.
class SegmentEnergies {
 public:
  // `samples` inside a segment, at least 2.
  SegmentEnergies(SoftLandscape& landscape, std::size_t samples)
      : landscape_(&landscape), energies_(samples + 2), chord_(landscape.dimension(), 0.0), position_(chord_) {}

  // The largest V on the segment between two points of known V; infinity where V is not finite.
  double largest(const AlignedArray& begin, double begin_energy, const AlignedArray& end, double end_energy);

 private:
  double energy_at(const AlignedArray& begin, double fraction);
  double offset_of_vertex(std::size_t s) const;

  SoftLandscape* landscape_;
  std::vector<double> energies_;
  AlignedArray chord_, position_;
};

}  // namespace lanescape
