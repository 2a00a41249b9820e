#pragma once

#include <cstdint>

#include "configuration/configuration.hpp"
#include "configuration/lennard_jones_model.hpp"

namespace lanescape {

// `particles` on a face-centred cubic lattice in a cube of the given number density [sigma^-3], species drawn at random in the
// model's proportions (floor(N fraction) of each, the first takes the rest). Where N is not 4 n^3 the sites left empty are
// drawn at random too. Throws Error(bad_input) for zero or absurd counts and densities.
Configuration fcc_start(const LennardJonesModel& model, std::size_t particles, double density, std::uint64_t seed);

}  // namespace lanescape
