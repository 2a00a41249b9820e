#pragma once

#include "loops/pair_vector.hpp"

// How the entries of a neighbour list are walked.
namespace lanescape::kernels::LANESCAPE_ISA {

// A list that does not fit a cache is prefetched so many entries ahead; the processor's own prefetching ends at each page.
constexpr std::size_t list_prefetch = 192;

// Entries that the neighbours of a row of one species take up in the list.
constexpr std::size_t padded_length(std::size_t count) { return (count + slot_padding - 1) / slot_padding * slot_padding; }

LANESCAPE_INLINE Displacement row_position(const NeighbourRows& list, std::size_t k) {
  const double* point = list.points + list.rows[k];
  return {broadcast(point[0]), broadcast(point[1]), broadcast(point[2])};
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
