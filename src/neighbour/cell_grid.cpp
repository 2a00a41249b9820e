#include "neighbour/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {

CellGrid::CellGrid(const Box& box, double shortest_edge, std::size_t particles)
    : box_(box), next_(particles, -1), previous_(particles, -1), cell_(particles, 0) {
  // Many more cells than particles would cost memory and gain nothing. Cells are cubes as nearly as they can be. Rounding must not
  // take a cell away where the number is whole.
  const double most_per_edge = 2.0 * std::cbrt(static_cast<double>(particles) / box.volume()) * (1.0 + 1e-12);
  std::array<std::size_t, 3> reach{};  // cells to each side
  around_ = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double most = std::max(3.0, std::min(most_per_edge * box.length[axis], static_cast<double>(particles)));
    cells_[axis] = static_cast<std::size_t>(std::min(box.length[axis] / shortest_edge, most));
    if (cells_[axis] < 3) cells_[axis] = 1;
    reach[axis] = cells_[axis] == 1 ? 0 : 1;
    around_ *= 2 * reach[axis] + 1;
    cells_per_length_[axis] = static_cast<double>(cells_[axis]) / box.length[axis];
  }
  const std::size_t count = cells_[0] * cells_[1] * cells_[2];
  first_.assign(count, -1);
  neighbours_.reserve(count * around_);
  for (std::size_t x = 0; x < cells_[0]; ++x)
    for (std::size_t y = 0; y < cells_[1]; ++y)
      for (std::size_t z = 0; z < cells_[2]; ++z)
        for (std::size_t dx = 0; dx <= 2 * reach[0]; ++dx)
          for (std::size_t dy = 0; dy <= 2 * reach[1]; ++dy)
            for (std::size_t dz = 0; dz <= 2 * reach[2]; ++dz) {
              const auto wrapped = [&](std::size_t c, std::size_t d, std::size_t axis) {
                return (c + cells_[axis] + d - reach[axis]) % cells_[axis];
              };
              neighbours_.push_back(
                  static_cast<std::uint32_t>((wrapped(x, dx, 0) * cells_[1] + wrapped(y, dy, 1)) * cells_[2] + wrapped(z, dz, 2)));
            }
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
