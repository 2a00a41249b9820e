#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "hard_paths.hpp"
#include "reference/geodesic.hpp"

/// Two spheres of diameter 1 whose relative coordinates go from distance a to distance b, at an angle, for tests of shortened
/// paths.
namespace lanescape::reference {

struct Around {
  double a, b, angle;
  Point start() const { return two_spheres(a, 0.0); }
  Point finish() const { return two_spheres(b, angle); }
  /// PHYSICS 6; in 6N coordinates.
  double shortest() const {
    return (std::sqrt(a * a - 1.0) + std::sqrt(b * b - 1.0) + angle - std::acos(1.0 / a) - std::acos(1.0 / b)) /
           std::numbers::sqrt2;
  }
  /// The geodesic: a tangent, an arc and a tangent; at a part of its length.
  Point geodesic(double part) const {
    const double first = std::sqrt(a * a - 1.0), last = std::sqrt(b * b - 1.0), contact = std::acos(1.0 / a);
    const double whole = shortest() * std::numbers::sqrt2, along = part * whole;
    if (along < first) return combine(start(), along / first, combine(two_spheres(1.0, contact), -1.0, start()));
    if (along > whole - last)
      return combine(finish(), (whole - along) / last, combine(two_spheres(1.0, angle - std::acos(1.0 / b)), -1.0, finish()));
    return two_spheres(1.0, contact + along - first);
  }
  /// A wide way round, at a part of the angle.
  Point wide(double part) const { return two_spheres(a + (b - a) * part + 2.0 * std::sin(std::numbers::pi * part), angle * part); }

  template <class Shape>
  static std::vector<Point> nodes(std::size_t count, const Shape& shape) {
    std::vector<Point> result;
    for (std::size_t k = 0; k < count; ++k) result.push_back(shape(static_cast<double>(k) / static_cast<double>(count - 1)));
    return result;
  }
};

inline const std::vector<Around> kAround{{3.0, 3.0, kAngle}, {3.0, 2.0, 2.6}, {1.5, 4.0, 3.1}, {2.0, 2.0, 2.2}, {1.2, 1.4, 1.9}};

/// V = -r: V <= -1 outside a sphere of diameter 1.
inline double apart(const Point& x) { return std::hypot(x[0] - x[3], x[1] - x[4], x[2] - x[5]); }
inline const Energy kNearness = [](const Point& x) { return -apart(x); };
inline const Gradient kSlope = [](const Point& x, Point& gradient) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    gradient[axis] = -(x[axis] - x[3 + axis]) / apart(x);
    gradient[3 + axis] = -gradient[axis];
  }
};

}  // namespace lanescape::reference
