#pragma once

#include <vector>

#include "kernel_table.hpp"
#include "verification/kernel_checks.hpp"

namespace lanescape {

namespace tolerance {

// Collisions of growing spheres: how far from contact the pair is at the time found, relative to s, the coordinates and the
// distance flown. Times are not compared: kernel and reference round the growth differently, and the time of a grazing
// collision is as uncertain as the square root of that (measured 7.5e-17).
inline constexpr double growing_contact = 3.5e-16;

}  // namespace tolerance

// First collisions against the reference, the calendar against std::min_element.
std::vector<Deviation> verify_event_driven(const kernels::KernelTable& table);

}  // namespace lanescape
