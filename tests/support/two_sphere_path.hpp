#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/point.hpp"
#include "path/polyline.hpp"

namespace lanescape::testing {

// Two spheres in relative coordinates (PHYSICS 6): from distance a to distance b, at an angle, around a sphere of radius s. The
// geodesic is a tangent, an arc and a tangent.
struct TwoSpherePath {
  double a, b, angle, s = 1.0;

  double free_begin() const { return std::sqrt(a * a - s * s); }
  double free_end() const { return std::sqrt(b * b - s * s); }
  double arc() const { return angle - std::acos(s / a) - std::acos(s / b); }
  // Of the relative path; that of both particles is shorter by sqrt(2).
  double length() const { return free_begin() + free_end() + s * arc(); }

  Point start() const { return {a, 0.0, 0.0}; }
  Point goal() const { return polar(b, angle); }
  static Point polar(double r, double phi) { return {r * std::cos(phi), r * std::sin(phi), 0.0}; }

  // The point of the geodesic at this part of its length.
  Point geodesic(double fraction) const {
    const double along = fraction * length(), first = std::acos(s / a), second = angle - std::acos(s / b);
    if (along < free_begin()) return between(start(), polar(s, first), along / free_begin());
    const double left = length() - along;
    if (left < free_end()) return between(goal(), polar(s, second), left / free_end());
    return polar(s, first + (along - free_begin()) / s);
  }
  // The greedy path, which finders take: straight to the goal as far as possible, then along the sphere until the goal is seen.
  double greedy_length() const { return distance(start(), contact()) + s * greedy_arc() + free_end(); }
  Point greedy(double fraction) const {
    const double whole = greedy_length(), along = fraction * whole, left = whole - along, free = distance(start(), contact());
    const double sight = angle - std::acos(s / b);
    if (along < free) return between(start(), contact(), along / free);
    if (left < free_end()) return between(goal(), polar(s, sight), left / free_end());
    return polar(s, sight - greedy_arc() + (along - free) / s);
  }
  // Where the straight line to the goal meets the sphere.
  Point contact() const {
    const Point line = difference(goal(), start());
    const double whole = distance(start(), goal()), p = dot(start(), line) / whole;
    return between(start(), goal(), (-p - std::sqrt(p * p - a * a + s * s)) / whole);
  }
  double greedy_arc() const { return angle - std::acos(s / b) - std::atan2(contact()[1], contact()[0]); }

  static double distance(const Point& from, const Point& to) {
    const Point d = difference(to, from);
    return std::sqrt(dot(d, d));
  }
  static Point between(const Point& from, const Point& to, double t) {
    return {from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]), from[2] + t * (to[2] - from[2])};
  }
};

// A turn by 1 radian about (1, 2, 3).
inline Point turned(const Point& x) {
  const double root = std::sqrt(14.0), c = std::cos(1.0), s = std::sin(1.0);
  const Point k{1.0 / root, 2.0 / root, 3.0 / root};
  const Point cross{k[1] * x[2] - k[2] * x[1], k[2] * x[0] - k[0] * x[2], k[0] * x[1] - k[1] * x[0]};
  const double along = dot(k, x) * (1.0 - c);
  return {c * x[0] + s * cross[0] + along * k[0], c * x[1] + s * cross[1] + along * k[1], c * x[2] + s * cross[2] + along * k[2]};
}

// Nodes of two particles around `centre` of mass, from a function of the part of the length. `mass` is that of the second over that
// of the first.
template <class Relative>
Polyline two_particle_path(const ParticleLayout& layout, std::size_t nodes, const Point& centre, Relative relative,
                           double mass = 1.0) {
  Polyline result;
  for (std::size_t k = 0; k < nodes; ++k) {
    const Point x = relative(static_cast<double>(k) / static_cast<double>(nodes - 1));
    std::vector<double> positions(6);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      positions[axis] = centre[axis] - mass / (1.0 + mass) * x[axis];
      positions[3 + axis] = centre[axis] + 1.0 / (1.0 + mass) * x[axis];
    }
    result.push_back(layout.to_slots(positions));
  }
  return result;
}

}  // namespace lanescape::testing
