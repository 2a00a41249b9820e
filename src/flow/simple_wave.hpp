#pragma once

#include "flow/flow_state.hpp"

namespace lanescape {

// The state of density `density` in a sound wave that goes to the right through `undisturbed`: along an isentrope
// du = c d rho/rho, which is exact for any amplitude. Throws Error(bad_input) where the wave leaves the equation of state or the
// fluid becomes unstable.
FlowState simple_wave(const EquationOfState& equation, const FlowState& undisturbed, double density);

}  // namespace lanescape
