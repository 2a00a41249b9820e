#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "interaction/pair/closest_pair.hpp"
#include "interaction/pair/separations.hpp"

namespace lanescape {

void check_separations(const Configuration& configuration, const PairModel& model) {
  check_species(configuration.species, model.species.size());
  check_finite_particles(configuration.positions);
  const double allowed = model.form->smallest_separation;  // [sigma_ab]
  if (allowed == 0.0) return;
  const auto& diameters = configuration.diameters;
  const bool own_diameters = model.form->has_diameters && !diameters.empty();
  const auto& sizes = own_diameters ? diameters : model.sigma;
  const double reach = allowed * *std::max_element(sizes.begin(), sizes.end());
  const ClosePair closest = closest_pair(configuration, reach, [&](std::size_t i, std::size_t j) {
    if (own_diameters) return 0.5 * (diameters[i] + diameters[j]);
    const auto& species = configuration.species;
    return model.sigma[model.pair(static_cast<std::size_t>(species[i]), static_cast<std::size_t>(species[j]))];
  });
  if (closest.ratio_squared < allowed * allowed)
    throw_bad_input(fmt::format("particles {} and {} overlap: their distance is {:.6g} sigma, at least {} is needed", closest.i,
                                closest.j, std::sqrt(closest.ratio_squared), allowed));
}

}  // namespace lanescape
