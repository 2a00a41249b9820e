#pragma once

#include "configuration/pair_model.hpp"

namespace lanescape {

// What a uniform fluid beyond the cutoff adds to the energy, and to the virial sum r.f, for each N_a N_b; the sum runs over a and
// b, each pair of species in both orders [epsilon].
PairTail long_range(const PairModel& model, std::size_t a, std::size_t b, double volume);

}  // namespace lanescape
