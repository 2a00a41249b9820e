#pragma once

#include <cstdint>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/state_mixture_model.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"

namespace lanescape {

// A liquid in the middle of a long box, with its vapour around it if the model has one: Langevin dynamics from a lattice.
struct SlabOptions {
  std::uint64_t particles = 1200;
  double width = 10.0, length = 30.0;  // of the box, along x and y, and along z [sigma]
  double start_density = 0.85;         // of the lattice in the middle; one much below the liquid tears [sigma^-3]
  double temperature = 0.8, friction = 0.5, time_step = 0.005;
  std::uint64_t equilibration_steps = 20'000, sampling_steps = 20'000, interval = 20;  // steps between samples
  std::uint64_t bins = 60;
  std::uint64_t seed = 1;
  int threads = 1;  // no effect on any result

  // Throws Error(bad_input) naming the option that is out of range.
  void check() const;
};

// Means over samples, bin by bin along z, z = 0 where the slab's centre is.
struct SlabProfiles {
  std::vector<double> z;                         // middle of each bin [sigma]
  std::vector<double> density;                   // [sigma^-3]
  std::vector<double> local_density;             // of the sites in the bin; 0 where there was none
  std::vector<std::vector<double>> probability;  // of each state, likewise
  std::vector<double> sites;                     // found in the bin, all samples together
  double temperature = 0.0;
  std::uint64_t samples = 0;
  bool interrupted = false;
  Configuration last{};  // wrapped
};

SlabProfiles run_slab(const StateMixtureModel& model, const SlabOptions& options, Isa isa, RunMonitor& monitor);

}  // namespace lanescape
