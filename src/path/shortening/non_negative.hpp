#pragma once

#include <span>
#include <vector>

namespace lanescape {

// The x >= 0 that minimises |sum_c x_c a_c - b|, by the active set of Lawson and Hanson (Solving Least Squares Problems, 1974,
// chapter 23). The columns a_c are known by their products: `gram` holds a_c.a_d (n x n), `projections` a_c.b (n). Columns that
// depend on others are left at 0, so that x is one of the minima where there are several; sum_c x_c a_c is the same for all.
std::vector<double> non_negative_least_squares(std::span<const double> gram, std::span<const double> projections);

}  // namespace lanescape
