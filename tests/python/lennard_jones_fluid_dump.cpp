#include <cstdio>
#include <iostream>

#include "flow/lennard_jones_fluid.hpp"

// Reads lines of density, temperature and cutoff (0: none). Writes pressure, excess energy, heat capacity, both derivatives of
// pressure, sound velocity and residual Helmholtz energy of each.
int main() {
  double density = 0.0, temperature = 0.0, cutoff = 0.0;
  while (std::cin >> density >> temperature >> cutoff) {
    const lanescape::LennardJonesFluid fluid = cutoff > 0.0 ? lanescape::LennardJonesFluid(cutoff) : lanescape::LennardJonesFluid();
    const lanescape::ThermodynamicState state = fluid.at_temperature(density, temperature);
    std::printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", state.pressure, state.excess_energy(), state.heat_capacity,
                state.pressure_by_density, state.pressure_by_temperature, state.sound_velocity(),
                fluid.residual_helmholtz_energy(density, temperature));
  }
}
