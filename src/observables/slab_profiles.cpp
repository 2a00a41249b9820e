#include "observables/slab_profiles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lanescape {
namespace {

// The centre of the slab is given by the phase of the longest-wavelength Fourier component of the density, which needs no special
// care at the periodic boundary.
double centre_of(const std::vector<double>& positions, double length) {
  double sine = 0.0, cosine = 0.0;
  for (std::size_t k = 2; k < positions.size(); k += 3) {
    sine += std::sin(2.0 * std::numbers::pi * positions[k] / length);
    cosine += std::cos(2.0 * std::numbers::pi * positions[k] / length);
  }
  return std::atan2(sine, cosine) * length / (2.0 * std::numbers::pi);
}

}  // namespace

SlabSampler::SlabSampler(const Box& box, std::size_t bins, std::size_t states)
    : box_(box), bins_(bins), states_(states), sites_(bins, 0.0), local_density_(bins, 0.0), probability_(states * bins, 0.0) {}

void SlabSampler::add(const std::vector<double>& positions, const ParticleLayout& layout, const StateMixture& interaction) {
  const double length = box_.length[2], centre = centre_of(positions, length);
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const double z = box_.wrapped(2, positions[3 * i + 2] - centre + 0.5 * length);
    const std::size_t bin = std::min(bins_ - 1, static_cast<std::size_t>(z / length * static_cast<double>(bins_)));
    const std::size_t slot = layout.slot_of(i);
    sites_[bin] += 1.0;
    local_density_[bin] += interaction.order_parameters()[slot];
    for (std::size_t a = 0; a < states_; ++a) probability_[a * bins_ + bin] += interaction.states().of(slot)[a];
  }
  ++samples_;
}

SlabProfiles SlabSampler::profiles() const {
  const std::vector<double> zeros(bins_, 0.0);
  SlabProfiles profiles{zeros, zeros, zeros, std::vector<std::vector<double>>(states_, zeros), sites_, samples_};
  const double bins = static_cast<double>(bins_), volume = box_.volume() / bins;
  for (std::size_t bin = 0; bin < bins_; ++bin) {
    profiles.z[bin] = ((static_cast<double>(bin) + 0.5) / bins - 0.5) * box_.length[2];
    if (sites_[bin] == 0.0) continue;
    profiles.density[bin] = sites_[bin] / (volume * static_cast<double>(samples_));
    profiles.local_density[bin] = local_density_[bin] / sites_[bin];
    for (std::size_t a = 0; a < states_; ++a) profiles.probability[a][bin] = probability_[a * bins_ + bin] / sites_[bin];
  }
  return profiles;
}

void SlabSampler::exchange(Archive& archive) {
  archive.field("samples", samples_);
  archive.field("sites", sites_);
  archive.field("local_density", local_density_);
  archive.field("probability", probability_);
}

}  // namespace lanescape
