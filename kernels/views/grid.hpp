#pragma once

#include <cstddef>
#include <cstdint>

// Points sorted by the cells of a grid.
namespace lanescape::kernels {

// The cells of a grid, z index fastest. A column is all cells with the same x and y.
struct GridShape {
  std::size_t cells[3];
  double low[3], edge[3];  // of the grid, of a cell [sigma]; points beyond a face belong to the cells at that face
  double cells_per_length[3];
};

// Points sorted by the cells of a grid, one array per coordinate, in single precision. A search uses a slightly larger radius to
// allow for rounding.
struct PointGrid : GridShape {
  const std::uint32_t* first;  // of each cell's points; one extra entry at the end
  const float *x, *y, *z;      // of all points; 16 entries past the end are readable
};

struct NeighbourQuery {
  double position[3];
  double reach;
  std::uint32_t self;  // index of the searching point, which is skipped
};

// A search for rows that are near each other, which look through the same points.
inline constexpr std::size_t most_group_rows = 16;

struct GroupRow {
  double position[3];
  std::uint32_t self;  // index of its own point, which is skipped
};

struct GroupQuery {
  const GroupRow* rows;
  std::size_t row_count;  // 1 to most_group_rows
  double reach, certain;  // from `reach` on, points are surely beyond the cutoff; below `certain`, within it
  // What is written of each point; 16 entries past the end are readable.
  const std::uint32_t* numbers;
  // Room for `capacity` points, overwritten.
  float *x, *y, *z;
  std::uint32_t* found;
  std::size_t capacity;
};

// The columns of a grid within reach of a rectangle in x and y: the first cell of each, and how far beyond the rectangle's z it is within
// reach, in cells. Arrays are given, with `capacity` a multiple of slot_padding; the rest is written.
struct NearColumns {
  std::uint32_t* first_cell;
  double* cells;
  std::size_t capacity;
  std::size_t count;
  double reach;  // with what allows for rounding
};

// Copies of a species' points that rows of a group look through. `capacity` and arrays are given, the rest is written.
struct NearPoints {
  float *x, *y, *z;
  std::uint32_t* numbers;
  std::size_t capacity;
  std::size_t count;
  double reach_squared;  // of the search
  std::uint32_t place[most_group_rows];  // of each row's own point among them, no_place where it is not
};
inline constexpr std::uint32_t no_place = ~0U;

struct GroupOutput {
  std::uint32_t* numbers;  // row after row
  std::size_t capacity;
  std::uint32_t* counts;   // of each row
  std::uint8_t* doubtful;  // of each row: whether some are between `certain` and `reach`
};

}  // namespace lanescape::kernels
