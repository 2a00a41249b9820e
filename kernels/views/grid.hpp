#pragma once

#include <cstddef>
#include <cstdint>

// Points sorted by the cells of a grid.
namespace lanescape::kernels {

// The cells of a grid, running fastest along z; a column is the cells of one x and y.
struct GridShape {
  std::size_t cells[3];
  double low[3], edge[3];  // of the grid, of a cell [sigma]; points beyond a face are in the cells at it
  double cells_per_length[3];
};

// Points sorted by the cells of a grid; their coordinates in columns, in single precision: a search looks a little further to make
// up for it.
struct PointGrid : GridShape {
  const std::uint32_t* first;  // of each cell's points; one more at the end
  const float *x, *y, *z;      // of all points; 16 more than there are can be read
};

struct NeighbourQuery {
  double position[3];
  double reach;
  std::uint32_t self;  // not its own neighbour
};

}  // namespace lanescape::kernels
