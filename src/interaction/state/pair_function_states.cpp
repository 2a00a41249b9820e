#include "interaction/state/pair_function_states.hpp"

#include <cmath>
#include <utility>

namespace lanescape {

PairFunctionStates::PairFunctionStates(std::size_t species, double cutoff, Function u)
    : species_(species), cutoff_(cutoff), u_(std::move(u)) {}

void PairFunctionStates::add(Sites& sites, StateSums& sums) {
  const std::size_t states = sites.states(), slots = sites.layout().slots();
  const auto species_of = [&](std::size_t slot) {
    std::size_t s = species_ - 1;
    while (slot < sites.layout().blocks()[s].begin) --s;
    return s;
  };
  sites.for_each_pair([&](std::size_t i, std::size_t j, const Point& d) {
    const double r = std::hypot(d[0], d[1], d[2]);
    if (r >= cutoff_) return;
    const auto p_i = sites.site_states().of(i), p_j = sites.site_states().of(j);
    double slope = 0.0;
    for (std::size_t a = 0; a < states; ++a)
      for (std::size_t b = 0; b < states; ++b) {
        const Value u = u_(species_of(i), a, species_of(j), b, r);
        sums.energy += 0.5 * p_i[a] * p_j[b] * u.energy;
        sums.slopes[i * states + a] += p_j[b] * u.energy;
        slope += p_i[a] * p_j[b] * u.slope;
      }
    for (std::size_t axis = 0; axis < 3; ++axis) sums.gradient[axis * slots + i] += slope / r * d[axis];
    sums.add_virial(-slope / r, d, 0.5);
  });
}

}  // namespace lanescape
