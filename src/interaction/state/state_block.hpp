#pragma once

#include <vector>

#include "interaction/state/site_states.hpp"

// Shared by the parts that run kernels over a list.
namespace lanescape {

// Room for the rows of a block: a point for each, and a number for each of their states, twice.
struct BlockScratch {
  explicit BlockScratch(std::size_t states)
      : records(kernels::point_width * NeighbourList::block_rows),
        row_states(NeighbourList::block_rows * states),
        slopes(row_states.size()) {}
  AlignedArray records, row_states, slopes;
};

// Adds the records of a block's rows to the gradient.
void add_rows(const Sites& sites, const kernels::NeighbourRows& rows, const double* records, AlignedArray& gradient);
// Adds the sums of blocks in the order of blocks: the number of threads does not affect the bits.
void add_blocks(const std::vector<kernels::PairOutput>& blocks, StateSums& sums);

// Runs energy(input) or gradient(input, records, slopes, sums) on each block and adds what it gives; make_input(species, rows,
// states) makes the input.
template <class MakeInput, class Energy, class Gradient>
void add_kernel(Sites& sites, StateSums& sums, MakeInput make_input, Energy energy, Gradient gradient) {
  const auto& list = sites.list();
  const std::size_t states = sites.states();
  std::vector<kernels::PairOutput> blocks(list.block_count());
  const auto scratch = [states] { return BlockScratch(states); };
  sites.for_each_block(scratch, [&](std::size_t b, const kernels::NeighbourRows& rows, BlockScratch& own) {
    const auto input = make_input(list.species_of(b), rows, sites.states_of(rows, own.row_states.data()));
    if (sums.wanted == StateSums::Wanted::energy) {
      blocks[b].energy = energy(input);
      blocks[b].virial = 0.0;
      return;
    }
    gradient(input, own.records.data(), own.slopes.data(), blocks[b]);
    add_rows(sites, rows, own.records.data(), sums.gradient);
    for_each_row(list, rows, [&](std::size_t row, std::size_t slot) {
      for (std::size_t a = 0; a < states; ++a) sums.slopes[slot * states + a] += own.slopes[row * states + a];
    });
  });
  add_blocks(blocks, sums);
}

}  // namespace lanescape
