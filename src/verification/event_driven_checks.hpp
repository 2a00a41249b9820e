#pragma once

#include <vector>

#include "kernel_table.hpp"
#include "verification/kernel_checks.hpp"

namespace lanescape {

namespace tolerance {

// Collisions of growing spheres: deviation of the pair from contact at the computed time, relative to s, the coordinates and the
// distance flown. Times are not compared, because kernel and reference round the growth differently, and the time of a grazing
// collision is uncertain by the square root of this rounding (measured 7.5e-17).
inline constexpr double growing_contact = 3.5e-16;

}  // namespace tolerance

// Compares first collisions with the reference, and the calendar with std::min_element.
std::vector<Deviation> verify_event_driven(const kernels::KernelTable& table);

}  // namespace lanescape
