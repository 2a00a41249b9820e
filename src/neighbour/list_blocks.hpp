#pragma once

#include <cstddef>

#include "core/parallel.hpp"
#include "neighbour/neighbour_list.hpp"

namespace lanescape {

// Calls body(block, scratch) for each block of a list, shared by the list's threads; each of its parts makes one scratch. Which
// thread takes a block must not matter: keep one sum per block and add them in the order of blocks.
template <class MakeScratch, class Body>
void for_each_block(const NeighbourList& list, MakeScratch make_scratch, Body body) {
  for_each_block(list.threads(), list.parts(), [&](std::size_t part) {
    auto scratch = make_scratch();
    for (std::size_t b = list.first_block(part); b < list.first_block(part + 1); ++b) body(b, scratch);
  });
}

// Calls visit(row, slot) for each row of a block.
template <class Visit>
void for_each_row(const NeighbourList& list, const kernels::NeighbourRows& rows, Visit visit) {
  for (std::size_t row = 0; row < rows.row_count; ++row) visit(row, std::size_t{list.slot_at(rows.rows[row])});
}

}  // namespace lanescape
