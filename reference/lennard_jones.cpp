#include "reference/lennard_jones.hpp"

#include <stdexcept>
#include <string>

namespace lanescape::reference {

PairMixture lennard_jones_mixture(const Mixture& mixture, Truncation truncation) {
  const std::size_t pairs = mixture.species * mixture.species;
  if (mixture.epsilon.size() != pairs || mixture.sigma.size() != pairs || mixture.cutoff.size() != pairs)
    throw std::invalid_argument("lennard_jones: epsilon, sigma and cutoff need species x species = " + std::to_string(pairs) +
                                " entries");
  PairMixture result{mixture.species, {}};
  for (std::size_t ab = 0; ab < pairs; ++ab)
    result.potentials.push_back({LennardJones{mixture.epsilon[ab], mixture.sigma[ab]}, mixture.cutoff[ab], truncation});
  return result;
}

Evaluation lennard_jones(std::span<const double> positions, std::span<const int> species, const Vector& box, const Mixture& mixture,
                         ImageRule images, Truncation truncation) {
  return pair_sum({positions, species, box, {}}, lennard_jones_mixture(mixture, truncation), images);
}

}  // namespace lanescape::reference
