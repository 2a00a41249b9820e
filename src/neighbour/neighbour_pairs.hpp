#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "kernel_table.hpp"

namespace lanescape {

// Pairs of particles as arrays of one length, an entry for each pair and direction, sorted by first, second and shift.
struct OrderedPairs {
  std::vector<std::size_t> first, second;
  std::vector<std::array<int, 3>> shift;          // boxes to add to the second particle's position as given
  std::vector<std::array<double, 3>> separation;  // r_second - r_first + shift . box
  std::vector<double> distance;                   // |separation|
};

// All pairs with distance < cutoff, a particle and its own images included. `positions`: 3N numbers x0 y0 z0 x1 ..., wrapped or
// not, in any unit of length that all arguments share. A kernel names candidates in single precision; separations and the
// decision are those of the formulas above in double precision, rounded one by one, so that no instruction set changes them.
// Throws Error(bad_input) where a number is not finite or out of range. O(N) at a given density.
OrderedPairs ordered_pairs(const Box& box, std::span<const double> positions, double cutoff, const kernels::KernelTable& table);

}  // namespace lanescape
