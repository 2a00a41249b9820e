#include "reference/hard_sphere.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reference/separation.hpp"

namespace lanescape::reference {
namespace {

/// visit(i, j, separation, r2, s) for all i < j.
template <typename Visit>
void for_each_pair(std::span<const double> positions, std::span<const double> radii, const Vector& box, Visit visit) {
  check(positions, radii, box);
  for (std::size_t i = 0; i < radii.size(); ++i)
    for (std::size_t j = i + 1; j < radii.size(); ++j) {
      const Vector d = separation(&positions[3 * i], &positions[3 * j], box);
      visit(i, j, d, dot(d, d), radii[i] + radii[j]);
    }
}

}  // namespace

std::vector<Overlap> overlaps(std::span<const double> positions, std::span<const double> radii, const Vector& box) {
  std::vector<Overlap> found;
  for_each_pair(positions, radii, box, [&](std::size_t i, std::size_t j, const Vector& d, double r2, double s) {
    if (r2 < s * s) found.push_back({i, j, std::sqrt(r2) - s, d});
  });
  return found;
}

bool any_overlap(std::span<const double> positions, std::span<const double> radii, const Vector& box) {
  return !overlaps(positions, radii, box).empty();
}

double smallest_gap(std::span<const double> positions, std::span<const double> radii, const Vector& box) {
  double smallest = std::numeric_limits<double>::infinity();
  for_each_pair(positions, radii, box, [&](std::size_t, std::size_t, const Vector&, double r2, double s) {
    smallest = std::min(smallest, std::sqrt(r2) - s);
  });
  return smallest;
}

std::vector<std::pair<std::size_t, std::size_t>> pairs_within(std::span<const double> positions, std::span<const double> radii,
                                                              const Vector& box, double reach) {
  if (!(reach >= 0.0)) throw std::invalid_argument("pairs_within: the reach must not be negative");
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for_each_pair(positions, radii, box, [&](std::size_t i, std::size_t j, const Vector&, double r2, double s) {
    const double t = s + reach;
    if (r2 < t * t) found.emplace_back(i, j);
  });
  return found;
}

double fictitious_energy(FictitiousPotential potential, double r, double s) {
  const double x = r / s;
  if (!(x < 1.0)) return 0.0;
  switch (potential) {
    case FictitiousPotential::harmonic:
      return s * s * (1.0 - x) * (1.0 - x) / 2.0;
    case FictitiousPotential::linear:
      return s * s * (1.0 - x);
    case FictitiousPotential::cubic:
      return s * s * s * (x * x * x / 3.0 - x * x / 2.0 + 1.0 / 6.0);
  }
  throw std::invalid_argument("fictitious_energy: no such potential");
}

double fictitious_force(FictitiousPotential potential, double r, double s) {
  const double x = r / s;
  if (!(x < 1.0)) return 0.0;
  switch (potential) {
    case FictitiousPotential::harmonic:
      return s * (1.0 - x);
    case FictitiousPotential::linear:
      return s;
    case FictitiousPotential::cubic:
      return s * s * x * (1.0 - x);
  }
  throw std::invalid_argument("fictitious_force: no such potential");
}

std::vector<double> fictitious_forces(std::span<const double> positions, std::span<const double> radii, const Vector& box,
                                      FictitiousPotential potential) {
  std::vector<double> forces(positions.size(), 0.0);
  for (const Overlap& pair : overlaps(positions, radii, box)) {
    const double r = std::sqrt(dot(pair.separation, pair.separation));
    if (r == 0.0) continue;
    const double force_over_r = fictitious_force(potential, r, radii[pair.i] + radii[pair.j]) / r;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      forces[3 * pair.i + axis] -= force_over_r * pair.separation[axis];
      forces[3 * pair.j + axis] += force_over_r * pair.separation[axis];
    }
  }
  return forces;
}

}  // namespace lanescape::reference
