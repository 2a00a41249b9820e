#include "reference/lennard_jones.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace lanescape::reference {
namespace {

using Vector = std::array<double, 3>;

struct Powers {
  double twelve;  // 4 epsilon (sigma/r)^12
  double six;     // 4 epsilon (sigma/r)^6
};

Powers powers(const Mixture& mixture, std::size_t ab, double r_squared) {
  const double x = mixture.sigma[ab] * mixture.sigma[ab] / r_squared;
  const double x_cubed = x * x * x;
  return {4.0 * mixture.epsilon[ab] * x_cubed * x_cubed, 4.0 * mixture.epsilon[ab] * x_cubed};
}

void check(std::span<const double> positions, std::span<const int> species, const Vector& box,
           const Mixture& mixture) {
  const std::size_t pairs = mixture.species * mixture.species;
  if (mixture.epsilon.size() != pairs || mixture.sigma.size() != pairs || mixture.cutoff.size() != pairs)
    throw std::invalid_argument("lennard_jones: epsilon, sigma and cutoff need species x species = " +
                                std::to_string(pairs) + " entries");
  if (positions.size() != 3 * species.size())
    throw std::invalid_argument("lennard_jones: " + std::to_string(positions.size()) + " coordinates for " +
                                std::to_string(species.size()) + " particles, three each are needed");
  for (const int s : species)
    if (s < 0 || static_cast<std::size_t>(s) >= mixture.species)
      throw std::invalid_argument("lennard_jones: species " + std::to_string(s) + " outside [0, " +
                                  std::to_string(mixture.species) + ")");
  for (const double edge : box)
    if (!(edge > 0.0) || !std::isfinite(edge))
      throw std::invalid_argument("lennard_jones: box edge " + std::to_string(edge) + " is not positive and finite");
}

/// One image of the pair (i, j), d = r_i - r_j.
void add_pair(Evaluation& sum, std::size_t i, std::size_t j, const Vector& d, std::size_t ab, const Mixture& mixture,
              Truncation truncation) {
  const double r_squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  const double cutoff_squared = mixture.cutoff[ab] * mixture.cutoff[ab];
  if (r_squared >= cutoff_squared) return;  // a NaN goes on, so that it shows in the result

  const double weight = i == j ? 0.5 : 1.0;  // an own image is met twice, as d and as -d
  const auto [twelve, six] = powers(mixture, ab, r_squared);
  const Powers at_cutoff = powers(mixture, ab, cutoff_squared);
  const double shift = truncation == Truncation::shifted ? at_cutoff.twelve - at_cutoff.six : 0.0;
  sum.energy += weight * (twelve - six - shift);
  sum.magnitude += weight * (std::abs(twelve) + std::abs(six) + std::abs(shift));

  const double r_dot_f = 12.0 * twelve - 6.0 * six;  // -r du/dr
  const double f_over_r = r_dot_f / r_squared;
  sum.virial += weight * r_dot_f;
  sum.virial_tensor[0] += weight * f_over_r * d[0] * d[0];
  sum.virial_tensor[1] += weight * f_over_r * d[1] * d[1];
  sum.virial_tensor[2] += weight * f_over_r * d[2] * d[2];
  sum.virial_tensor[3] += weight * f_over_r * d[1] * d[2];
  sum.virial_tensor[4] += weight * f_over_r * d[0] * d[2];
  sum.virial_tensor[5] += weight * f_over_r * d[0] * d[1];

  if (i == j) return;  // the forces of d and -d cancel
  const double magnitude_over_r = (12.0 * std::abs(twelve) + 6.0 * std::abs(six)) / r_squared;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sum.gradient[3 * i + axis] -= f_over_r * d[axis];
    sum.gradient[3 * j + axis] += f_over_r * d[axis];
    sum.gradient_magnitude[3 * i + axis] += magnitude_over_r * std::abs(d[axis]);
    sum.gradient_magnitude[3 * j + axis] += magnitude_over_r * std::abs(d[axis]);
  }
}

/// sum over a, b of 2 pi N_a N_b / V times the integral from the cutoff to infinity of r^2 u (energy) and of
/// r^2 (-r du/dr) (virial). The integral of r^2 r^-n is cutoff^(3-n)/(n-3), hence the factors 1/9 and 1/3 below.
void add_tail(Evaluation& sum, std::span<const int> species, const Vector& box, const Mixture& mixture) {
  std::vector<double> count(mixture.species, 0.0);
  for (const int s : species) count[static_cast<std::size_t>(s)] += 1.0;
  const double volume = box[0] * box[1] * box[2];
  for (std::size_t a = 0; a < mixture.species; ++a)
    for (std::size_t b = 0; b < mixture.species; ++b) {
      const std::size_t ab = a * mixture.species + b;
      const double cutoff = mixture.cutoff[ab];
      const auto [twelve, six] = powers(mixture, ab, cutoff * cutoff);
      const double weight = 2.0 * std::numbers::pi * count[a] * count[b] / volume * cutoff * cutoff * cutoff;
      sum.energy += weight * (twelve / 9.0 - six / 3.0);
      sum.magnitude += weight * (std::abs(twelve) / 9.0 + std::abs(six) / 3.0);
      const double virial = weight * (12.0 * twelve / 9.0 - 6.0 * six / 3.0);
      sum.virial += virial;
      for (std::size_t axis = 0; axis < 3; ++axis) sum.virial_tensor[axis] += virial / 3.0;
    }
}

}  // namespace

Evaluation lennard_jones(std::span<const double> positions, std::span<const int> species, const Vector& box,
                         const Mixture& mixture, ImageRule images, Truncation truncation) {
  check(positions, species, box, mixture);
  Evaluation sum;
  sum.gradient.assign(positions.size(), 0.0);
  sum.gradient_magnitude.assign(positions.size(), 0.0);

  for (std::size_t i = 0; i < species.size(); ++i)
    for (std::size_t j = i; j < species.size(); ++j) {
      const std::size_t ab =
          static_cast<std::size_t>(species[i]) * mixture.species + static_cast<std::size_t>(species[j]);
      Vector nearest;
      std::array<int, 3> reach;  // |nearest| <= L/2, so an image within the cutoff is at most this many boxes away
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = positions[3 * i + axis] - positions[3 * j + axis];
        nearest[axis] = d - box[axis] * std::nearbyint(d / box[axis]);
        reach[axis] =
            images == ImageRule::minimum ? 0 : static_cast<int>(std::ceil(mixture.cutoff[ab] / box[axis] + 0.5));
      }
      for (int x = -reach[0]; x <= reach[0]; ++x)
        for (int y = -reach[1]; y <= reach[1]; ++y)
          for (int z = -reach[2]; z <= reach[2]; ++z) {
            if (i == j && x == 0 && y == 0 && z == 0) continue;
            add_pair(sum, i, j, {nearest[0] + x * box[0], nearest[1] + y * box[1], nearest[2] + z * box[2]}, ab,
                     mixture, truncation);
          }
    }
  if (truncation == Truncation::tail) add_tail(sum, species, box, mixture);
  return sum;
}

}  // namespace lanescape::reference
