#pragma once

#include <vector>

#include "configuration/pair_model.hpp"
#include "views.hpp"

namespace lanescape {

// Each species pair's potential as the kernels take it, species x species; lengths in a unit of so many sigma, the nearest image
// only.
std::vector<kernels::PairParameters> pair_parameters(const PairModel& model, double unit = 1.0);

// The same for kernels in mixed precision, whose separations are in `fixed_unit` [sigma].
std::vector<kernels::SinglePairParameters> single_pair_parameters(const std::vector<kernels::PairParameters>& pairs,
                                                                  double fixed_unit);

}  // namespace lanescape
