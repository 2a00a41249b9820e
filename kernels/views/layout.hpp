#pragma once

#include <cstddef>

// How the library lays out its arrays, for all kernels. A kernel never owns, allocates or throws.
namespace lanescape::kernels {

// Slots per padding unit: every species block starts at a multiple of it and the length of every array is a multiple of it, so the
// widest vectors (8 doubles) need no remainder loop. Padding slots hold zeros and are masked out of every sum.
inline constexpr std::size_t slot_padding = 8;

// Alignment of every array a kernel reads or writes [bytes].
inline constexpr std::size_t array_alignment = 64;

// The particles of one species: slots [begin, begin + count).
struct SpeciesBlock {
  std::size_t begin;
  std::size_t count;
};

// Sums over the particles j of one displacement: sum |dr_j|^2 and sum |dr_j|^4.
struct DisplacementMoments {
  double second;
  double fourth;
};

}  // namespace lanescape::kernels
