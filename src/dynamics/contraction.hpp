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

// Hard spheres that are compressed, pushed apart and moved by Monte Carlo ([G] 3.2.3, its references 53 and 54). Each sphere has a
// neighbour list with a skin. All lists are rebuilt once a sphere has moved by half the skin since the last rebuild.
class SqueezedSpheres {
 public:
  // `start` may overlap.
  explicit SqueezedSpheres(const Configuration& start);

  // Multiplies the volume of the box by `factor` and scales the positions with it. Spheres may overlap afterwards.
  void scale_volume(double factor);
  // Pushes overlapping pairs apart along the line of their centres, each sphere by half, until no pair overlaps. Returns false if
  // overlaps may remain after `max_passes` passes over all pairs.
  bool push_apart(std::uint64_t max_passes);
  // Tries to move each sphere once, in order, by up to `max_move` along each axis [sigma]. Accepts a move if it causes no overlap.
  // Returns the number of accepted moves. `sweep` selects the random numbers. Spheres must not overlap at the start.
  std::size_t sweep(const CounterRandom& random, std::uint64_t sweep, double max_move);

  double packing_fraction() const;
  // Positions are wrapped into the box.
  Configuration configuration() const;

 private:
  using Position = std::array<double, 3>;

  void make_lists();
  void place(std::size_t i, const Position& position);
  double distance_squared(const Position& a, const Position& b) const;
  bool fits(std::size_t i, const Position& position) const;
  bool push_pairs_apart();

  Configuration spheres_;  // current except for its positions, which are in positions_
  std::vector<Position> positions_, made_at_;
  double skin_;
  bool stale_ = true;
  std::vector<std::size_t> list_begin_;  // N + 1
  std::vector<std::uint32_t> lists_;
};

struct ContractionOptions {
  double volume_factor = 0.9990;      // factor of one contraction
  std::uint64_t sweeps = 2'000;       // Monte Carlo sweeps after each contraction
  double max_move = 0.10;             // largest trial move along each axis [diameter of the smallest sphere]
  std::uint64_t max_passes = 20'000;  // limit of passes that push pairs apart, per contraction

  // Throws Error(bad_input) naming the option that is out of range.
  void check() const;
};

// Mechanical contraction ([G] 3.2.3, after Williams and Philipse, doi 10.1103/PhysRevE.67.051301). Contracts the box, pushes
// spheres apart and runs Monte Carlo sweeps until the packing fraction is reached or exceeded. Then enlarges the box, with
// particles fixed, to the exact packing fraction. Returns `start` if it is dense enough already, and nothing if the monitor asks to
// stop. Throws Error(bad_input) if overlapping spheres cannot be pushed apart any more.
std::optional<Configuration> contract(const Configuration& start, double packing_fraction, const ContractionOptions& options,
                                      std::uint64_t seed, RunMonitor& monitor);

}  // namespace lanescape
