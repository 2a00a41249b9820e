#pragma once

#include <vector>

#include "verification/cases.hpp"
#include "verification/kernel_checks.hpp"

namespace lanescape {

// Compares the pairs that the neighbour search of a table finds with the scalar reference: particles, shifts, separations and
// distances to the bit, sorted and in any order; and the neighbours in lists.
std::vector<Deviation> verify_neighbour_pairs(const kernels::KernelTable& table, const std::vector<PairCase>& cases);

}  // namespace lanescape
