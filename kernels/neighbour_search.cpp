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

// Points [begin, end) of a grid.
struct Run {
  std::uint32_t begin, end;
};

// A coordinate beyond any reach: neither it nor a sum of squares with it is below any number.
constexpr float nowhere = __builtin_inff();

// The run that holds the own points of rows.
inline Run own_run(const GroupRow* rows, std::size_t row_count) noexcept {
  Run own{~0U, 0U};
  for (std::size_t row = 0; row < row_count; ++row) {
    const std::uint32_t self = rows[row].self;
    own = {self < own.begin ? self : own.begin, self < own.end ? own.end : self + 1};
  }
  return own;
}

// Copies runs of points behind each other. By pointers of its own: what is written might change others.
class PointCopy {
 public:
  PointCopy(const PointGrid& grid, const std::uint32_t* numbers, const GroupRow* rows, std::size_t row_count,
            NearPoints& near) noexcept
      : grid_{grid.x, grid.y, grid.z, numbers},
        near_{near.x, near.y, near.z, near.numbers},
        capacity_(near.capacity),
        rows_(rows),
        row_count_(row_count),
        own_(own_run(rows, row_count)),
        place_(near.place) {
    for (std::size_t row = 0; row < row_count; ++row) place_[row] = no_place;
  }

  // Up to a vector more is written. False where there may not be room.
  bool add(std::uint32_t begin, std::uint32_t end) noexcept {
    if (count_ + (end - begin) + float_lanes > capacity_) return false;
    std::size_t place = count_;
    for (std::uint32_t k = begin; k < end; k += float_lanes, place += float_lanes) {
      store_unaligned(near_.x + place, load_unaligned(grid_.x + k));
      store_unaligned(near_.y + place, load_unaligned(grid_.y + k));
      store_unaligned(near_.z + place, load_unaligned(grid_.z + k));
      __builtin_memcpy(near_.numbers + place, grid_.numbers + k, float_lanes * sizeof *grid_.numbers);
    }
    if (begin < own_.end && own_.begin < end) place_own(begin, end);
    count_ += end - begin;
    return true;
  }
  // What is looked at beyond the last point is out of reach.
  std::size_t close() noexcept {
    store_unaligned(near_.x + count_, broadcast<FloatVector>(nowhere));
    return count_;
  }

 private:
  void place_own(std::uint32_t begin, std::uint32_t end) noexcept {
    for (std::size_t row = 0; row < row_count_; ++row)
      if (const std::uint32_t k = rows_[row].self - begin; k < end - begin)  // unsigned: before `begin` it is huge
        place_[row] = static_cast<std::uint32_t>(count_) + k;
  }

  struct {
    const float *x, *y, *z;
    const std::uint32_t* numbers;
  } grid_;
  struct {
    float *x, *y, *z;
    std::uint32_t* numbers;
  } near_;
  std::size_t count_ = 0, capacity_;
  const GroupRow* rows_;
  std::size_t row_count_;
  Run own_;
  std::uint32_t* place_;
};

// The sphere that holds all rows of a group.
struct Sphere {
  double centre[3], radius;
};

inline Sphere sphere_around(const GroupRow* rows, std::size_t row_count) noexcept {
  Sphere sphere{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = rows[0].position[axis], high = low;
    for (std::size_t row = 1; row < row_count; ++row) {
      const double x = rows[row].position[axis];
      low = x < low ? x : low;
      high = x > high ? x : high;
    }
    sphere.centre[axis] = 0.5 * (low + high);
  }
  double radius_squared = 0.0;
  for (std::size_t row = 0; row < row_count; ++row) {
    double squared = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = rows[row].position[axis] - sphere.centre[axis];
      squared += d * d;
    }
    radius_squared = squared > radius_squared ? squared : radius_squared;
  }
  sphere.radius = std::sqrt(radius_squared) * (1.0 + 1e-15);
  return sphere;
}

inline bool copy_around(const PointGrid& grid, const GroupQuery& query, double reach, NearPoints& near) noexcept {
  const Sphere sphere = sphere_around(query.rows, query.row_count);
  PointCopy copy(grid, query.numbers, query.rows, query.row_count, near);
  const std::uint32_t* first = grid.first;
  const std::size_t cells = grid.cells[2];
  const bool room = for_each_column(grid, sphere.centre, reach + sphere.radius,
                                    [&](std::size_t column, std::size_t low, std::size_t high) {
                                      return copy.add(first[column * cells + low], first[column * cells + high + 1]);
                                    });
  near.reach_squared = reach * reach;
  if (room) near.count = copy.close();
  return room;
}

// Writes the numbers of the points within reach; returns how many they are.
template <bool with_doubts>
inline std::size_t search_near(const NearPoints& near, const double* position, double certain_squared, std::uint32_t* out,
                               std::uint8_t* doubtful) noexcept {
  const auto single = [](double v) { return broadcast<FloatVector>(static_cast<float>(v)); };
  const FloatVector row_x = single(position[0]), row_y = single(position[1]), row_z = single(position[2]);
  const FloatVector reach_squared = single(near.reach_squared), certain = single(certain_squared);
  const float *x = near.x, *y = near.y, *z = near.z;
  const std::uint32_t* numbers = near.numbers;
  const std::size_t count = near.count;
  std::uint32_t* next = out;
  std::uint32_t doubts = 0;
  for (std::size_t k = 0; k < count; k += float_lanes) {
    const FloatVector dx = load_unaligned(x + k) - row_x, dy = load_unaligned(y + k) - row_y, dz = load_unaligned(z + k) - row_z;
    const FloatVector squared = multiply_add(dz, dz, multiply_add(dy, dy, dx * dx));
    const std::uint32_t mask = bits(less(squared, reach_squared));
    if constexpr (with_doubts) doubts |= mask & ~bits(less(squared, certain));
    next += compress_store_wide(next, mask, numbers + k);
  }
  if constexpr (with_doubts) *doubtful = doubts != 0;
  return static_cast<std::size_t>(next - out);
}

