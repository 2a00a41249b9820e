#pragma once

#include <cstdint>
#include <vector>

#include "core/archive.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"
#include "insertion/insertion.hpp"
#include "run/moving_fluid.hpp"
#include "run/run_loop.hpp"

namespace lanescape {

// A periodic fluid whose density grows by insertion at constant energy per particle, with no thermostat ([U] IV.A, figure 3):
// particles are inserted at the fluid's mean excess energy per particle, with Maxwellian velocities at its temperature.
struct DensificationOptions {
  double temperature = 2.5;                    // of the start; a thermostat holds it during equilibration
  std::uint64_t equilibration_steps = 10'000;  // before anything is inserted
  double final_density = 0.8;                  // [sigma^-3]
  double rate = 0.005;                         // d rho/dt
  double time_step = 0.002;                    // [sigma sqrt(m/epsilon)]
  std::uint64_t rows = 40;                     // of the record, equal steps of density
  InsertionOptions insertion;                  // its target is ignored
  int species = 0;                             // of what is inserted
  int threads = 1;

  // Throws Error(bad_input) naming the option that is out of range. The rate is at most one insertion per volume (3 sigma)^3 and
  // collision time 1/(4 rho sqrt(pi T)).
  void check(const FluidState& start) const;
};

// Means over a step of density.
struct DensificationRow {
  double time = 0.0, density = 0.0, temperature = 0.0, pressure = 0.0;
  double excess_energy = 0.0, energy = 0.0;  // per particle [epsilon]
  double inserted_energy = 0.0;              // per inserted particle, the kinetic part included [epsilon]
  double evaluations = 0.0;                  // per insertion
  // Total energy less its start value and less what insertions brought, per particle: the errors of the integrator and of the
  // truncation.
  double drift = 0.0;
};

struct DensificationResult {
  std::vector<DensificationRow> rows;
  std::uint64_t failures = 0;
  FluidState final_state;
  std::uint64_t inserted = 0;
  bool interrupted = false;
  double seconds = 0.0;
};

// `start` may be a lattice. Ends early at the first insertion that finds no position.
DensificationResult run_densification(const PairModel& model, const FluidState& start, const DensificationOptions& options, Isa isa,
                                      const CheckpointOptions& checkpoint, RunMonitor& monitor);

}  // namespace lanescape
