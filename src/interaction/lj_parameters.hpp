#pragma once

#include <vector>

#include "configuration/lennard_jones_model.hpp"
#include "views.hpp"

namespace lanescape {

// Each species pair's potential as the kernels take it, species x species [sigma]; the nearest image only.
std::vector<kernels::LjPair> lj_parameters(const LennardJonesModel& model);

}  // namespace lanescape
