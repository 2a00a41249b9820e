#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "reference/event_driven.hpp"
#include "reference/hard_geodesic.hpp"
#include "reference/path_sum.hpp"

/// Systems and lengths for tests of paths of hard spheres.
namespace lanescape::reference {

inline constexpr Vector kBox{40.0, 40.0, 40.0};
inline constexpr double kAngle = 170.0 * std::numbers::pi / 180.0;
inline const std::vector<double> kTwo{0.5, 0.5};

inline double moved(const Point& a, const Point& b, std::size_t j) {
  return std::hypot(b[3 * j] - a[3 * j], b[3 * j + 1] - a[3 * j + 1], b[3 * j + 2] - a[3 * j + 2]);
}

/// Two spheres about a resting centre of mass, at the given distance and angle in a tilted plane.
inline Point two_spheres(double r, double angle) {
  const double x = 0.5 * r * std::cos(angle);
  const double y = 0.5 * r * std::sin(angle) * 0.6;
  const double z = 0.5 * r * std::sin(angle) * 0.8;
  return {x, y, z, -x, -y, -z};
}

/// PHYSICS 6, analytic check: tangents from both ends to the sphere and the arc between, in relative coordinates. The length in 6N
/// coordinates is 1/sqrt(2) of it.
inline double shortest(double a, double s, double angle) {
  return 2.0 * std::sqrt(a * a - s * s) + s * (angle - 2.0 * std::acos(s / a));
}

struct Pair {
  Point start;
  Point finish;
  std::vector<double> radii;
  Vector box;
};

/// n^3 spheres, every second one 1.4 times as large, at two times of event-driven dynamics that are `separation` apart.
inline Pair fluid(std::size_t n, double packing_fraction, double separation, unsigned seed) {
  Pair result;
  double volume = 0.0;
  const std::size_t count = n * n * n;
  for (std::size_t j = 0; j < count; ++j) {
    result.radii.push_back(j % 2 == 0 ? 0.5 : 0.7);
    volume += 4.0 / 3.0 * std::numbers::pi * std::pow(result.radii.back(), 3);
  }
  const double edge = std::cbrt(volume / packing_fraction);
  result.box = {edge, edge, edge};
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Point sites, velocities;
  for (std::size_t j = 0; j < count; ++j)
    for (const std::size_t k : {j % n, j / n % n, j / n / n}) {
      sites.push_back(static_cast<double>(k) * edge / static_cast<double>(n));
      velocities.push_back(uniform(engine));
    }
  // The total momentum is zero: the last sphere has that of the others, reversed.
  for (std::size_t k = 0; k < 3 * count - 3; ++k) velocities[3 * count - 3 + k % 3] -= velocities[k];
  EventDriven simulation(sites, velocities, result.radii, std::vector<double>(count, 1.0), result.box);
  for (int k = 0; k < 500; ++k) simulation.step(1e6);
  simulation.step(simulation.time() + 1e-4);
  result.start = simulation.positions();
  double until = simulation.time();
  do {
    until += 0.01;
    while (simulation.step(until)) {
    }
    result.finish = simulation.positions();
  } while (distance(result.start, result.finish) < separation);
  return result;
}

/// Two spheres on a line that exchange positions.
inline const Point kHeadOn{1.5, 0.0, 0.0, -1.5, 0.0, 0.0};
inline const Point kHeadOnFinish{-1.5, 0.0, 0.0, 1.5, 0.0, 0.0};

}  // namespace lanescape::reference
