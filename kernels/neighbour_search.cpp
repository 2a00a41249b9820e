// Which points lie within reach of a position: all the work of building a neighbour list except sorting; and sorting of few
// numbers.
//
// The points of a column between two cells are one contiguous run. Runs are tested a vector at a time in single precision: most
// runs then fit one vector, and branch prediction foresees whether another follows.

#include <cmath>

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

// The points that rows of a group look through: those within reach of the sphere that holds all rows.
struct Group {
  double centre[3], radius_squared;
  std::size_t points;
  std::uint32_t place[most_group_rows];  // of each row's own point among them
};

inline void enclose(const GroupQuery& query, Group& group) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = query.rows[0].position[axis], high = low;
    for (std::size_t row = 1; row < query.row_count; ++row) {
      const double x = query.rows[row].position[axis];
      low = x < low ? x : low;
      high = x > high ? x : high;
    }
    group.centre[axis] = 0.5 * (low + high);
  }
  group.radius_squared = 0.0;
  for (std::size_t row = 0; row < query.row_count; ++row) {
    double squared = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = query.rows[row].position[axis] - group.centre[axis];
      squared += d * d;
    }
    group.radius_squared = squared > group.radius_squared ? squared : group.radius_squared;
    group.place[row] = ~0U;
  }
}

// Copies the points in [begin, end) behind those of the group; up to a vector more is written.
inline void add_run(const PointGrid& grid, const GroupQuery& query, Group& group, std::uint32_t begin, std::uint32_t end) noexcept {
  for (std::uint32_t k = begin; k < end; k += float_lanes) {
    const std::size_t place = group.points + (k - begin);
    store_unaligned(query.x + place, load_unaligned(grid.x + k));
    store_unaligned(query.y + place, load_unaligned(grid.y + k));
    store_unaligned(query.z + place, load_unaligned(grid.z + k));
    __builtin_memcpy(query.found + place, query.numbers + k, float_lanes * sizeof *query.numbers);
  }
  for (std::size_t row = 0; row < query.row_count; ++row)
    if (query.rows[row].self - begin < end - begin)
      group.place[row] = static_cast<std::uint32_t>(group.points) + (query.rows[row].self - begin);
  group.points += end - begin;
}

// Writes the places of the points within reach, four times each; returns their number.
inline std::size_t search_group(const GroupQuery& query, const Group& group, const Search& search, FloatVector certain_squared,
                                std::uint32_t* out, std::uint8_t* doubtful) noexcept {
  std::size_t found = 0;
  std::uint32_t doubts = 0;
  const auto points = static_cast<std::uint32_t>(group.points);
  for (std::uint32_t k = 0; k < points; k += float_lanes) {
    const FloatVector dx = load_unaligned(query.x + k) - search.x, dy = load_unaligned(query.y + k) - search.y,
                      dz = load_unaligned(query.z + k) - search.z;
    const FloatVector squared = multiply_add(dz, dz, multiply_add(dy, dy, dx * dx));
    std::uint32_t mask = bits(less(squared, search.reach_squared));
    if (points - k < float_lanes) mask &= (1U << (points - k)) - 1U;
    if (search.self - k < float_lanes) mask &= ~(1U << (search.self - k));  // unsigned, as above
    doubts |= mask & ~bits(less(squared, certain_squared));
    found += compress_store_offsets(out + found, mask, k);
  }
  *doubtful = doubts != 0;
  return found;
}

}  // namespace

std::size_t points_within_group(const PointGrid& grid, const GroupQuery& query, const GroupOutput& out) noexcept {
  const double margin = grid_margin(grid, query.reach), reach = query.reach + margin;
  const double certain = query.certain > margin ? query.certain - margin : 0.0;
  Group group;
  group.points = 0;
  enclose(query, group);
  const bool room = for_each_column(grid, group.centre, reach + std::sqrt(group.radius_squared) * (1.0 + 1e-15),
                                    [&](std::size_t column, std::size_t low, std::size_t high) {
                                      const std::uint32_t* first = grid.first + column * grid.cells[2];
                                      const std::uint32_t begin = first[low], end = first[high + 1];
                                      if (group.points + (end - begin) + float_lanes > query.capacity) return false;
                                      add_run(grid, query, group, begin, end);
                                      return true;
                                    });
  if (!room) return out.capacity + 1;
  const auto single = [](double x) { return broadcast<FloatVector>(static_cast<float>(x)); };
  std::size_t written = 0;
  for (std::size_t row = 0; row < query.row_count; ++row) {
    if (written + group.points + float_lanes > out.capacity) return out.capacity + 1;
    const double* position = query.rows[row].position;
    const Search search{single(position[0]), single(position[1]), single(position[2]), single(reach * reach), group.place[row]};
    std::uint32_t* numbers = out.numbers + written;
    const std::size_t found = search_group(query, group, search, single(certain * certain), numbers, out.doubtful + row);
    for (std::size_t k = 0; k < found; ++k) numbers[k] = query.found[numbers[k] / 4];
    out.counts[row] = static_cast<std::uint32_t>(found);
    written += found;
  }
  return written;
}

void sort_few(const std::uint32_t* numbers, std::size_t n, std::uint32_t* sorted) noexcept {
  constexpr std::size_t width = 32;
  for (std::size_t begin = 0; begin < n; begin += width) {
    // The place of a number is the count of smaller ones.
    std::int32_t own[width], smaller[width] = {};
    __builtin_memcpy(own, numbers + begin, sizeof own);
    for (std::size_t k = 0; k < n; ++k) {
      const auto other = static_cast<std::int32_t>(numbers[k]);
      for (std::size_t lane = 0; lane < width; ++lane) smaller[lane] += other < own[lane];
    }
    const std::size_t count = n - begin < width ? n - begin : width;
    for (std::size_t lane = 0; lane < count; ++lane) sorted[smaller[lane]] = static_cast<std::uint32_t>(own[lane]);
  }
}

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
