#pragma once

#include <span>

namespace lanescape {

// All throw Error(bad_input).

// For an edge of a box outside this range, in any unit: beyond it volumes are not numbers.
inline constexpr double least_edge = 1e-100, greatest_edge = 1e100;
void check_edges(std::span<const double> edges);

// For a coordinate that is not finite; the second names the particle, for coordinates x0 y0 z0 x1 ...
void check_finite(std::span<const double> coordinates);
void check_finite_particles(std::span<const double> interleaved);

}  // namespace lanescape
