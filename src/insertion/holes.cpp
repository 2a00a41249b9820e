#include "insertion/holes.hpp"

#include <cmath>
#include <numbers>

namespace lanescape {
namespace {

// Directions at equal steps of cos theta and of phi have equal solid angles.
constexpr int polar_steps = 12, azimuthal_steps = 24;
constexpr double relative_step = 0.02;  // [ProbeField::length_unit()]; walls thinner than this may be missed
constexpr int halvings = 20;

std::array<double, 3> beyond(const std::array<double, 3>& point, const std::array<double, 3>& direction, double r) {
  return {point[0] + r * direction[0], point[1] + r * direction[1], point[2] + r * direction[2]};
}

// The distance at which the energy first reaches `iso_energy`; nothing if it does not up to the largest radius.
std::optional<double> radius(const ProbeField& fluid, const std::array<double, 3>& point, const std::array<double, 3>& direction,
                             double iso_energy) {
  const double radial_step = relative_step * fluid.length_unit();
  for (double r = radial_step; r <= largest_hole_radius * fluid.length_unit(); r += radial_step) {
    if (fluid.energy(beyond(point, direction, r)) < iso_energy) continue;
    double low = r - radial_step, high = r;
    for (int k = 0; k < halvings; ++k) {
      const double middle = 0.5 * (low + high);
      (fluid.energy(beyond(point, direction, middle)) < iso_energy ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
  return std::nullopt;
}

// <R^2>/<R>^2 of an ellipsoid of eccentricity e.
double ratio_at(double e) { return e * std::atanh(e) / std::pow(std::asin(e), 2); }

}  // namespace

void fit_prolate(Hole& hole) {
  const double ratio = hole.mean_square / (hole.mean_radius * hole.mean_radius);
  hole.anisotropy = ratio - 1.0;
  // The ratio rises monotonically with e, from 1 without bound, so bisection finds e.
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (middle < 1e-4 || ratio_at(middle) < ratio ? low : high) = middle;
  }
  const double e = hole.eccentricity = 0.5 * (low + high);
  hole.semi_minor = hole.mean_radius * e / std::asin(e);
  hole.semi_major = hole.semi_minor / std::sqrt((1.0 - e) * (1.0 + e));
}

std::optional<Hole> measure_hole(const ProbeField& fluid, const std::array<double, 3>& point, double iso_energy) {
  if (!(fluid.energy(point) < iso_energy)) return std::nullopt;
  constexpr double share = 1.0 / (polar_steps * azimuthal_steps);
  Hole hole;
  for (int p = 0; p < polar_steps; ++p)
    for (int a = 0; a < azimuthal_steps; ++a) {
      const double cosine = (2.0 * p + 1.0) / polar_steps - 1.0, sine = std::sqrt(1.0 - cosine * cosine);
      const double phi = 2.0 * std::numbers::pi * (a + 0.5) / azimuthal_steps;
      const std::optional<double> found = radius(fluid, point, {sine * std::cos(phi), sine * std::sin(phi), cosine}, iso_energy);
      const double r = found.value_or(largest_hole_radius * fluid.length_unit());
      hole.open_directions += found ? 0.0 : share;
      hole.mean_radius += share * r;
      hole.mean_square += share * r * r;
    }
  fit_prolate(hole);
  return hole;
}

}  // namespace lanescape
