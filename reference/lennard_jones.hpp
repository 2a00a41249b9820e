#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "reference/pair_sum.hpp"

/// The Lennard-Jones mixture, one use of pair_sum().
namespace lanescape::reference {

/// Pair parameters, each species x species, row-major and symmetric.
struct Mixture {
  std::size_t species = 1;
  std::vector<double> epsilon;  // [epsilon]
  std::vector<double> sigma;    // [sigma]
  std::vector<double> cutoff;   // [sigma], an absolute distance
};

/// Throws std::invalid_argument where sizes do not fit.
PairMixture lennard_jones_mixture(const Mixture& mixture, Truncation truncation);

/// Energy, virial and gradient of a Lennard-Jones mixture; arguments and errors as in pair_sum(). [G] Eqs. 3.1-3.3.
Evaluation lennard_jones(std::span<const double> positions, std::span<const int> species, const Vector& box, const Mixture& mixture,
                         ImageRule images, Truncation truncation);

}  // namespace lanescape::reference
