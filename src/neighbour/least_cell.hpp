#pragma once

#include <cmath>
#include <cstddef>

#include "core/box.hpp"

namespace lanescape {

// The edge of cubic cells of which a grid over a box and a margin around it has about four per point: few points get few cells, so
// that empty space does not cost memory.
inline double least_cell_edge(const Box& box, double margin, std::size_t points) {
  double volume = 1.0;
  for (const double length : box.length) volume *= length + 2.0 * margin;
  const double density = static_cast<double>(points) / box.volume();
  return std::cbrt(volume / (4.0 * density * volume + 64.0));
}

}  // namespace lanescape
