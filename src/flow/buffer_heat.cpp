#include "flow/buffer_heat.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lanescape {
namespace {

Point mean_velocity(const FluidState& fluid, std::span<const std::size_t> particles) {
  Point sum{};
  for (const std::size_t i : particles)
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += fluid.velocities[3 * i + axis];
  for (double& component : sum) component /= static_cast<double>(particles.size());
  return sum;
}

double kinetic_energy(const FluidState& fluid, std::span<const std::size_t> particles, double mass, const Point& about) {
  double twice = 0.0;
  for (const std::size_t i : particles)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double v = fluid.velocities[3 * i + axis] - about[axis];
      twice += mass * v * v;
    }
  return 0.5 * twice;
}

}  // namespace

double add_heat(FluidState& fluid, std::span<const std::size_t> particles, double mass, double heat) {
  if (particles.size() < 2 || heat == 0.0) return 0.0;
  const Point mean = mean_velocity(fluid, particles);
  const double thermal = kinetic_energy(fluid, particles, mass, mean);
  const double gained = std::max(heat, -0.5 * thermal), factor = std::sqrt(1.0 + gained / thermal);
  for (const std::size_t i : particles)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double& v = fluid.velocities[3 * i + axis];
      v = mean[axis] + factor * (v - mean[axis]);
    }
  return gained;
}

double redraw_velocities(FluidState& fluid, std::span<const std::size_t> particles, double mass, double temperature,
                         double probability, const CounterRandom& random, std::uint64_t call) {
  std::vector<std::size_t> chosen;
  for (const std::size_t i : particles)
    if (random.uniform(call, static_cast<std::uint32_t>(i), 10) < probability) chosen.push_back(i);
  if (chosen.size() < 2) return 0.0;
  const Point mean = mean_velocity(fluid, chosen);
  const double before = kinetic_energy(fluid, chosen, mass, {});
  for (const std::size_t i : chosen) {
    const Point drawn = random.velocity(std::sqrt(temperature / mass), call, static_cast<std::uint32_t>(i), 11);
    std::copy(drawn.begin(), drawn.end(), fluid.velocities.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
  // Their mean goes back to what it was. What is left of the drawn energy is that of one particle less.
  const Point now = mean_velocity(fluid, chosen);
  for (const std::size_t i : chosen)
    for (std::size_t axis = 0; axis < 3; ++axis) fluid.velocities[3 * i + axis] += mean[axis] - now[axis];
  return kinetic_energy(fluid, chosen, mass, {}) - before;
}

}  // namespace lanescape
