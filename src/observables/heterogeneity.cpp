#include "observables/heterogeneity.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {

DetourSums& DetourSums::operator+=(const DetourSums& other) {
  count += other.count;
  first += other.first;
  second += other.second;
  return *this;
}

double DetourSums::width() const {
  const double mean = count > 0.0 ? first / count : 0.0;
  return count > 0.0 ? std::sqrt(std::max(0.0, second / count - mean * mean)) : 0.0;
}

std::optional<double> log_detour(double path_length, double displacement) {
  if (!(displacement > 0.0 && path_length > 0.0)) return std::nullopt;
  return std::log10(path_length / displacement);
}

std::vector<double> heterogeneity_widths(std::span<const double> path_lengths, std::span<const double> displacements,
                                         std::span<const int> species, std::size_t species_count) {
  std::vector<DetourSums> sums(species_count);
  for (std::size_t j = 0; j < species.size(); ++j)
    if (const auto x = log_detour(path_lengths[j], displacements[j])) sums[static_cast<std::size_t>(species[j])].add(*x);
  std::vector<double> widths;
  for (const DetourSums& s : sums) widths.push_back(s.width());
  return widths;
}

}  // namespace lanescape
