#pragma once

#include <array>
#include <cstdint>

namespace lanescape {

// Which independent sequence a random number belongs to. Numbers are append-only: they are part of what a seed means.
enum class RandomStream : std::uint32_t {
  species = 1,
  velocities = 2,
  sites = 3,
  displacements = 4,
  monte_carlo = 5,
  insertion = 6,
  langevin = 7,
  diameters = 8,
  shortening = 9,
  flow = 10,
  bootstrap = 11
};

// Counter-based random numbers (Philox4x32-10, Salmon et al., SC 2011, doi 10.1145/2063384.2063405): each is a function of
// (seed, stream, step, particle, draw), so there is no state, and neither the order of calls nor the number of threads matters. All
// members read the same block for the same arguments: a stream uses one of them, or different values of `draw` < 2^24.
class CounterRandom {
 public:
  CounterRandom(std::uint64_t seed, RandomStream stream) : seed_(seed), stream_(stream) {}

  // Uniform in (0, 1), 52 bits, without the ends.
  double uniform(std::uint64_t step, std::uint32_t particle, std::uint32_t draw = 0) const;
  // Standard normal (Box-Muller).
  double normal(std::uint64_t step, std::uint32_t particle, std::uint32_t draw = 0) const;
  // Three components from Maxwell's distribution of width sqrt(T/m): normal() with draw, draw + 1 and draw + 2.
  std::array<double, 3> velocity(double width, std::uint64_t step, std::uint32_t particle, std::uint32_t draw = 0) const;
  // Three numbers uniform in (0, 1), 32 bits each, from one block.
  std::array<double, 3> uniform_point(std::uint64_t step, std::uint32_t particle, std::uint32_t draw = 0) const;
  // Uniform in [0, n), n > 0.
  std::uint32_t below(std::uint32_t n, std::uint64_t step, std::uint32_t particle, std::uint32_t draw = 0) const;

 private:
  std::uint64_t seed_;
  RandomStream stream_;
};

}  // namespace lanescape
