#pragma once

#include <string>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"

namespace lanescape {

// One configuration to check a kernel on, with the model it is evaluated by. No two particles are nearer than 0.7 sigma.
struct PairCase {
  std::string name;
  PairModel model;
  Configuration configuration;
};

// The cases that tests, benchmarks and the program share, always the same: every combination of size (empty, one, odd, lane
// tails), image rule, truncation and mixture at density 1.2, and boxes and pairs on the edges of the algorithm.
std::vector<PairCase> pair_cases();

// The same for any pair potential, fewer: sizes, image rules, every truncation that it allows, two species.
std::vector<PairCase> form_cases(const PairForm& form);
// How results of its kernels are called: its word, with underscores.
std::string name_in_results(const PairForm& form);

}  // namespace lanescape
