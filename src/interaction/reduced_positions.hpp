#pragma once

#include "core/aligned_array.hpp"
#include "core/box.hpp"

namespace lanescape {

// What an interaction needs to work in a unit of length of its own, a power of two (core/length_unit.hpp).
class ReducedPositions {
 public:
  explicit ReducedPositions(double unit) : unit_(unit) {}

  double unit() const { return unit_; }
  Box box(const Box& box) const { return box.in_unit(unit_); }
  // The positions in this unit, valid until the next call. They are not copied where the unit is 1.
  const AlignedArray& of(const AlignedArray& positions) {
    if (unit_ == 1.0) return positions;
    scaled_ = positions;
    for (double& x : scaled_) x /= unit_;
    return scaled_;
  }
  // From 1/unit to the caller's unit.
  void restore(AlignedArray& gradient) const {
    if (unit_ == 1.0) return;
    for (double& g : gradient) g /= unit_;
  }

 private:
  double unit_;
  AlignedArray scaled_;
};

}  // namespace lanescape
