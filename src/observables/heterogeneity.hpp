#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace lanescape {

// Sums over particles of x = log10(g_j/DeltaR_j); those of several paths can be added.
struct DetourSums {
  double count = 0.0, first = 0.0, second = 0.0;

  void add(double x) {
    count += 1.0;
    first += x;
    second += x * x;
  }
  DetourSums& operator+=(const DetourSums& other);
  // Standard deviation of x; 0 without particles.
  double width() const;
};

// x of a particle, or nothing for one that ends where it began.
std::optional<double> log_detour(double path_length, double displacement);

// How unequally particles share a detour: per species, the standard deviation of log10(g_j/DeltaR_j) over its particles. g_j is the
// path length of particle j and DeltaR_j the distance between its ends. Particles that end where they began are skipped; the result
// is 0 for a species with no other particles.
std::vector<double> heterogeneity_widths(std::span<const double> path_lengths, std::span<const double> displacements,
                                         std::span<const int> species, std::size_t species_count);

}  // namespace lanescape
