#pragma once

#include <cstdint>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/state_mixture_model.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"
#include "observables/slab_profiles.hpp"
#include "run/run_loop.hpp"

namespace lanescape {

// A liquid in the middle of a long box, with its vapour around it if the model has one: Langevin dynamics from a lattice.
struct SlabOptions {
  std::uint64_t particles = 1200;
  double width = 10.0, length = 30.0;  // of the box, along x and y, and along z [sigma]
  double start_density = 0.85;         // of the lattice in the middle; one much thinner than the liquid tears [sigma^-3]
  double temperature = 0.8, friction = 0.5, time_step = 0.005;
  std::uint64_t equilibration_steps = 20'000, sampling_steps = 20'000, interval = 20;  // steps between samples
  std::uint64_t bins = 60;
  std::uint64_t seed = 1;
  int threads = 1;  // no effect on any result

  // Throws Error(bad_input) naming the option that is out of range.
  void check() const;
  // check(), and whether the slab fits into its box and the model's cutoff.
  void check_against(const StateMixtureModel& model) const;
};

struct SlabRunResult {
  SlabProfiles profiles;
  double temperature = 0.0;  // kinetic, mean over samples
  bool interrupted = false;
  double seconds = 0.0;
  Configuration last{};  // wrapped
};

// Bit-identical for a given seed and instruction set, interrupted and resumed or not. Throws Error(bad_input) where check_against()
// does.
SlabRunResult run_slab(const StateMixtureModel& model, const SlabOptions& options, Isa isa, const CheckpointOptions& checkpoint,
                       RunMonitor& monitor);

}  // namespace lanescape
