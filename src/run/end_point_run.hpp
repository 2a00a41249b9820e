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
#include "run/checkpoint.hpp"

namespace lanescape {

// One pair as its user sees it: both ends unwrapped, in the user's order.
struct ConfigurationPair {
  Configuration start, finish;
  double distance = 0.0;       // [sigma]
  std::uint64_t steps = 0;     // of molecular dynamics between the two, or collisions; 0 if not known
  double time = 0.0;           // likewise
  double radius_factor = 1.0;  // by which radii of a file were scaled, where its rounding made spheres overlap
};

struct EndPointRunResult {
  bool done = false, interrupted = false;
  std::string ended_as;  // the phase it ended in
  std::vector<ConfigurationPair> pairs{};
  std::vector<double> pair_seconds{};  // computing time since the pair before, equilibration included
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
EndPointRunResult run_end_points(const Model& model, const Configuration& start, const EndPointOptions& options,
                                 Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor);
// The same for hard spheres by event-driven dynamics; `start` has radii and no overlaps.
EndPointRunResult run_hard_end_points(const HardSphereModel& model, const Configuration& start, const HardEndPointOptions& options,
                                      Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor);

}  // namespace lanescape
