#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/aligned_array.hpp"
#include "core/random.hpp"
#include "core/run_monitor.hpp"
#include "run/path_search.hpp"

namespace lanescape {

// Moves single particles by up to 0.10 per axis, as long as that is allowed (soft: V <= E_L; hard: no overlap), until the
// configuration is more than 0.10 in 3N space from where it was ([G] 3.1.2.4); both in the model's unit of length. Positions are 3N
// numbers in the user's order. Empty if it never gets there; nothing if the monitor asks to stop. The random numbers are those of
// (step, particle), draws from 1 on.
std::optional<std::vector<double>> neighbour_configuration(const SearchSetup& setup, const std::vector<double>& from,
                                                           const CounterRandom& random, std::uint64_t step, std::uint32_t particle,
                                                           const RunMonitor& monitor);

// Positions in the user's order in the kinematic coordinates of a search.
AlignedArray kinematic_coordinates(const SearchSetup& setup, const std::vector<double>& positions);

}  // namespace lanescape
