#pragma once

#include <vector>

#include "kernel_table.hpp"
#include "verification/hard_sphere_cases.hpp"
#include "verification/kernel_checks.hpp"

namespace lanescape {

namespace tolerance {

// As in kernel_checks.hpp: four to five times the worst deviation measured over hard_sphere_cases() and the checks' own inputs.

// Fictitious forces, per particle and relative to the sum over its contacts of the largest force of the potential, s or s^2. Near
// contact the kernel's s - r and the reference's s (1 - r/s) are both differences of nearly equal numbers, exact to a rounding of
// s. The direction has a rounding of r and one of its quotient, and each sum one more (measured 4.0e-16).
inline constexpr double contact_force = 2e-15;

// Avoidance trials, relative to |position| + step; sums of unit forces, relative to the sum of the absolute terms. The expected
// values are computed in long double. The norm of all forces, a sum over 3N squares, loses most (measured 2.8e-16).
inline constexpr double avoidance = 1.4e-15;

}  // namespace tolerance

// Compares overlaps, lists, fictitious forces and avoidance trials of a table with the scalar reference.
std::vector<Deviation> verify_hard_spheres(const kernels::KernelTable& table, const std::vector<HardSphereCase>& cases);

}  // namespace lanescape
