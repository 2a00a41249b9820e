#pragma once

#include <cstddef>

#include "configuration/configuration.hpp"
#include "kernel_table.hpp"

namespace lanescape {

// r_ij - s_ij of two particles, nearest image [sigma].
double sphere_gap(const Configuration& configuration, std::size_t i, std::size_t j);
// Throws Error(bad_input) where a box edge is below twice the largest diameter: a sphere could touch two images of another.
void check_box_holds_spheres(const Configuration& configuration);
// The same check; also, where two spheres overlap, throws Error(bad_input) naming the deepest pair and its depth.
void check_no_overlap(const Configuration& configuration, const kernels::KernelTable& table);

}  // namespace lanescape
