#include "interaction/sphere/rounding_overlaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "interaction/pair/closest_pair.hpp"

namespace lanescape {
namespace {

constexpr double rounding_margin = 1e-12;

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

  const ClosePair closest = closest_pair(
      configuration, largest, [&](std::size_t i, std::size_t j) { return configuration.radii[i] + configuration.radii[j]; });
  if (!(closest.ratio_squared < 1.0)) return 1.0;
  const double ratio = std::sqrt(closest.ratio_squared);
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
