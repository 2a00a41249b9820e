#pragma once

#include <string>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/state_mixture_model.hpp"

namespace lanescape {

struct StateMixtureCase {
  std::string name;
  StateMixtureModel model;
  Configuration configuration;
};

// Options of the model in these cases.
struct StateMixtureVariant {
  enum class Filter { every, own, cross, asymmetric };
  enum class Potentials { lennard_jones, tables, both };

  std::size_t species = 1, states = 2;
  Filter filter = Filter::every;
  Potentials potentials = Potentials::lennard_jones;
  double entropy_temperature = 0.0;
  bool saturated = false;  // far below every threshold
};
StateMixtureModel state_mixture_model(const StateMixtureVariant& variant, double cutoff = 2.5);
std::string describe(const StateMixtureVariant& variant);

// A jittered simple cubic lattice at density 0.8, cut to n particles, species one after the other; no two closer than 0.8 sigma.
Configuration state_mixture_fluid(std::size_t n, std::size_t species, double density = 0.8);

// Fixed cases: every size that leaves a remainder in vectors and in groups of four states, every filter, one to five states, one to
// three species, both kinds of potential, boxes of any shape down to a fraction of the cutoff.
std::vector<StateMixtureCase> state_mixture_cases();

}  // namespace lanescape
