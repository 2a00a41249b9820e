// Which points lie within reach of one: all of the work of making a neighbour list but the sorting.
//
// For each row of columns of the grid, how far along z a column is within reach comes from one square root for a vector of columns.
// A column's points between two cells are one run, tested a vector at a time, in single precision: most runs are then one vector,
// and whether one more follows is foreseen.

#include "kernel_declarations.hpp"
#include "simd_ops.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
namespace {

struct Search {
  FloatVector x, y, z, reach_squared;
  std::uint32_t self;
};

// Appends places of the points in [begin, end) within reach.
inline std::size_t search_run(const PointGrid& grid, const Search& search, std::uint32_t begin, std::uint32_t end,
                              std::uint32_t* out) noexcept {
  std::size_t found = 0;
  for (std::uint32_t k = begin; k < end; k += float_lanes) {
    const FloatVector dx = subtract(load_anywhere(grid.x + k), search.x), dy = subtract(load_anywhere(grid.y + k), search.y),
                      dz = subtract(load_anywhere(grid.z + k), search.z);
    std::uint32_t mask = bits_less(square_plus(dz, square_plus(dy, multiply(dx, dx))), search.reach_squared);
    if (end - k < float_lanes) mask &= (1U << (end - k)) - 1U;
    if (search.self - k < float_lanes) mask &= ~(1U << (search.self - k));  // unsigned: below k is far above it
    found += store_set_places(out + found, mask, k);
  }
  return found;
}

inline std::size_t cell_along(const PointGrid& grid, std::size_t axis, double x) noexcept {
  const double cell = (x - grid.low[axis]) * grid.cells_per_length[axis], last = static_cast<double>(grid.cells[axis] - 1);
  return cell > 0.0 ? static_cast<std::size_t>(cell < last ? cell : last) : 0;
}

// How far a position is from cells along an axis, squared.
inline Vector gap_squared(const PointGrid& grid, std::size_t axis, double position, Vector cells) noexcept {
  const Vector edge = broadcast(grid.edge[axis]);
  const Vector beyond_face = broadcast(position - grid.low[axis]) - cells * edge;
  const Vector gap = maximum(broadcast(0.0), maximum(broadcast(0.0) - beyond_face, beyond_face - edge));
  return gap * gap;
}

}  // namespace

std::size_t points_within(const PointGrid& grid, const NeighbourQuery& query, std::uint32_t* out, std::size_t capacity) noexcept {
  const double *position = query.position, reach = query.reach;
  const auto cells = [&](std::size_t axis) { return static_cast<double>(grid.cells[axis]); };
  // Coordinates are up to this; the difference of two loses 2^-23 of it when both are rounded to single precision.
  const double extent = reach + grid.edge[0] * cells(0) + grid.edge[1] * cells(1) + grid.edge[2] * cells(2);
  const double cell_reach = reach + 3e-7 * extent;
  const auto single = [](double x) { return broadcast_float(static_cast<float>(x)); };
  const Search search{single(position[0]), single(position[1]), single(position[2]), single(cell_reach * cell_reach), query.self};
  const std::size_t first_x = cell_along(grid, 0, position[0] - cell_reach), last_x = cell_along(grid, 0, position[0] + cell_reach);
  const std::size_t first_y = cell_along(grid, 1, position[1] - cell_reach), last_y = cell_along(grid, 1, position[1] + cell_reach);
  const Vector z = broadcast((position[2] - grid.low[2]) * grid.cells_per_length[2]);
  const Vector cells_per_length = broadcast(grid.cells_per_length[2]), last_z = broadcast(cells(2) - 1.0);
  alignas(64) std::int32_t low[lanes], high[lanes];
  std::size_t found = 0;
  for (std::size_t cy = first_y; cy <= last_y; cy += lanes) {
    const Vector gap_y = gap_squared(grid, 1, position[1], count_from(static_cast<double>(cy)));
    const unsigned columns = bits(lanes_below(static_cast<std::ptrdiff_t>(last_y - cy + 1)));
    for (std::size_t cx = first_x; cx <= last_x; ++cx) {
      const Vector gap_x = gap_squared(grid, 0, position[0], broadcast(static_cast<double>(cx)));
      const Vector left = broadcast(cell_reach * cell_reach) - (gap_x + gap_y);
      const Vector half = square_root(maximum(left, broadcast(0.0))) * cells_per_length;
      store_truncated(low, maximum(z - half, broadcast(0.0)));
      store_truncated(high, minimum(z + half, last_z));
      const std::uint32_t* first = grid.first + (cx * grid.cells[1] + cy) * grid.cells[2];
      for (unsigned mask = columns & ~bits(less(left, broadcast(0.0))); mask != 0; mask &= mask - 1U) {
        const auto c = static_cast<std::size_t>(__builtin_ctz(mask));
        const std::uint32_t* column = first + c * grid.cells[2];
        const std::uint32_t begin = column[low[c]], end = column[high[c] + 1];
        if (found + (end - begin) + float_lanes > capacity) return capacity + 1;
        found += search_run(grid, search, begin, end, out + found);
      }
    }
  }
  return found;
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
