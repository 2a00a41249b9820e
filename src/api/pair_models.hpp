#pragma once

#include <lanescape/model.hpp>

#include <cstddef>
#include <vector>

#include "configuration/pair_model.hpp"

namespace lanescape {

// The pair model in a host's model. Throws Error(bad_input), naming what needs it, for models of another kind.
const PairModel& pair_model(const Model& model, const char* user);
// Diameters as they were given: one per particle for models that have them, else none; Error(bad_input) otherwise.
const std::vector<double>& checked_diameters(const PairModel& model, const std::vector<double>& given, std::size_t particles);

}  // namespace lanescape
