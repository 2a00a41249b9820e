#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/box.hpp"

namespace lanescape {

// Particles by the cell of a periodic grid they lie in. Where the box has fewer than three cells along an axis there is one cell
// only: everything is near everything.
class CellGrid {
 public:
  // Cells with edges of at least `shortest_edge`; at most about one per particle.
  CellGrid(const Box& box, double shortest_edge, std::size_t particles);

  void insert(std::int32_t particle, const std::array<double, 3>& position);
  // Moves a particle that is in the grid.
  void move(std::int32_t particle, const std::array<double, 3>& position);
  // Calls visit(j) for every particle in the cell of `position` and those around it.
  template <class Visit>
  void for_each_near(const std::array<double, 3>& position, Visit visit) const {
    const std::size_t cell = cell_of(position);
    for (std::size_t k = cell * around_; k < (cell + 1) * around_; ++k)
      for (std::int32_t j = first_[neighbours_[k]]; j >= 0; j = next_[static_cast<std::size_t>(j)]) visit(j);
  }

 private:
  std::size_t cell_of(const std::array<double, 3>& position) const;

  Box box_;
  std::array<std::size_t, 3> cells_{};
  std::array<double, 3> cells_per_length_{};
  std::size_t around_ = 1;                 // 27, or 1
  std::vector<std::uint32_t> neighbours_;  // around_ cells for each cell, itself included
  std::vector<std::int32_t> first_, next_, previous_;
  std::vector<std::uint32_t> cell_;  // of each particle
};

}  // namespace lanescape
