#include "reference/curve_shortening.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reference/hard_sphere.hpp"

namespace lanescape::reference {
namespace {

double length_of(const std::vector<Point>& nodes) {
  double length = 0.0;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) length += distance(nodes[k], nodes[k + 1]);
  return length;
}

void project(const Projection& projection, Point& node) {
  if (!projection(node)) throw std::invalid_argument("curve_shortening: no way back to the allowed region from a node");
}

/// The longest move of a node, in parts of a segment.
double sweep(std::vector<Point>& nodes, const Projection& projection, double over_relaxation) {
  double longest = 0.0;
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
    const Point sum = combine(nodes[k - 1], 1.0, nodes[k + 1]);
    const Point pull = combine(sum, -2.0, nodes[k]);  // twice the way to the midpoint
    Point moved = combine(nodes[k], 0.5 * over_relaxation, pull);
    project(projection, moved);
    longest = std::max(longest, distance(nodes[k], moved) / distance(nodes[k - 1], nodes[k + 1]) * 2.0);
    nodes[k] = moved;
  }
  return longest;
}

}  // namespace

Projection below_energy(const Energy& energy, const Gradient& gradient, double landscape_energy) {
  return [=](Point& position) {
    const double rounding = 1e-12 * std::max(1.0, std::abs(landscape_energy));
    Point slope(position.size());
    for (int newton = 0; newton < 100; ++newton) {
      const double excess = energy(position) - landscape_energy;
      if (excess <= rounding) return true;
      gradient(position, slope);
      position = combine(position, -excess / dot(slope, slope), slope);
    }
    return false;
  };
}

Projection without_overlaps(std::span<const double> radii, const Vector& box) {
  return [radii = std::vector<double>(radii.begin(), radii.end()), box](Point& position) {
    for (int round = 0; round < 100'000; ++round) {
      double deepest = 0.0;
      for (const Overlap& pair : overlaps(position, radii, box)) {
        deepest = std::max(deepest, -pair.gap);
        const double apart = -pair.gap / (2.0 * std::sqrt(dot(pair.separation, pair.separation)));
        for (std::size_t axis = 0; axis < 3; ++axis) {
          position[3 * pair.i + axis] -= apart * pair.separation[axis];
          position[3 * pair.j + axis] += apart * pair.separation[axis];
        }
      }
      if (deepest <= 1e-13) return true;
    }
    return false;
  };
}

std::vector<Point> spaced_equally(const std::vector<Point>& nodes, std::size_t count) {
  const double spacing = length_of(nodes) / static_cast<double>(count - 1);
  std::vector<Point> result{nodes.front()};
  double before = 0.0;  // length up to node k
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    const double segment = distance(nodes[k], nodes[k + 1]);
    while (result.size() + 1 < count && static_cast<double>(result.size()) * spacing <= before + segment) {
      const double fraction = (static_cast<double>(result.size()) * spacing - before) / segment;
      result.push_back(combine(nodes[k], fraction, combine(nodes[k + 1], -1.0, nodes[k])));
    }
    before += segment;
  }
  result.push_back(nodes.back());
  return result;
}

ShortenedCurve shorten_curve(const std::vector<Point>& start, const Projection& projection, const CurveOptions& options) {
  if (start.size() < 3) throw std::invalid_argument("curve_shortening: a path needs at least three nodes");
  ShortenedCurve result;
  result.nodes = start;
  for (std::size_t count = options.coarse; count <= options.fine; count = 2 * count - 1) {
    result.nodes = spaced_equally(result.nodes, count);
    for (std::size_t k = 1; k + 1 < count; ++k) project(projection, result.nodes[k]);
    for (result.stationary = false; !result.stationary && result.sweeps < options.max_sweeps; ++result.sweeps)
      result.stationary = sweep(result.nodes, projection, options.over_relaxation) < options.tolerance;
  }
  result.length = length_of(result.nodes);
  return result;
}

}  // namespace lanescape::reference
