#pragma once

#include <string_view>
#include <variant>

#include "configuration/hard_sphere_model.hpp"
#include "configuration/lennard_jones_model.hpp"

namespace lanescape {

// What a name or a model file stands for.
using Model = std::variant<LennardJonesModel, HardSphereModel>;

// "kob-andersen", "lennard-jones", "hard-sphere" or "hard-sphere-binary"; anything else throws Error(bad_input) naming these.
Model named_model(std::string_view name);
const Mixture& mixture_of(const Model& model);

}  // namespace lanescape
