#pragma once

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"

namespace lanescape {

// Throws Error(bad_input) naming the closest pair if any two particles are nearer than PairForm::smallest_separation, or the
// coordinate that is not finite. O(N).
void check_separations(const Configuration& configuration, const PairModel& model);

}  // namespace lanescape
