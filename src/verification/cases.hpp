#pragma once

#include <string>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"

namespace lanescape {

// A configuration to check a kernel on, with the model to evaluate it by. No two particles are closer than 0.7 sigma.
struct PairCase {
  std::string name;
  PairModel model;
  Configuration configuration;
};

// The fixed cases that tests, benchmarks and the program share: every combination of size (empty, one, odd, lane tails), image
// rule, truncation and mixture at density 1.2, and boxes and pairs at the limits of the algorithm.
std::vector<PairCase> pair_cases();

// Fewer cases of the same kind for any pair potential: sizes, image rules, every truncation that it allows, two species.
std::vector<PairCase> form_cases(const PairForm& form);
// Slabs and clusters in vacuum: boxes with one to three open axes, edges down to a fraction of the cutoff, particles outside the
// faces.
std::vector<PairCase> open_cases(const PairForm& form);
// These of the form of the cases, and then the cases.
std::vector<PairCase> with_open_cases(const std::vector<PairCase>& cases);
// Liquids in boxes that clusters need, from single particles to some hundred; none for a form with diameters.
std::vector<PairCase> cluster_cases(const PairForm& form);
// pair_cases() and form_cases() of all pair potentials: what kernels of hosts are checked on. Names are unique.
std::vector<PairCase> all_pair_cases();
// Prefix of the names of its kernels' results: its keyword, with underscores.
std::string name_in_results(const PairForm& form);

}  // namespace lanescape
