#pragma once

#include <cstdint>
#include <vector>

#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "core/point.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"
#include "neighbour/half_skin.hpp"

namespace lanescape {

// Two spheres, or a sphere and a periodic image of another.
struct PairGap {
  std::int32_t first, second;  // slots, first < second
  double gap;                  // r - s [sigma]; negative where they overlap
  Point normal;                // unit vector from the first to the second
};

// Gaps of all pairs near contact, along a path of many small steps. A list holds the pairs with a gap below reach + skin and is
// rebuilt as HalfSkin says, so that no pair is missed. In a small box two images of one pair are two pairs.
class GapList {
 public:
  // Reach and skin [sigma] are reduced in boxes with an edge below 2 (reach + skin).
  GapList(HardSphereOverlap& spheres, double reach, double skin);

  // Every pair with a gap below reach() at these positions, and some with a larger one; valid until the next call. Two centres at
  // one place have the normal (1, 0, 0). Throws Error(bad_input) for a coordinate that is not finite.
  const std::vector<PairGap>& at(const AlignedArray& positions);

  double reach() const { return reach_; }
  std::uint64_t rebuilds() const { return rebuilds_; }
  // The positions of the last rebuild: the order of pairs follows from them.
  void exchange(Archive& archive);

 private:
  void rebuild(const AlignedArray& positions);
  void add_images(const AlignedArray& positions, const kernels::SpherePair& pair);

  HardSphereOverlap* spheres_;
  double reach_;
  HalfSkin half_skin_;
  std::uint64_t rebuilds_ = 0;
  std::vector<Point> shifts_;  // of the second sphere to the image that counts
  std::vector<PairGap> gaps_;
};

}  // namespace lanescape