// Calls search() while a row's own point is out of reach.
template <class Search>
inline std::size_t without_own(const NearPoints& near, std::size_t row, Search search) noexcept {
  if (near.place[row] == no_place) return search();
  float& own = near.x[near.place[row]];
  const float kept = own;
  own = nowhere;
  const std::size_t found = search();
  own = kept;
  return found;
}

}  // namespace

std::size_t columns_near_rectangle(const PointGrid& grid, const double* low, const double* high, double reach,
                                   NearColumns& columns) noexcept {
  const double wide = reach + grid_margin(grid, reach);
  const auto gap = [&](std::size_t axis, std::size_t cell) {
    const double face = grid.low[axis] + static_cast<double>(cell) * grid.edge[axis];
    const double above = face - high[axis], below = low[axis] - (face + grid.edge[axis]);
    return above > 0.0 ? above : below > 0.0 ? below : 0.0;
  };
  std::size_t count = 0;
  for (std::size_t cx = cell_along(grid, 0, low[0] - wide), last_x = cell_along(grid, 0, high[0] + wide); cx <= last_x; ++cx)
    for (std::size_t cy = cell_along(grid, 1, low[1] - wide), last_y = cell_along(grid, 1, high[1] + wide); cy <= last_y; ++cy) {
      const double x = gap(0, cx), y = gap(1, cy), left = wide * wide - (x * x + y * y);
      if (left < 0.0) continue;
      if (count == columns.capacity) return columns.capacity + 1;
      columns.first_cell[count] = static_cast<std::uint32_t>((cx * grid.cells[1] + cy) * grid.cells[2]);
      columns.cells[count++] = std::sqrt(left) * grid.cells_per_length[2];
    }
  columns.count = count;
  columns.reach = wide;
  return count;
}

std::size_t points_near_group(const PointGrid& grid, const NearColumns& columns, const GroupRow* rows, std::size_t row_count,
                              const std::uint32_t* numbers, NearPoints& near) noexcept {
  double low_z = rows[0].position[2], high_z = low_z;
  for (std::size_t row = 1; row < row_count; ++row) {
    const double z = rows[row].position[2];
    low_z = z < low_z ? z : low_z;
    high_z = z > high_z ? z : high_z;
  }
  const auto in_cells = [&](double z) { return broadcast((z - grid.low[2]) * grid.cells_per_length[2]); };
  const Vector lowest = in_cells(low_z), highest = in_cells(high_z), last = broadcast(static_cast<double>(grid.cells[2] - 1));
  PointCopy copy(grid, numbers, rows, row_count, near);
  const std::uint32_t* first = grid.first;
  alignas(64) std::int32_t low[lanes], high[lanes];
  for (std::size_t c = 0; c < columns.count; c += lanes) {
    const Vector cells = load(columns.cells + c);
    store_truncated(low, maximum(lowest - cells, broadcast(0.0)));
    store_truncated(high, minimum(highest + cells, last));
    const std::size_t end = columns.count - c < lanes ? columns.count - c : lanes;
    for (std::size_t k = 0; k < end; ++k) {
      const std::uint32_t* column = first + columns.first_cell[c + k];
      if (!copy.add(column[low[k]], column[high[k] + 1])) return near.capacity + 1;
    }
  }
  near.reach_squared = columns.reach * columns.reach;
  return near.count = copy.close();
}

std::size_t list_group(const GroupRow* rows, std::size_t row_count, const NearPoints* near, std::size_t species_count,
                       std::uint32_t* neighbours, std::uint32_t* lengths) noexcept {
  std::uint32_t* next = neighbours;
  for (std::size_t row = 0; row < row_count; ++row)
    for (std::size_t s = 0; s < species_count; ++s) {
      const std::size_t found =
          without_own(near[s], row, [&] { return search_near<false>(near[s], rows[row].position, 0.0, next, nullptr); });
      *lengths++ = static_cast<std::uint32_t>(found);
      for (std::size_t k = 0; k < slot_padding; ++k) next[found + k] = static_cast<std::uint32_t>(point_width) * rows[row].self;
      next += (found + slot_padding - 1) / slot_padding * slot_padding;
    }
  return static_cast<std::size_t>(next - neighbours);
}

std::size_t points_within_group(const PointGrid& grid, const GroupQuery& query, const GroupOutput& out) noexcept {
  const double margin = grid_margin(grid, query.reach), reach = query.reach + margin;
  const double certain = query.certain > margin ? query.certain - margin : 0.0;
  NearPoints near{query.x, query.y, query.z, query.found, query.capacity, 0, 0.0, {}};
  if (!copy_around(grid, query, reach, near)) return out.capacity + 1;
  std::size_t written = 0;
  for (std::size_t row = 0; row < query.row_count; ++row) {
    if (written + near.count + float_lanes > out.capacity) return out.capacity + 1;
    const std::size_t found = without_own(near, row, [&] {
      return search_near<true>(near, query.rows[row].position, certain * certain, out.numbers + written, out.doubtful + row);
    });
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
