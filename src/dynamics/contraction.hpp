#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "configuration/configuration.hpp"
#include "core/random.hpp"
#include "core/run_monitor.hpp"

namespace lanescape {

// Hard spheres that are squeezed, pushed apart and shuffled by Monte Carlo moves ([G] 3.2.3, its references 53 and 54). Each sphere
// has a list of the others within a skin; all lists are made anew once some sphere is half the skin from where they were made.
class SqueezedSpheres {
 public:
  // `start` may overlap.
  explicit SqueezedSpheres(const Configuration& start);

  // Multiplies the volume, positions along with the box. Spheres may overlap then.
  void scale_volume(double factor);
  // Pushes overlapping pairs apart along the line of their centres, half each, until none overlaps: whether that took fewer
  // than this many passes over all pairs.
  bool push_apart(std::uint64_t max_passes);
  // One trial move of every sphere in order, up to `max_move` along each axis [sigma], accepted where nothing overlaps after it;
  // returns how many were. `sweep` numbers the random numbers. Spheres must not overlap before.
  std::size_t sweep(const CounterRandom& random, std::uint64_t sweep, double max_move);

  double packing_fraction() const;
  // Positions inside the box.
  Configuration configuration() const;

 private:
  using Position = std::array<double, 3>;

  void make_lists();
  void place(std::size_t i, const Position& position);
  double distance_squared(const Position& a, const Position& b) const;
  bool fits(std::size_t i, const Position& position) const;
  bool push_pairs_apart();

  Configuration spheres_;  // its positions are stale
  std::vector<Position> positions_, made_at_;
  double skin_;
  bool stale_ = true;
  std::vector<std::size_t> list_begin_;  // N + 1
  std::vector<std::uint32_t> lists_;
};

struct ContractionOptions {
  double volume_factor = 0.9990;      // of one contraction
  std::uint64_t sweeps = 2'000;       // of Monte Carlo moves after each contraction
  double max_move = 0.10;             // of a trial move along each axis [diameter of the smallest sphere]
  std::uint64_t max_passes = 20'000;  // over overlapping pairs after a contraction, until they are apart

  // Throws Error(bad_input) naming the option that is out of range.
  void check() const;
};

// Mechanical contraction ([G] 3.2.3, after Williams and Philipse, doi 10.1103/PhysRevE.67.051301): contracts, pushes apart and
// shuffles until the packing fraction is reached, then enlarges the box, particles where they are, so that it is met exactly.
// Returns `start` where that is as dense already, nothing where the monitor asked to stop. Throws Error(bad_input) where spheres
// overlap and cannot be pushed apart any more.
std::optional<Configuration> contract(const Configuration& start, double packing_fraction, const ContractionOptions& options,
                                      std::uint64_t seed, RunMonitor& monitor);

}  // namespace lanescape
