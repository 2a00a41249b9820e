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

}  // namespace lanescape::kernels
