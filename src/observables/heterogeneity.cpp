#include "observables/heterogeneity.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {

std::vector<double> heterogeneity_widths(std::span<const double> path_lengths, std::span<const double> displacements,
                                         std::span<const int> species, std::size_t species_count) {
  struct Sums {
    double count = 0.0, first = 0.0, second = 0.0;
  };
  std::vector<Sums> sums(species_count);
  for (std::size_t j = 0; j < species.size(); ++j) {
    if (!(displacements[j] > 0.0 && path_lengths[j] > 0.0)) continue;
    const double x = std::log10(path_lengths[j] / displacements[j]);
    Sums& s = sums[static_cast<std::size_t>(species[j])];
    s.count += 1.0;
    s.first += x;
    s.second += x * x;
  }
  std::vector<double> widths;
  for (const Sums& s : sums) {
    const double mean = s.count > 0.0 ? s.first / s.count : 0.0;
    widths.push_back(s.count > 0.0 ? std::sqrt(std::max(0.0, s.second / s.count - mean * mean)) : 0.0);
  }
  return widths;
}

}  // namespace lanescape
