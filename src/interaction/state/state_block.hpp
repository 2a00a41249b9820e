#pragma once

#include <vector>

#include "interaction/state/site_states.hpp"

// What parts that run kernels over a list share.
namespace lanescape {

// What a block's rows need: a point for each, and a number for each of their states, twice.
struct BlockScratch {
  explicit BlockScratch(std::size_t states)
      : records(kernels::point_width * NeighbourList::block_rows),
        row_states(NeighbourList::block_rows * states),
        slopes(row_states.size()) {}
  AlignedArray records, row_states, slopes;
};

// Adds points of a block's rows to the gradient.
void add_rows(const Sites& sites, const kernels::NeighbourRows& rows, const double* records, AlignedArray& gradient);
// Adds the sums of blocks, one after the other whoever made them.
void add_blocks(const std::vector<kernels::PairOutput>& blocks, StateSums& sums);

}  // namespace lanescape
