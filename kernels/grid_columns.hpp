#pragma once

#include "isa.hpp"
#include "simd/simd.hpp"
#include "views/grid.hpp"

// Which cells of a grid a sphere reaches, column by column. One square root per vector of columns gives how far the sphere reaches
// along z in each.
namespace lanescape::kernels::LANESCAPE_ISA {

// Bound on what single precision loses of a coordinate and on the rounding of a cell. Coordinates are at most the grid's extent,
// and the difference of two rounded ones is off by at most 2^-23 of it.
inline double grid_margin(const GridShape& grid, double reach) noexcept {
  const auto length = [&](std::size_t axis) { return grid.edge[axis] * static_cast<double>(grid.cells[axis]); };
  return 3e-7 * (reach + length(0) + length(1) + length(2));
}

inline std::size_t cell_along(const GridShape& grid, std::size_t axis, double x) noexcept {
  const double cell = (x - grid.low[axis]) * grid.cells_per_length[axis], last = static_cast<double>(grid.cells[axis] - 1);
  return cell > 0.0 ? static_cast<std::size_t>(cell < last ? cell : last) : 0;
}

// The squared distance of a position from cells along an axis. `from_low`: of the position.
inline Vector gap_squared(const GridShape& grid, std::size_t axis, double from_low, Vector cells) noexcept {
  const Vector edge = broadcast(grid.edge[axis]);
  const Vector beyond_face = broadcast(from_low) - cells * edge;
  const Vector gap = maximum(broadcast(0.0), maximum(broadcast(0.0) - beyond_face, beyond_face - edge));
  return gap * gap;
}

// How far a position lies from the low face of a grid, or from there the face that is nearest to it. Points outside are in the
// outermost cells: moved to the faces, as the position is, no two of them come to be further apart.
inline double from_low(const GridShape& grid, std::size_t axis, double position) noexcept {
  const double x = position - grid.low[axis], most = grid.edge[axis] * static_cast<double>(grid.cells[axis]);
  return x > 0.0 ? x < most ? x : most : 0.0;
}

// Calls visit(column, low, high) for every column within reach of a position; column is x cell * cells[1] + y cell, low and high
// are its first and last cell within reach. Stops and returns false as soon as a visit returns false.
template <class Visit>
inline bool for_each_column(const GridShape& grid, const double* position, double reach, Visit visit) noexcept {
  const std::size_t first_x = cell_along(grid, 0, position[0] - reach), last_x = cell_along(grid, 0, position[0] + reach);
  const std::size_t first_y = cell_along(grid, 1, position[1] - reach), last_y = cell_along(grid, 1, position[1] + reach);
  const double x = from_low(grid, 0, position[0]), y = from_low(grid, 1, position[1]);
  const Vector z = broadcast(from_low(grid, 2, position[2]) * grid.cells_per_length[2]);
  const Vector cells_per_length = broadcast(grid.cells_per_length[2]), last_z = broadcast(static_cast<double>(grid.cells[2] - 1));
  alignas(64) std::int32_t low[lanes], high[lanes];
  for (std::size_t cy = first_y; cy <= last_y; cy += lanes) {
    const Vector gap_y = gap_squared(grid, 1, y, count_from(static_cast<double>(cy)));
    const unsigned columns = bits(lanes_below(static_cast<std::ptrdiff_t>(last_y - cy + 1)));
    for (std::size_t cx = first_x; cx <= last_x; ++cx) {
      const Vector gap_x = gap_squared(grid, 0, x, broadcast(static_cast<double>(cx)));
      const Vector left = broadcast(reach * reach) - (gap_x + gap_y);
      const Vector half = square_root(maximum(left, broadcast(0.0))) * cells_per_length;
      store_truncated(low, maximum(z - half, broadcast(0.0)));
      store_truncated(high, minimum(z + half, last_z));
      for (unsigned mask = columns & ~bits(less(left, broadcast(0.0))); mask != 0; mask &= mask - 1U) {
        const auto c = static_cast<std::size_t>(__builtin_ctz(mask));
        if (!visit(cx * grid.cells[1] + cy + c, static_cast<std::size_t>(low[c]), static_cast<std::size_t>(high[c]))) return false;
      }
    }
  }
  return true;
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
