#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"
#include "insertion/insertion.hpp"
#include "insertion/removal.hpp"

namespace lanescape {

// Particles put into one configuration and taken out of it.
struct InsertionRunOptions {
  InsertionOptions insertion;
  bool mean_target = true;     // the target is the fluid's mean excess energy per particle; else InsertionOptions::target
  std::uint64_t count = 1;     // particles to insert
  std::uint64_t removals = 0;  // particles to remove afterwards, of the same species and region
  RemovalRule removal = RemovalRule::random;
  int species = 0;                    // of what is inserted or removed
  double diameter = 1.0;              // of what is inserted, if the model's particles have diameters [sigma]
  std::optional<double> temperature;  // of Maxwellian velocities for inserted particles
  int threads = 1;

  // Throws Error(bad_input) for an empty fluid and for what the box or the model does not allow.
  void check(const PairModel& model, const Configuration& fluid) const;
};

struct InsertionRunResult {
  Configuration fluid;  // afterwards
  std::vector<Insertion> insertions;
  std::vector<std::array<double, 3>> velocities;  // of the inserted particles; empty without a temperature
  struct Removed {
    std::array<double, 3> position;
    double energy;  // what the fluid's fell by [epsilon]
  };
  std::vector<Removed> removals;
  double target = 0.0;  // [epsilon]
  std::uint64_t evaluations = 0, failures = 0;
  bool interrupted = false;
  double seconds = 0.0;
};

InsertionRunResult run_insertion(const PairModel& model, Configuration fluid, const InsertionRunOptions& options, Isa isa,
                                 RunMonitor& monitor);

}  // namespace lanescape
