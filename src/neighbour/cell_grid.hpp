#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/box.hpp"

namespace lanescape {

// Particles by the cell of a periodic grid they lie in. An axis with room for fewer than three cells has one.
class CellGrid {
 public:
  // Cells with edges of at least `shortest_edge`; at most about eight per particle.
  CellGrid(const Box& box, double shortest_edge, std::size_t particles);

  void insert(std::int32_t particle, const std::array<double, 3>& position);
  // Moves a particle that is in the grid.
  void move(std::int32_t particle, const std::array<double, 3>& position);
  // Calls visit(j) for every particle in the cell of `position` and those around it.
  template <class Visit>
  void for_each_near(const std::array<double, 3>& position, Visit visit) const {
    for (const std::uint32_t cell : cells_near(cell_of(position))) for_each_in(cell, visit);
  }

  std::size_t cells() const { return first_.size(); }
  // Calls visit(j) for every particle in a cell, in the order in which for_each_near() comes by them.
  template <class Visit>
  void for_each_in(std::size_t cell, Visit visit) const {
    for (std::int32_t j = first_[cell]; j >= 0; j = next_[static_cast<std::size_t>(j)]) visit(j);
  }
  // The cells that for_each_near() goes through for a position in this one, in that order.
  std::span<const std::uint32_t> cells_near(std::size_t cell) const { return {neighbours_.data() + cell * around_, around_}; }

 private:
  std::size_t cell_of(const std::array<double, 3>& position) const;

  Box box_;
  std::array<std::size_t, 3> cells_{};
  std::array<double, 3> cells_per_length_{};
  std::size_t around_ = 1;                 // 27, 9, 3 or 1
  std::vector<std::uint32_t> neighbours_;  // around_ cells for each cell, itself included
  std::vector<std::int32_t> first_, next_, previous_;
  std::vector<std::uint32_t> cell_;  // of each particle
};

}  // namespace lanescape
