#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"
#include "flow/constant_outside.hpp"
#include "flow/open_slab.hpp"
#include "observables/statistics.hpp"
#include "run/run_loop.hpp"

namespace lanescape {

// A fluid that flows through a slab with open faces ([U] IV.B, figure 4): it is equilibrated in a periodic box, rests between the
// open faces, and then follows its outside.
struct FlowOptions {
  double temperature = 2.5;  // of the start, and of an outside that does not change
  std::uint64_t equilibration_steps =
      4'000;                            // in a periodic box, with a thermostat; pressure and energy are those of their second half
  std::uint64_t resting_steps = 5'000;  // between open faces, without flow
  std::uint64_t flow_steps = 50'000;    // with the outside
  std::uint64_t sampling_steps = 25'000;  // the last of these, over which means are taken
  std::uint64_t row_steps = 250;          // of a row of the record
  // Of an outside that does not change.
  double velocity = 0.3;            // along x
  std::optional<double> pressure;   // none: that of the equilibrated fluid
  std::optional<double> mass_flux;  // none: density times velocity
  std::optional<double> energy;     // at which particles are put in; none: the slab's mean per particle
  double shear = 0.0;               // momentum along y that passes both faces per area and time
  // Energy that a particle brings through a face: that of the equilibrated fluid, a number, or what it and the force on the buffers
  // carry, without heat.
  enum class Enthalpy { of_fluid, number, free } enthalpy_kind = Enthalpy::of_fluid;
  double enthalpy = 0.0;
  bool constant_force = false;  // ConstantOutsideOptions::counts_recoil is off
  double impedance = 0.0;       // density times sound velocity; 0: waves are reflected
  OpenSlabOptions slab;
  std::uint64_t seed = 1;

  // Throws Error(bad_input) naming the option that is out of range.
  void check(const PairModel& model, const Configuration& start) const;
};

// Means over the steps of a row.
struct FlowRow {
  double time = 0.0;  // since the outside took over, at the end of the row; negative before
  FlowProfile profile;
  FlowBalance balance;
  std::array<double, 2> pressure{};       // asked for by the outside, at the end
  std::vector<OutsideCell> outside;       // at the end
  std::array<double, 2> momentum_flux{};  // along x, through the faces, over the last interval between calls of the outside
};

// Of a quantity along x between the buffers, over the sampling steps: means over blocks of rows with their standard errors.
struct FlowMean {
  Estimate mean, slope;  // slope: per sigma
};

struct FlowResult {
  std::vector<FlowRow> rows;
  std::array<std::vector<FlowInsertion>, 2> insertions;  // at the faces x = 0 and x = L, since the outside took over
  FlowMean density, velocity, temperature;
  double pressure = 0.0;  // of the outside at the start
  FlowOutcome outcome = FlowOutcome::followed;
  bool interrupted = false;
  double seconds = 0.0;
  FluidState last;
};

// `start`: in a box that is periodic along all axes, or open along x: then it is not equilibrated, and needs a pressure. `outside`:
// null for one that does not change, of the options. Bit-identical for a given seed and instruction set, interrupted and resumed or
// not.
FlowResult run_flow(const PairModel& model, const Configuration& start, const FlowOptions& options, Outside* outside,
                    const CheckpointOptions& checkpoint, RunMonitor& monitor);

}  // namespace lanescape
