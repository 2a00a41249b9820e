#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/hard_sphere_model.hpp"
#include "configuration/model.hpp"
#include "core/decimated_trace.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/end_points.hpp"
#include "dynamics/hard_end_points.hpp"
#include "dynamics/hard_sphere_start.hpp"
#include "observables/radial_distribution.hpp"
#include "run/configuration_pair.hpp"
#include "run/run_loop.hpp"

namespace lanescape {

struct EndPointRunResult {
  bool done = false, interrupted = false;
  std::string ended_as;  // the phase it ended in
  std::vector<ConfigurationPair> pairs{};
  std::vector<double> pair_seconds{};  // computing time from start to finish of each pair, as its steps
  double temperature = 0.0;            // soft: mean since equilibrium, 3N convention
  double compressibility = 0.0;        // hard: Z since equilibrium, 3N - 3 convention
  double seconds = 0.0;
  std::vector<std::string> trace_columns;  // the last one is a phase
  DecimatedTrace trace;
  std::vector<std::string> phase_names{};
  RadialDistribution radial_distribution;
};

// Runs molecular dynamics from `start` to as many end-point pairs as asked for. Bit-identical for a given seed and instruction
// set, interrupted and resumed or not. Throws Error(bad_input) for impossible options, overlapping particles or hard spheres.
EndPointRunResult run_end_points(const AnyModel& model, const Configuration& start, const EndPointOptions& options, Isa isa,
                                 const CheckpointOptions& checkpoint, RunMonitor& monitor);
// The same for hard spheres by event-driven dynamics; `start` has radii and no overlaps.
EndPointRunResult run_hard_end_points(const HardSphereModel& model, const Configuration& start, const HardEndPointOptions& options,
                                      Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor);

}  // namespace lanescape
