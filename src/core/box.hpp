#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/point.hpp"

namespace lanescape {

// An orthorhombic box, periodic along all three axes.
struct Box {
  Point length{};  // [sigma]

  double volume() const { return length[0] * length[1] * length[2]; }
  // The nearest image of a separation along one axis.
  double nearest_image(std::size_t axis, double separation) const {
    return separation - length[axis] * std::nearbyint(separation / length[axis]);
  }
  // The nearest image of a separation.
  Point nearest_image(const Point& d) const { return {nearest_image(0, d[0]), nearest_image(1, d[1]), nearest_image(2, d[2])}; }
  // x moved into the box by whole edges: 0 <= x < L.
  double wrapped(std::size_t axis, double x) const {
    x -= length[axis] * std::floor(x / length[axis]);
    return x < length[axis] ? x : 0.0;  // rounding can leave x at the far face itself
  }
  double shortest() const { return *std::min_element(length.begin(), length.end()); }
  friend bool operator==(const Box&, const Box&) = default;
};

}  // namespace lanescape
