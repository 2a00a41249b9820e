#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "interaction/pair/closest_pair.hpp"
#include "interaction/pair/pair_interaction.hpp"

namespace lanescape {

void check_separations(const Configuration& configuration, const PairModel& model) {
  for (std::size_t k = 0; k < configuration.positions.size(); ++k)
    if (!std::isfinite(configuration.positions[k]))
      throw_bad_input(fmt::format("particle {}: coordinate {} is not finite", k / 3, configuration.positions[k]));
  constexpr double allowed = 0.3;  // [sigma_ab]
  const double reach = allowed * *std::max_element(model.sigma.begin(), model.sigma.end());
  const ClosePair closest = closest_pair(configuration, reach, [&](std::size_t i, std::size_t j) {
    const auto& species = configuration.species;
    return model.sigma[model.pair(static_cast<std::size_t>(species[i]), static_cast<std::size_t>(species[j]))];
  });
  if (closest.ratio_squared < allowed * allowed)
    throw_bad_input(fmt::format("particles {} and {} overlap: their distance is {:.6g} sigma, at least {} is needed", closest.i,
                                closest.j, std::sqrt(closest.ratio_squared), allowed));
}

}  // namespace lanescape
