#include "flow/simple_wave.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace lanescape {
namespace {

ThermodynamicState fluid_in_wave(const EquationOfState& equation, double density, double temperature) {
  const ThermodynamicState fluid = equation.at_temperature(density, temperature);
  if (!fluid.stable())
    throw_bad_input(fmt::format("a wave of density {} has temperature {}, where the fluid is unstable: take a smaller amplitude",
                                density, temperature));
  return fluid;
}

}  // namespace

FlowState simple_wave(const EquationOfState& equation, const FlowState& undisturbed, double density) {
  constexpr int steps = 16;  // of the midpoint rule: 1e-5 of the change at an amplitude of 0.3
  FlowState state = undisturbed;
  const double start = undisturbed.fluid.density, step = (density - start) / steps;
  for (int k = 0; k < steps; ++k) {
    const double half = state.fluid.temperature + 0.5 * step * state.fluid.isentropic_slope();
    const ThermodynamicState middle = fluid_in_wave(equation, state.fluid.density + 0.5 * step, half);
    state.velocity[0] += step * middle.sound_velocity() / middle.density;
    state.fluid = fluid_in_wave(equation, start + (k + 1) * step, state.fluid.temperature + step * middle.isentropic_slope());
  }
  return state;
}

}  // namespace lanescape
