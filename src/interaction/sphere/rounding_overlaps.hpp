#pragma once

#include "configuration/configuration.hpp"

namespace lanescape {

// Files written by others carry few digits, so that spheres in contact overlap a little.

// The one factor by which all radii must be multiplied so that no two spheres overlap: 1 where none do. It leaves a margin of
// 1e-12 for the rounding of whoever tests for overlaps later. Throws Error(bad_input) naming the deepest pair where its gap
// r_ij - s_ij is below -tolerance s_ij, and for a box with an edge below twice the largest diameter, in which the nearest image is
// not the only one that counts. O(N).
double rounding_overlap_factor(const Configuration& configuration, double tolerance);

// Scales the radii by this factor and returns it.
double remove_rounding_overlaps(Configuration& configuration, double tolerance);

}  // namespace lanescape
