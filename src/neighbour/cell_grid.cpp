#include "neighbour/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {

CellGrid::CellGrid(const Box& box, double shortest_edge, std::size_t particles)
    : box_(box), next_(particles, -1), previous_(particles, -1), cell_(particles, 0) {
  // Many more cells than particles would cost memory and gain nothing. Cells are cubes as nearly as they can be. Rounding must not
  // take a cell away where the number is whole.
  const double most_per_edge = 2.0 * std::cbrt(static_cast<double>(particles) / box.volume()) * (1.0 + 1e-12);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double most = std::max(3.0, std::min(most_per_edge * box.length[axis], static_cast<double>(particles)));
    cells_[axis] = static_cast<std::size_t>(std::min(box.length[axis] / shortest_edge, most));
    if (cells_[axis] < 3) cells_[axis] = 1;
    cells_per_length_[axis] = static_cast<double>(cells_[axis]) / box.length[axis];
  }
  first_.assign(cells_[0] * cells_[1] * cells_[2], -1);
}

void CellGrid::clear() { std::fill(first_.begin(), first_.end(), -1); }

CellGrid::NearCells CellGrid::cells_near(std::size_t cell) const {
  const std::array<std::size_t, 3> at = {cell / (cells_[1] * cells_[2]), cell / cells_[2] % cells_[1], cell % cells_[2]};
  std::array<std::array<std::size_t, 3>, 3> near{};  // per axis: the coordinate before, the cell's own, and the one after
  std::array<std::size_t, 3> count{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t c = at[axis], cells = cells_[axis];
    if (cells == 1) {
      count[axis] = 1;
    } else {
      near[axis] = {(c == 0 ? cells : c) - 1, c, c + 1 == cells ? 0 : c + 1};
      count[axis] = 3;
    }
  }
  NearCells found;
  for (std::size_t x = 0; x < count[0]; ++x)
    for (std::size_t y = 0; y < count[1]; ++y)
      for (std::size_t z = 0; z < count[2]; ++z)
        found.cells[found.count++] = static_cast<std::uint32_t>((near[0][x] * cells_[1] + near[1][y]) * cells_[2] + near[2][z]);
  return found;
}

std::size_t CellGrid::cell_of(const std::array<double, 3>& position) const {
  std::array<std::size_t, 3> c{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double x = position[axis];
    const double length = box_.length[axis];
    if (x < 0.0 || x >= length) x -= length * std::floor(x / length);
    // Rounding can leave x at the far face itself.
    c[axis] = std::min(static_cast<std::size_t>(x * cells_per_length_[axis]), cells_[axis] - 1);
  }
  return (c[0] * cells_[1] + c[1]) * cells_[2] + c[2];
}

void CellGrid::insert(std::int32_t particle, const std::array<double, 3>& position) {
  const std::size_t cell = cell_of(position);
  const auto p = static_cast<std::size_t>(particle);
  cell_[p] = static_cast<std::uint32_t>(cell);
  previous_[p] = -1;
  next_[p] = first_[cell];
  if (next_[p] >= 0) previous_[static_cast<std::size_t>(next_[p])] = particle;
  first_[cell] = particle;
}

void CellGrid::move(std::int32_t particle, const std::array<double, 3>& position) {
  const auto p = static_cast<std::size_t>(particle);
  if (cell_[p] == cell_of(position)) return;
  if (previous_[p] >= 0)
    next_[static_cast<std::size_t>(previous_[p])] = next_[p];
  else
    first_[cell_[p]] = next_[p];
  if (next_[p] >= 0) previous_[static_cast<std::size_t>(next_[p])] = previous_[p];
  insert(particle, position);
}

}  // namespace lanescape
