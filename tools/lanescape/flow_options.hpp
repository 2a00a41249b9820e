#pragma once

#include <optional>
#include <string>

#include "flow/continuum_outside.hpp"
#include "insert_options.hpp"
#include "program.hpp"
#include "run/flow_run.hpp"

namespace lanescape::program {

// The options of `flow`.
struct FlowSetup {
  FlowSetup() { system.model = "lennard-jones"; }

  CommonOptions common;
  SystemOptions system;
  InsertionSetup insertion;
  FlowOptions flow;
  std::string file, outside = "constant", enthalpy = "fluid", removal = "least-disturbance";
  double density = 0.5, length = 60.0, width = 12.0;
  ContinuumOptions continuum;
  Pulse pulse{0.0, -30.0, 8.0};
  bool plot = false;

  void add_to(Options& options);
  RunKinds kinds(const PairModel& model) const;
  // The particles of the start: of FILE, or on a lattice.
  Configuration start(const PairModel& model) const;
  // Completes and checks the options of the run.
  FlowOptions resolve_flow(const PairModel& model, const Configuration& start, Isa isa) const;
  // Those of the continuum, if that is the outside.
  std::optional<ContinuumOptions> resolve_continuum(const PairModel& model, const FlowOptions& with,
                                                    const Configuration& start) const;
};

}  // namespace lanescape::program
