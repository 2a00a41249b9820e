#pragma once

#include <cstdint>

#include "core/aligned_array.hpp"
#include "dispatch/vector_algebra.hpp"

namespace lanescape {

// Where a path stands: R(t), and the way from there to the goal, R_f - R(t).
struct PathPoint {
  const AlignedArray& position;
  const AlignedArray& to_goal;
  double distance;  // |R_f - R(t)|
};

// How an accepted step was made.
enum class StepKind { direct, detour };

// Trial of a direct step, R + delta (R_f - R)/|R_f - R| ([G] Eq. 3.10).
inline void direct_trial(const VectorAlgebra& algebra, const PathPoint& at, double step, AlignedArray& trial) {
  algebra.axpy(trial, at.position, step / at.distance, at.to_goal);
}

}  // namespace lanescape
