#include "reference/pair_sum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace lanescape::reference {
namespace {

/// One image of the pair (i, j), d = r_i - r_j.
void add_pair(Evaluation& sum, std::size_t i, std::size_t j, const Vector& d, const PairPotential& potential) {
  const double r = std::sqrt(dot(d, d));
  const double weight = i == j ? 0.5 : 1.0;  // an own image is met twice, as d and as -d
  const PairValue pair = value(potential, r);
  sum.energy += weight * pair.u;
  sum.magnitude += weight * pair.u_magnitude;
  for (const std::size_t end : {i, j}) {
    sum.energies[end] += 0.5 * weight * pair.u;
    sum.energies_magnitude[end] += 0.5 * weight * pair.u_magnitude;
  }
  sum.virial -= weight * r * pair.slope;
  sum.virial_magnitude += weight * r * pair.slope_magnitude;

  const double slope_over_r = pair.slope / r;
  constexpr std::size_t voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  for (std::size_t k = 0; k < 6; ++k) sum.virial_tensor[k] -= weight * slope_over_r * d[voigt[k][0]] * d[voigt[k][1]];

  if (i == j) return;  // the forces of d and -d cancel
  const double magnitude_over_r = pair.slope_magnitude / r;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sum.gradient[3 * i + axis] += slope_over_r * d[axis];
    sum.gradient[3 * j + axis] -= slope_over_r * d[axis];
    sum.gradient_magnitude[3 * i + axis] += magnitude_over_r * std::abs(d[axis]);
    sum.gradient_magnitude[3 * j + axis] += magnitude_over_r * std::abs(d[axis]);
  }
}

/// Sum over a, b of 2 pi N_a N_b / V times the integrals over the potential beyond its cutoff.
void add_tail(Evaluation& sum, const Particles& particles, const PairMixture& mixture) {
  const std::vector<double> count = species_counts(particles, mixture);
  const double volume = particles.box[0] * particles.box[1] * particles.box[2];
  for (std::size_t a = 0; a < mixture.species; ++a)
    for (std::size_t b = 0; b < mixture.species; ++b) {
      const PairPotential& potential = mixture.potentials[a * mixture.species + b];
      if (potential.truncation != Truncation::tail) continue;
      const auto [energy, virial] = tail_integrals(potential);
      const double weight = 2.0 * std::numbers::pi * count[a] * count[b] / volume;
      sum.energy += weight * energy;
      sum.magnitude += std::abs(weight * energy);
      for (std::size_t i = 0; i < particles.species.size(); ++i) {
        if (static_cast<std::size_t>(particles.species[i]) != a) continue;
        sum.energies[i] += weight / count[a] * energy;
        sum.energies_magnitude[i] += std::abs(weight / count[a] * energy);
      }
      sum.virial += weight * virial;
      sum.virial_magnitude += std::abs(weight * virial);
      for (std::size_t axis = 0; axis < 3; ++axis) sum.virial_tensor[axis] += weight * virial / 3.0;
    }
}

void check_diameters(const Particles& particles, const PairMixture& mixture) {
  const bool needed = std::any_of(mixture.potentials.begin(), mixture.potentials.end(), [](const PairPotential& potential) {
    return std::holds_alternative<Polydisperse>(potential.form);
  });
  if (particles.diameters.size() != (needed ? particles.species.size() : 0))
    throw std::invalid_argument("pair sum: " + std::to_string(particles.diameters.size()) +
                                " diameters, the polydisperse form needs one for each particle and the others none");
  for (const double diameter : particles.diameters)
    if (!(diameter > 0.0) || !std::isfinite(diameter))
      throw std::invalid_argument("pair sum: diameter " + std::to_string(diameter) + " is not positive and finite");
}

}  // namespace

void check(const Particles& particles, const PairMixture& mixture) {
  if (mixture.potentials.size() != mixture.species * mixture.species)
    throw std::invalid_argument("pair sum: " + std::to_string(mixture.potentials.size()) + " potentials, species x species = " +
                                std::to_string(mixture.species * mixture.species) + " are needed");
  if (particles.positions.size() != 3 * particles.species.size())
    throw std::invalid_argument("pair sum: " + std::to_string(particles.positions.size()) + " coordinates for " +
                                std::to_string(particles.species.size()) + " particles, three each are needed");
  for (const int s : particles.species)
    if (s < 0 || static_cast<std::size_t>(s) >= mixture.species)
      throw std::invalid_argument("pair sum: species " + std::to_string(s) + " outside [0, " + std::to_string(mixture.species) +
                                  ")");
  for (const double edge : particles.box)
    if (!(edge > 0.0) || !std::isfinite(edge))
      throw std::invalid_argument("pair sum: box edge " + std::to_string(edge) + " is not positive and finite");
  for (const PairPotential& potential : mixture.potentials) check(potential);
  check_diameters(particles, mixture);
}

std::vector<double> species_counts(const Particles& particles, const PairMixture& mixture) {
  std::vector<double> count(mixture.species, 0.0);
  for (const int s : particles.species) count[static_cast<std::size_t>(s)] += 1.0;
  return count;
}

Evaluation pair_sum(const Particles& particles, const PairMixture& mixture, ImageRule images) {
  check(particles, mixture);
  Evaluation sum;
  sum.energies.assign(particles.species.size(), 0.0);
  sum.energies_magnitude.assign(particles.species.size(), 0.0);
  sum.gradient.assign(particles.positions.size(), 0.0);
  sum.gradient_magnitude.assign(particles.positions.size(), 0.0);
  for (std::size_t i = 0; i < particles.species.size(); ++i)
    for (std::size_t j = i; j < particles.species.size(); ++j) {
      PairPotential potential = mixture.potential(particles.species[i], particles.species[j]);
      if (!particles.diameters.empty()) potential = between(potential, particles.diameters[i], particles.diameters[j]);
      const double r_c = cutoff(potential);
      const Vector p = particles.position(i), q = particles.position(j);
      const Vector d{p[0] - q[0], p[1] - q[1], p[2] - q[2]};
      for_each_image(d, particles.box, particles.periodic, r_c, images, [&](const Image& image) {
        if (i == j && image.nearest) return;
        // A NaN goes on, so that it shows in the result.
        if (!(dot(image.separation, image.separation) >= r_c * r_c)) add_pair(sum, i, j, image.separation, potential);
      });
    }
  add_tail(sum, particles, mixture);
  return sum;
}

}  // namespace lanescape::reference
