#pragma once

#include "insert_options.hpp"
#include "program.hpp"

namespace lanescape::program {

// The options of all three modes of `insert`.
struct InsertState {
  CommonOptions common;
  SystemOptions system;
  InsertionSetup setup;
  std::string file;
  std::uint64_t count = 1, remove = 0;
  std::string removal = "random";
  std::optional<double> temperature, density;
  double diameter = 1.0;
  std::uint64_t particles = 1000, equilibration_steps = 10'000;
  double time_step = 0.002;
  std::optional<double> densify;
  double rate = 0.005;
  std::uint64_t rows = 40;
  bool scan = false, plot = false;
  std::string states = "0.4:2.5,0.5:2.5,0.6:2.5,0.7:2.5,0.8:2.5", methods = "usher", tolerances, largest_steps = "default",
              iso_energies = "0";
  std::uint64_t configurations = 5, between_steps = 2000, widom_probes = 0, holes = 0, traced_searches = 0, map_points = 0;
};

// Run --densify and --scan; return the JSON for stdout.
Json run_growth(InsertState& state, const Options& options, const PairModel& model, Isa isa, int& status);
Json run_scan(InsertState& state, const Options& options, const PairModel& model, Isa isa, int& status);

}  // namespace lanescape::program
