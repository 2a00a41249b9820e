#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/point.hpp"

namespace lanescape {

// An orthorhombic box. Each axis is periodic or open: along an open one there are no images, and coordinates may lie outside
// [0, L]. What needs images along all axes calls check_periodic() (core/coordinate_checks.hpp).
struct Box {
  Point length{};  // [sigma]
  std::array<bool, 3> periodic{true, true, true};

  double volume() const { return length[0] * length[1] * length[2]; }
  bool has_open_axis() const { return !(periodic[0] && periodic[1] && periodic[2]); }
  // The same box in another unit of length.
  Box in_unit(double unit) const { return {{length[0] / unit, length[1] / unit, length[2] / unit}, periodic}; }
  // The nearest image of a separation along one axis.
  double nearest_image(std::size_t axis, double separation) const {
    return periodic[axis] ? separation - length[axis] * std::nearbyint(separation / length[axis]) : separation;
  }
  // The nearest image of a separation.
  Point nearest_image(const Point& d) const { return {nearest_image(0, d[0]), nearest_image(1, d[1]), nearest_image(2, d[2])}; }
  // x moved into the box by whole edges, 0 <= x < L; along an open axis x itself.
  double wrapped(std::size_t axis, double x) const {
    if (!periodic[axis]) return x;
    x -= length[axis] * std::floor(x / length[axis]);
    return x < length[axis] ? x : 0.0;  // rounding can leave x at the far face itself
  }
  // The shortest edge along a periodic axis, which limits what the minimum image sees; infinite if all axes are open.
  double shortest() const {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (periodic[axis]) shortest = std::min(shortest, length[axis]);
    return shortest;
  }
  friend bool operator==(const Box&, const Box&) = default;
};

}  // namespace lanescape
