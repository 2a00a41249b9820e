#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lanescape {

// How unequally particles share a detour: per species the standard deviation of log10(g_j/DeltaR_j) over its particles, g_j the
// length of particle j's way along a path and DeltaR_j the distance between its ends. Particles that end where they began
// are left out; 0 for a species without any other.
std::vector<double> heterogeneity_widths(std::span<const double> path_lengths, std::span<const double> displacements,
                                         std::span<const int> species, std::size_t species_count);

}  // namespace lanescape
