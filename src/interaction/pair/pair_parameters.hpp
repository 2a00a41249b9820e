#pragma once

#include <vector>

#include "configuration/pair_model.hpp"
#include "views.hpp"

namespace lanescape {

// Each species pair's potential as the kernels take it, species x species [sigma]; the nearest image only.
std::vector<kernels::LjPair> pair_parameters(const PairModel& model);

}  // namespace lanescape
