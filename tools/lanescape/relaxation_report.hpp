#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "program.hpp"
#include "run/diffusion_run.hpp"

namespace lanescape::program {

// The options of `diffusion` for what it measures at lags spaced by factors.
struct RelaxationSetup {
  std::string wave_number;
  std::optional<double> overlap_length;
  std::optional<std::uint64_t> records;

  void add_to(Options& options);
  RelaxationOptions resolve() const;
};

// A standard error, or null.
Json error_of(const Estimate& estimate);
// Adds the relaxation of one species to its object.
void add_relaxation(Json& species, const RelaxationAccumulator& relaxation, std::size_t index);
// relaxation.csv, if there is a trajectory.
void write_relaxation(OutputFolder& folder, const RelaxationAccumulator& relaxation, const Mixture& mixture);

}  // namespace lanescape::program
