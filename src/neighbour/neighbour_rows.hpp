#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/padded.hpp"
#include "views/pair.hpp"

namespace lanescape {

// Calls visit(row, species, offsets) for each row of a block and each species: the offsets of that row's neighbours of that species
// in rows.points.
template <class Visit>
void for_each_segment(const kernels::NeighbourRows& rows, Visit visit) {
  const std::uint32_t *offsets = rows.neighbours, *length = rows.lengths;
  for (std::size_t row = 0; row < rows.row_count; ++row)
    for (std::size_t species = 0; species < rows.species_count; ++species, ++length) {
      visit(row, species, std::span<const std::uint32_t>(offsets, *length));
      offsets += padded(*length);
    }
}

// Calls visit(row, species, offset) for each neighbour of each row.
template <class Visit>
void for_each_neighbour(const kernels::NeighbourRows& rows, Visit visit) {
  for_each_segment(rows, [&](std::size_t row, std::size_t species, std::span<const std::uint32_t> offsets) {
    for (const std::uint32_t offset : offsets) visit(row, species, offset);
  });
}

}  // namespace lanescape
