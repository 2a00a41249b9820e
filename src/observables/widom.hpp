#pragma once

#include <cstdint>

#include "core/random.hpp"
#include "interaction/pair/probe_field.hpp"

namespace lanescape {

// Excess chemical potential of a fluid at temperature T from test particles at random positions, -T ln <exp(-U/T)> [epsilon]:
// Widom, J. Chem. Phys. 39, 2808 (1963), doi 10.1063/1.1734110. `step` numbers the configuration: each one gets different random
// positions.
double widom_chemical_potential(const ProbeField& fluid, double temperature, std::uint64_t probes, const CounterRandom& random,
                                std::uint64_t step);

}  // namespace lanescape
