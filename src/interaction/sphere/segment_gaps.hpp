#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/aligned_array.hpp"
#include "core/box.hpp"
#include "core/point.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"

namespace lanescape {

// The closest approach of two spheres, through one periodic image, while all move along straight lines.
struct Approach {
  std::int32_t first, second;         // slots, first < second
  std::array<std::int32_t, 3> image;  // in edges, added to the plain separation r_second - r_first
  double fraction;                    // of the move, 0 to 1
  double gap;                         // r_ij - s_ij there [sigma]
  Point separation;                   // r_second - r_first there, of this image [sigma]
};

// r_second - r_first at these positions, of the same image.
Point separation_at(const AlignedArray& positions, const Approach& pair, const Box& box);

// Closest approaches along straight moves from one configuration to another: linear relative motion, solved exactly for all pairs
// and all periodic images, even of moves longer than the box. The overlap object is its scratch memory.
class SegmentGaps {
 public:
  explicit SegmentGaps(HardSphereOverlap& spheres) : spheres_(&spheres) {}

  // All approaches with a gap below `reach` [sigma], valid until the next call. Throws Error(bad_input) for a coordinate that is
  // not finite.
  const std::vector<Approach>& below(const AlignedArray& from, const AlignedArray& to, double reach);

 private:
  void add_images(const kernels::SpherePair& pair, const AlignedArray& from, const AlignedArray& to, double reach);

  HardSphereOverlap* spheres_;
  AlignedArray middle_;
  std::vector<Approach> approaches_;
};

}  // namespace lanescape
