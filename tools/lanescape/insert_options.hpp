#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "insertion/insertion.hpp"
#include "program.hpp"

namespace lanescape::program {

// Options of the searches, the same for insertion into a file, scans and growth.
struct InsertionSetup {
  std::string energy = "mean";
  double tolerance = 0.01, clear_energy = 60.0;
  std::string measure = "relative", method = "usher", wall = "reflect", region, species;
  std::optional<double> largest_step, traverse_step;
  std::optional<std::uint64_t> most_iterations;
  std::uint64_t most_trials = 10'000;

  void add_to(Options& options);
  // Everything but the target. The region is checked later, in its box.
  InsertionOptions resolve(std::uint64_t seed) const;
  // Index of --species, by default the first.
  int species_index(const Mixture& mixture) const;
  // The number of --energy; empty for one of the allowed words.
  std::optional<double> number(const std::vector<std::string_view>& words) const;
};

}  // namespace lanescape::program
