#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lanescape {

// How unequally particles share a detour: per species, the standard deviation of log10(g_j/DeltaR_j) over its particles. g_j is the
// path length of particle j and DeltaR_j the distance between its ends. Particles that end where they began are skipped; the result
// is 0 for a species with no other particles.
std::vector<double> heterogeneity_widths(std::span<const double> path_lengths, std::span<const double> displacements,
                                         std::span<const int> species, std::size_t species_count);

}  // namespace lanescape
