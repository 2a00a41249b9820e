#pragma once

#include <string>

#include "configuration/model.hpp"
#include "io/toml_reader.hpp"

// One reader and one writer for each kind of model; each pair stands in a file of its own.
namespace lanescape {

PairModel read_pair_model(const TomlReader& toml, const PairForm& form, const std::string& name);
HardSphereModel read_hard_sphere_model(const TomlReader& toml, const std::string& name);
StateMixtureModel read_state_mixture_model(const TomlReader& toml, const std::string& name);

std::string to_toml(const PairModel& model);
std::string to_toml(const HardSphereModel& model);
std::string to_toml(const StateMixtureModel& model);

}  // namespace lanescape
