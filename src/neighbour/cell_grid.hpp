#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/prefetch.hpp"

namespace lanescape {

// Particles by the cell of a periodic grid they lie in. An axis with room for fewer than three cells has one.
class CellGrid {
 public:
  // Cells with edges of at least `shortest_edge`; at most about eight per particle.
  CellGrid(const Box& box, double shortest_edge, std::size_t particles);

  // Takes all particles out.
  void clear();
  void insert(std::int32_t particle, const std::array<double, 3>& position);
  // Moves a particle that is in the grid.
  void move(std::int32_t particle, const std::array<double, 3>& position);
  // Calls visit(j) for every particle in the cell of `position` and those around it.
  template <class Visit>
  void for_each_near(const std::array<double, 3>& position, Visit visit) const {
    const NearCells near = cells_near(cell_of(position));
    for (const std::uint32_t cell : near.all()) for_each_in(cell, visit);
  }

  std::size_t cells() const { return first_.size(); }
  // Calls visit(j) for every particle in a cell, in the order in which for_each_near() comes by them.
  template <class Visit>
  void for_each_in(std::size_t cell, Visit visit) const {
    for (std::int32_t j = first_[cell]; j >= 0; j = next_[static_cast<std::size_t>(j)]) visit(j);
  }
  // A cell and those around it: 27, 9, 3 or 1.
  struct NearCells {
    std::array<std::uint32_t, 27> cells;
    std::size_t count = 0;

    std::span<const std::uint32_t> all() const { return {cells.data(), count}; }
  };
  // The cells that for_each_near() goes through for a position in this one, in that order. A table of them would take more memory
  // than all else here.
  NearCells cells_near(std::size_t cell) const;
  std::size_t cell_of(const std::array<double, 3>& position) const;
  // The cell of a particle that is in the grid.
  std::size_t cell_with(std::size_t particle) const { return cell_[particle]; }
  // Fetches into the cache what for_each_in() reads first.
  [[gnu::always_inline]] void prefetch(std::size_t cell) const { lanescape::prefetch(&first_[cell]); }

 private:
  Box box_;
  std::array<std::size_t, 3> cells_{};
  std::array<double, 3> cells_per_length_{};
  std::vector<std::int32_t> first_, next_, previous_;
  std::vector<std::uint32_t> cell_;  // of each particle
};

}  // namespace lanescape
