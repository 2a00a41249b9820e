#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

/// The arbiter: scalar, O(N^2), written from PHYSICS 1.1 and slow on purpose. Every kernel is judged against it.
namespace lanescape::reference {

enum class ImageRule {
  all,      // every periodic image within the cutoff, a particle's own images with weight 1/2
  minimum,  // per axis the nearest image only, whatever the ratio of cutoff and box
};

enum class Truncation {
  shifted,  // u(r) - u(cutoff) inside the cutoff
  plain,    // u(r) inside the cutoff
  tail,     // plain, and the integral over a uniform fluid beyond the cutoff
};

/// Pair parameters, each species x species, row-major and symmetric.
struct Mixture {
  std::size_t species = 1;
  std::vector<double> epsilon;  // [epsilon]
  std::vector<double> sigma;    // [sigma]
  std::vector<double> cutoff;   // [sigma], an absolute distance
};

struct Evaluation {
  double energy = 0.0;                    // [epsilon], tail included where asked
  double virial = 0.0;                    // [epsilon], sum of r.f over pairs, tail included where asked
  std::array<double, 6> virial_tensor{};  // [epsilon], sum of r_a f_b: xx yy zz yz xz xy; its trace is `virial`
  std::vector<double> gradient;           // [epsilon/sigma], 3N, +dV/dr as x0 y0 z0 x1 ...
  // What rounding scales with: the same sums with every term (each power, the shift, the tail) taken absolute.
  double magnitude = 0.0;                  // [epsilon], scale of a tolerance on `energy`
  std::vector<double> gradient_magnitude;  // [epsilon/sigma], 3N, scale of a tolerance on `gradient`
};

/// Energy, virial and gradient of a Lennard-Jones mixture in an orthorhombic, fully periodic box.
///
/// positions: 3N, interleaved, wrapped or not [sigma]; species: N, each in [0, mixture.species); box: edges [sigma].
/// Throws std::invalid_argument where sizes, species or box edges do not fit. A position that is not finite gives a
/// result that is not finite, unless N is 1. Source: [G] Eqs. 3.1-3.3; image rules and tail: PHYSICS 1.1.
Evaluation lennard_jones(std::span<const double> positions, std::span<const int> species,
                         const std::array<double, 3>& box, const Mixture& mixture, ImageRule images,
                         Truncation truncation);

}  // namespace lanescape::reference
