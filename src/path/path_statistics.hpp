#pragma once

#include <cstdint>

#include "core/archive.hpp"
#include "views.hpp"

namespace lanescape {

// What is summed along a path, in constant memory.
class PathStatistics {
 public:
  // One displacement, the accepted steps and the last hop alike.
  void add(const kernels::DisplacementMoments& moments);

  double length() const { return length_; }
  // Mean over displacements, weighted with their length, of n = (sum dr^2)^2 / sum dr^4 ([G] Eq. 4.17).
  double participation_number() const { return length_ > 0.0 ? weighted_participation_ / length_ : 0.0; }
  // Of the last displacement.
  double last_participation_number() const { return last_participation_; }

  void exchange(Archive& archive);

 private:
  double length_ = 0.0, weighted_participation_ = 0.0, last_participation_ = 0.0;
};

}  // namespace lanescape
