#pragma once

#include <lanescape/model.hpp>

#include <cstddef>
#include <string>
#include <vector>

#include "configuration/pair_model.hpp"

namespace lanescape {

// The pair model in a host's model. Throws Error(bad_input), naming what needs it, for models of another kind.
const PairModel& pair_model(const Model& model, const char* user);
// Throws Error(bad_input) unless one diameter is given for each particle of a model that has them, and none for another model.
void check_diameters(const std::string& model, bool has_diameters, std::size_t given, std::size_t particles);
// Diameters as they were given, checked.
const std::vector<double>& checked_diameters(const PairModel& model, const std::vector<double>& given, std::size_t particles);

}  // namespace lanescape
