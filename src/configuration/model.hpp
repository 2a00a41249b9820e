#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "configuration/hard_sphere_model.hpp"
#include "configuration/pair_model.hpp"
#include "configuration/state_mixture_model.hpp"

namespace lanescape {

// The model behind a name or a model file.
using AnyModel = std::variant<PairModel, HardSphereModel, StateMixtureModel>;

// The names of all there are.
std::vector<std::string> known_models();
// The model of a name; any other throws Error(bad_input) naming all there are.
AnyModel named_model(std::string_view name);
const Mixture& mixture_of(const AnyModel& model);
// The largest sigma or diameter [sigma].
double largest_size(const AnyModel& model);
// In which lengths that users leave to the library are given (core/length_unit.hpp) [sigma].
double length_unit(const AnyModel& model);

}  // namespace lanescape
