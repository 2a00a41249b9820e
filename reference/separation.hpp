#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

#include "reference/vector.hpp"

/// Nearest images and checks of input, for overlaps and flights of hard spheres.
namespace lanescape::reference {

/// Nearest image of to - from.
inline Vector separation(const double* from, const double* to, const Vector& box) {
  Vector d;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    d[axis] = to[axis] - from[axis];
    d[axis] = d[axis] - box[axis] * std::nearbyint(d[axis] / box[axis]);
  }
  return d;
}

inline void check_box(const Vector& box) {
  for (const double edge : box)
    if (!(edge > 0.0) || !std::isfinite(edge))
      throw std::invalid_argument("hard_sphere: box edge " + std::to_string(edge) + " is not positive and finite");
}

inline void check(std::span<const double> positions, std::span<const double> radii, const Vector& box) {
  check_box(box);
  if (positions.size() != 3 * radii.size())
    throw std::invalid_argument("hard_sphere: " + std::to_string(positions.size()) + " coordinates for " +
                                std::to_string(radii.size()) + " particles, three each are needed");
  for (const double radius : radii)
    if (!(radius >= 0.0) || !std::isfinite(radius))
      throw std::invalid_argument("hard_sphere: radius " + std::to_string(radius) + " is negative or not finite");
}

}  // namespace lanescape::reference
