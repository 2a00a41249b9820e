#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/point.hpp"
#include "core/random.hpp"

// Initial velocities from Maxwell's distribution. Each dynamics stores velocities in its own way, so these functions take
// `particles`, a function object that visits the particles in a fixed order: it calls its argument as action(mass, vx, vy, vz) with
// references to the velocity. The order decides which random numbers a particle gets and in which order momenta are summed.
namespace lanescape {

// Draws each component from a normal distribution of zero mean and standard deviation `width(mass)`, which is sqrt(T/m).
template <class Particles, class Width>
void draw_maxwell_velocities(const Particles& particles, const Width& width, std::uint64_t seed) {
  const CounterRandom random(seed, RandomStream::velocities);
  std::uint32_t particle = 0;
  particles([&](double mass, double& vx, double& vy, double& vz) {
    const Point velocity = random.velocity(width(mass), 0, particle++);
    vx = velocity[0];
    vy = velocity[1];
    vz = velocity[2];
  });
}

// sum m v.
template <class Particles>
Point total_momentum(const Particles& particles) {
  Point sum{};
  particles([&](double mass, double vx, double vy, double vz) {
    sum[0] += mass * vx;
    sum[1] += mass * vy;
    sum[2] += mass * vz;
  });
  return sum;
}

// Subtracts the velocity of the centre of mass.
template <class Particles>
void remove_momentum(const Particles& particles) {
  const Point momentum = total_momentum(particles);
  double total = 0.0;
  particles([&](double mass, double, double, double) { total += mass; });
  particles([&](double, double& vx, double& vy, double& vz) {
    vx -= momentum[0] / total;
    vy -= momentum[1] / total;
    vz -= momentum[2] / total;
  });
}

// Visits the particles of a layout, species after species. `masses` are per species; `velocity` is in the layout's order. All three
// must outlive the result.
inline auto particles_of(const ParticleLayout& layout, const std::vector<double>& masses, AlignedArray& velocity) {
  return [&layout, &masses, &velocity](auto action) {
    double *const vx = velocity.data(), *const vy = vx + layout.slots(), *const vz = vy + layout.slots();
    for (std::size_t s = 0; s < layout.blocks().size(); ++s) {
      const auto& block = layout.blocks()[s];
      for (std::size_t k = block.begin; k < block.begin + block.count; ++k) action(masses[s], vx[k], vy[k], vz[k]);
    }
  };
}

}  // namespace lanescape
