#pragma once

#include <span>
#include <string_view>

#include "core/box.hpp"

namespace lanescape {

// All throw Error(bad_input).

// For an edge of a box outside this range, in any unit: beyond it volumes are not numbers.
inline constexpr double least_edge = 1e-100, greatest_edge = 1e100;
void check_edges(std::span<const double> edges);

// For a box with an open axis. `work`: what needs a periodic one, in the plural, such as "paths".
void check_periodic(const Box& box, std::string_view work);

// For a coordinate that is not finite; the second names the particle, for coordinates x0 y0 z0 x1 ...
void check_finite(std::span<const double> coordinates);
void check_finite_particles(std::span<const double> interleaved);

}  // namespace lanescape
