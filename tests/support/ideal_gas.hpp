#pragma once

#include <memory>

#include "flow/flow_state.hpp"

namespace lanescape::testing {

// Without interactions: p = rho T, e = 3/2 T, gamma = 5/3.
class IdealGas final : public EquationOfState {
 public:
  ThermodynamicState at_temperature(double density, double temperature) const override {
    return {density, temperature, 1.5 * temperature, density * temperature, 1.5, temperature, density};
  }
  std::optional<ThermodynamicState> at_energy(double density, double energy, double) const override {
    if (!(density > 0.0 && energy > 0.0)) return std::nullopt;
    return at_temperature(density, energy / 1.5);
  }
};

// Of density, velocity along x and pressure.
inline FlowState ideal_flow(double density, double velocity, double pressure) {
  return {IdealGas().at_temperature(density, pressure / density), {velocity, 0.0, 0.0}};
}

}  // namespace lanescape::testing
