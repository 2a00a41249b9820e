#pragma once

#include "configuration/configuration.hpp"

namespace lanescape {

// Files by other programs have few digits, so that spheres in contact overlap slightly.

// The one factor by which all radii must be multiplied so that no two spheres overlap: 1 where none do. It leaves a margin of
// 1e-12 for rounding in later overlap tests. Throws Error(bad_input) naming the deepest pair where its gap
// r_ij - s_ij is below -tolerance s_ij, and for a box with an edge below twice the largest diameter, in which the nearest image is
// not the only one that counts. O(N).
double rounding_overlap_factor(const Configuration& configuration, double tolerance);

// Scales the radii by this factor and returns it.
double remove_rounding_overlaps(Configuration& configuration, double tolerance);

}  // namespace lanescape
