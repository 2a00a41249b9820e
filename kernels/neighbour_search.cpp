// Which points lie within reach of a position: all the work of building a neighbour list except sorting.
//
// The points of a column between two cells are one contiguous run. Runs are tested a vector at a time in single precision: most
// runs then fit one vector, and branch prediction foresees whether another follows.

#include "grid_columns.hpp"
#include "kernel_declarations.hpp"
#include "simd/simd.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
namespace {

struct Search {
  FloatVector x, y, z, reach_squared;
  std::uint32_t self;
};

// Appends offsets of the points in [begin, end) within reach.
inline std::size_t search_run(const PointGrid& grid, const Search& search, std::uint32_t begin, std::uint32_t end,
                              std::uint32_t* out) noexcept {
  std::size_t found = 0;
  for (std::uint32_t k = begin; k < end; k += float_lanes) {
    const FloatVector dx = load_unaligned(grid.x + k) - search.x, dy = load_unaligned(grid.y + k) - search.y,
                      dz = load_unaligned(grid.z + k) - search.z;
    std::uint32_t mask = bits(less(multiply_add(dz, dz, multiply_add(dy, dy, dx * dx)), search.reach_squared));
    if (end - k < float_lanes) mask &= (1U << (end - k)) - 1U;
    if (search.self - k < float_lanes) mask &= ~(1U << (search.self - k));  // unsigned: self < k gives a huge value
    found += compress_store_offsets(out + found, mask, k);
  }
  return found;
}

}  // namespace

std::size_t points_within(const PointGrid& grid, const NeighbourQuery& query, std::uint32_t* out, std::size_t capacity) noexcept {
  const double* position = query.position;
  const double reach = query.reach + grid_margin(grid, query.reach);
  const auto single = [](double x) { return broadcast<FloatVector>(static_cast<float>(x)); };
  const Search search{single(position[0]), single(position[1]), single(position[2]), single(reach * reach), query.self};
  std::size_t found = 0;
  const bool room = for_each_column(grid, position, reach, [&](std::size_t column, std::size_t low, std::size_t high) {
    const std::uint32_t* first = grid.first + column * grid.cells[2];
    const std::uint32_t begin = first[low], end = first[high + 1];
    if (found + (end - begin) + float_lanes > capacity) return false;
    found += search_run(grid, search, begin, end, out + found);
    return true;
  });
  return room ? found : capacity + 1;
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
