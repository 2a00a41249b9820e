#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <tuple>

#include "configuration/configuration.hpp"
#include "neighbour/sorted_cells.hpp"

namespace lanescape {

struct ClosePair {
  double ratio_squared = std::numeric_limits<double>::infinity();  // (r_ij / s_ij)^2
  std::size_t i = 0, j = 0;                                        // i < j

  friend bool operator<(const ClosePair& a, const ClosePair& b) {
    return std::tie(a.ratio_squared, a.i, a.j) < std::tie(b.ratio_squared, b.i, b.j);
  }
};

// The pair with the least r_ij / s_ij, nearest images, among those nearer than `reach` at least; the first of equals. s_ij is
// contact(i, j) [sigma]. O(N).
template <class ContactDistance>
ClosePair closest_pair(const Configuration& configuration, double reach, ContactDistance contact) {
  ClosePair closest;
  SortedCells(configuration, reach).for_each_pair([&](std::size_t a, std::size_t b, double) {
    const std::size_t i = std::min(a, b), j = std::max(a, b);
    double r2 = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = configuration.positions[3 * j + axis] - configuration.positions[3 * i + axis];
      const double nearest = configuration.box.nearest_image(axis, d);
      r2 += nearest * nearest;
    }
    const double s = contact(i, j);
    closest = std::min(closest, {r2 / s / s, i, j});  // s * s may underflow
  });
  return closest;
}

}  // namespace lanescape
