#pragma once

#include <cstdint>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/lennard_jones_model.hpp"
#include "core/decimated_trace.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/end_points.hpp"
#include "observables/radial_distribution.hpp"
#include "run/checkpoint.hpp"

namespace lanescape {

// One pair as its user sees it: both ends unwrapped, in the user's order.
struct ConfigurationPair {
  Configuration start, finish;
  double distance = 0.0;    // [sigma]
  std::uint64_t steps = 0;  // of molecular dynamics between the two; 0 if not known
};

struct EndPointRunResult {
  EndPointGenerator::Phase phase;  // done, or where it ended
  bool interrupted = false;
  std::vector<ConfigurationPair> pairs;
  std::vector<double> pair_seconds;  // computing time since the pair before, equilibration included
  double temperature = 0.0;          // mean since equilibrium, 3N convention
  double seconds = 0.0;
  DecimatedTrace trace;  // step, temperature, potential energy per particle, total energy per particle, phase
  RadialDistribution radial_distribution;
};

// Runs molecular dynamics from `start` to as many end-point pairs as asked for. Bit-identical for a given seed and instruction
// set, interrupted and resumed or not. Throws Error(bad_input) for impossible options or overlapping particles.
EndPointRunResult run_end_points(const LennardJonesModel& model, const Configuration& start, const EndPointOptions& options,
                                 Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor);

}  // namespace lanescape
