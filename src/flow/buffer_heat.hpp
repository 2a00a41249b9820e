#pragma once

#include <cstdint>
#include <span>

#include "core/random.hpp"
#include "dynamics/fluid_state.hpp"

// Heat of some particles of equal mass, whose momentum stays as it is. Both return what the particles gained [epsilon].
namespace lanescape {

// Scales velocities relative to their mean so that the particles gain `heat`, or lose at most half of their thermal energy.
double add_heat(FluidState& fluid, std::span<const std::size_t> particles, double mass, double heat);

// Andersen's thermostat (doi 10.1063/1.439486): draws a new thermal velocity, with this probability for each particle. Numbers
// follow from the number of the call and the particle.
double redraw_velocities(FluidState& fluid, std::span<const std::size_t> particles, double mass, double temperature,
                         double probability, const CounterRandom& random, std::uint64_t call);

}  // namespace lanescape
