#include "configuration/rounding_overlaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace lanescape {
namespace {

constexpr double rounding_margin = 1e-12;

struct Contact {
  std::size_t i = 0, j = 0;
  double squared = std::numeric_limits<double>::infinity();  // (r_ij / s_ij)^2
};

double squared_distance(const Configuration& c, std::size_t i, std::size_t j) {
  double r2 = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double d = c.box.nearest_image(axis, c.positions[3 * j + axis] - c.positions[3 * i + axis]);
    r2 += d * d;
  }
  return r2;
}

// The pair with the least r_ij / s_ij.
Contact closest_pair(const Configuration& c) {
  Contact closest;
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t j = i + 1; j < c.size(); ++j) {
      const double s = c.radii[i] + c.radii[j], squared = squared_distance(c, i, j) / s / s;  // s * s may underflow
      if (squared < closest.squared) closest = {i, j, squared};
    }
  return closest;
}

}  // namespace

double rounding_overlap_factor(const Configuration& configuration, double tolerance) {
  if (!(tolerance >= 0.0 && tolerance < 1.0))
    throw_bad_input(fmt::format("overlap tolerance {} is not allowed: at least 0 and below 1 (in units of s_ij)", tolerance));
  if (configuration.size() == 0 || configuration.radii.size() != configuration.size())
    throw_bad_input(fmt::format("{} radii were given for {} particles: one each is needed, and at least one particle",
                                configuration.radii.size(), configuration.size()));
  const double largest = 2.0 * *std::max_element(configuration.radii.begin(), configuration.radii.end());
  if (configuration.box.shortest() < 2.0 * largest)
    throw_bad_input(fmt::format("box edge {} is not allowed: at least twice the largest diameter of {} is needed",
                                configuration.box.shortest(), largest));

  const Contact closest = closest_pair(configuration);
  if (!(closest.squared < 1.0)) return 1.0;
  const double ratio = std::sqrt(closest.squared);
  if (1.0 - ratio > tolerance) {
    const double s = configuration.radii[closest.i] + configuration.radii[closest.j];
    throw_bad_input(fmt::format("particles {} and {} overlap: their gap is {:.6g}, at least {:.6g} is allowed (tolerance {} s_ij)",
                                closest.i, closest.j, (ratio - 1.0) * s, -tolerance * s, tolerance));
  }
  return ratio * (1.0 - rounding_margin);
}

double remove_rounding_overlaps(Configuration& configuration, double tolerance) {
  const double factor = rounding_overlap_factor(configuration, tolerance);
  if (factor < 1.0)
    for (double& r : configuration.radii) r *= factor;
  return factor;
}

}  // namespace lanescape
