#include "interaction/state/lennard_jones_states.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "interaction/state/state_block.hpp"

namespace lanescape {

LennardJonesStates::LennardJonesStates(StatePairs order, const std::vector<Pair>& pairs, std::vector<double> cutoffs)
    : order_(order), cutoffs_(std::move(cutoffs)) {
  const std::size_t per_species_pair = order.states * order.states;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const double s6 = std::pow(pairs[k].sigma, 6), c12 = 4.0 * pairs[k].epsilon * s6 * s6, c6 = 4.0 * pairs[k].epsilon * s6;
    const double inverse6 = std::pow(cutoffs_[k / per_species_pair], -6);
    pairs_.push_back({c12, c6, pairs[k].epsilon == 0.0 ? 0.0 : (c12 * inverse6 - c6) * inverse6});
  }
  for (std::size_t k = 0; k < cutoffs_.size(); ++k) {
    const auto first = pairs.begin() + static_cast<std::ptrdiff_t>(k * per_species_pair);
    const bool none = std::all_of(first, first + static_cast<std::ptrdiff_t>(per_species_pair),
                                  [](const Pair& pair) { return pair.epsilon == 0.0; });
    if (none) cutoffs_[k] = 0.0;
    cutoffs_squared_.push_back(cutoffs_[k] * cutoffs_[k]);
  }
}

void LennardJonesStates::add(Sites& sites, StateSums& sums) {
  const auto& table = sites.kernels();
  const auto input = [&](std::size_t s, const kernels::NeighbourRows& rows, const kernels::StateProbabilities& states) {
    return kernels::StateLjInput{rows, states, pairs_.data() + order_.at(s, 0, 0, 0), cutoffs_squared_.data() + s * order_.species};
  };
  const bool stress = sums.wanted == StateSums::Wanted::stress;
  add_kernel(sites, sums, input, table.state_lj_energy, stress ? table.state_lj_stress : table.state_lj_gradient);
}

}  // namespace lanescape
