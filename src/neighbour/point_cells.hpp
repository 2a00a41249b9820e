#pragma once

#include <cstddef>

namespace lanescape {

// What is common to points that are sorted by the cells of a grid and searched by kernels.

// Cells are so wide that a run of cells has about this many points.
constexpr double points_per_run = 8.0;
// The number of points that a search may read beyond the last.
constexpr std::size_t read_ahead = 16;

// The cell of a coordinate along one axis, the first or last if it lies outside, the first for NaN.
inline std::size_t cell_along(double from_low, double cells_per_length, std::size_t cells) {
  const double cell = from_low * cells_per_length;
  if (!(cell > 0.0)) return 0;
  return cell < static_cast<double>(cells) ? static_cast<std::size_t>(cell) : cells - 1;
}

}  // namespace lanescape
