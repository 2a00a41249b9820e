#include "path/segment_energies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lanescape {

double SegmentEnergies::largest(const AlignedArray& begin, double begin_energy, const AlignedArray& end, double end_energy) {
  landscape_->algebra().difference(chord_, end, begin);
  const std::size_t last = energies_.size() - 1;
  energies_.front() = begin_energy;
  energies_.back() = end_energy;
  for (std::size_t s = 1; s < last; ++s) energies_[s] = energy_at(begin, static_cast<double>(s) / static_cast<double>(last));
  if (!std::all_of(energies_.begin(), energies_.end(), [](double v) { return std::isfinite(v); }))
    return std::numeric_limits<double>::infinity();
  const auto highest = std::max_element(energies_.begin(), energies_.end());
  const auto s = std::clamp<std::size_t>(static_cast<std::size_t>(highest - energies_.begin()), 1, last - 1);
  const double vertex = offset_of_vertex(s);
  if (!(std::abs(vertex) > 0.0 && std::abs(vertex) < 1.0)) return *highest;
  return std::max(*highest, energy_at(begin, (static_cast<double>(s) + vertex) / static_cast<double>(last)));
}

double SegmentEnergies::energy_at(const AlignedArray& begin, double fraction) {
  landscape_->algebra().axpy(position_, begin, fraction, chord_);
  return landscape_->energy(position_);
}

// Where the parabola through sample s and its neighbours is highest, in spacings from s; 0 where it has no maximum.
double SegmentEnergies::offset_of_vertex(std::size_t s) const {
  const double curvature = energies_[s - 1] - 2.0 * energies_[s] + energies_[s + 1];
  return curvature < 0.0 ? 0.5 * (energies_[s - 1] - energies_[s + 1]) / curvature : 0.0;
}

}  // namespace lanescape
