#pragma once

#include "dispatch/vector_algebra.hpp"
#include "stepper/stepper.hpp"

namespace lanescape {

// Trial of a direct step, R + delta (R_f - R)/|R_f - R| ([G] Eq. 3.10).
inline void direct_trial(const VectorAlgebra& algebra, const PathPoint& at, double step, AlignedArray& trial) {
  algebra.axpy(trial, at.position, step / at.distance, at.to_goal);
}

}  // namespace lanescape
