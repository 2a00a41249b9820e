#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "reference/images.hpp"
#include "reference/pair_potential.hpp"

/// The arbiter for pair potentials: scalar, O(N^2), written from PHYSICS 1.1 and slow on purpose. Every kernel is judged against
/// it.
namespace lanescape::reference {

/// One potential for each pair of species.
struct PairMixture {
  std::size_t species = 1;
  std::vector<PairPotential> potentials;  // species x species, row-major and symmetric

  const PairPotential& potential(int a, int b) const {
    return potentials[static_cast<std::size_t>(a) * species + static_cast<std::size_t>(b)];
  }
};

/// Particles in an orthorhombic box. The long-range correction takes its volume, whether axes are open or not.
struct Particles {
  std::span<const double> positions;  // 3N, interleaved, wrapped or not [sigma]
  std::span<const int> species;       // N, each in [0, mixture.species)
  Vector box{};                       // edges [sigma]
  std::span<const double> diameters;  // N for the polydisperse form, else empty [sigma]
  Periodic periodic = all_periodic;

  Vector position(std::size_t i) const { return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]}; }
};

struct Evaluation {
  double energy = 0.0;                    // [epsilon], tail included where asked
  double virial = 0.0;                    // [epsilon], sum of r.f over pairs, tail included where asked
  std::array<double, 6> virial_tensor{};  // [epsilon], sum of r_a f_b: xx yy zz yz xz xy; its trace is `virial`
  std::vector<double> energies;           // [epsilon], N: half of each pair of a particle, and its share of the tail
  std::vector<double> gradient;           // [epsilon/sigma], 3N, +dV/dr as x0 y0 z0 x1 ...
  // What rounding scales with: the same sums with every term (each power, the truncation, the tail) taken absolute.
  double magnitude = 0.0;                  // [epsilon], scale of a tolerance on `energy`
  std::vector<double> energies_magnitude;  // [epsilon], N, scale of a tolerance on `energies`
  double virial_magnitude = 0.0;           // [epsilon], scale of a tolerance on `virial`
  std::vector<double> gradient_magnitude;  // [epsilon/sigma], 3N, scale of a tolerance on `gradient`
};

/// Energy, virial and gradient. Throws std::invalid_argument where sizes, species, diameters, box edges or potentials do not fit. A
/// position that is not finite gives a result that is not finite, unless N is 1.
Evaluation pair_sum(const Particles& particles, const PairMixture& mixture, ImageRule images);

/// Throws as pair_sum() does.
void check(const Particles& particles, const PairMixture& mixture);

/// Particles of each species.
std::vector<double> species_counts(const Particles& particles, const PairMixture& mixture);

}  // namespace lanescape::reference
