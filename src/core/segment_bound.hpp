#pragma once

#include "core/aligned_array.hpp"

namespace lanescape {

// By how much V can fall short of its tangent on a segment: for every unit vector u and every s up to the longest segment,
// V(R + s u) >= V(R) + s u.grad V(R) - slope s - curvature s^2/2 - rounding, for V and grad V as they are evaluated.
struct SegmentLoss {
  double slope;      // from jumps of the slope [epsilon/sigma]
  double curvature;  // [epsilon/sigma^2]
  double rounding;   // of two evaluations [epsilon]
};

// Bounds of a potential energy near a configuration, at about the cost of a few evaluations. They have no hidden state.
class SegmentBound {
 public:
  virtual ~SegmentBound() = default;

  // How far two particles may have moved relative to each other since `centre`, the far end of the segment included [sigma].
  virtual double reach() const = 0;
  // Holds for all segments within reach of `centre`; infinite where there is no bound.
  virtual SegmentLoss around(const AlignedArray& centre) = 0;
};

}  // namespace lanescape
