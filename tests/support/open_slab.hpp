#pragma once

#include <cmath>

#include "configuration/lattice.hpp"
#include "dynamics/fluid_state.hpp"
#include "flow/open_slab.hpp"
#include "insertion/insertion.hpp"
#include "run/moving_fluid.hpp"

namespace lanescape::testing {

inline constexpr double slab_density = 0.5, slab_temperature = 2.5, slab_pressure = 1.98;

inline Box slab_box(double length = 24.0, double width = 8.0) { return {{length, width, width}, {false, true, true}}; }

// A melted Lennard-Jones fluid, still as dense at its faces as inside.
inline FluidState slab_fluid(const PairModel& model, std::uint64_t steps = 300) {
  FluidState fluid{fcc_in_box(model, {slab_box().length}, slab_density, 1), {}};
  const CounterRandom random(1, RandomStream::velocities);
  for (std::size_t i = 0; i < fluid.configuration.size(); ++i) {
    const Point velocity = maxwellian_velocity(random, i, slab_temperature, 1.0);
    fluid.velocities.insert(fluid.velocities.end(), velocity.begin(), velocity.end());
  }
  MovingFluid moving(model, fluid, 0.002, choose_isa("auto"), 1);
  equilibrate(moving, slab_temperature, steps);
  fluid = moving.state();
  fluid.configuration.box.periodic[0] = false;
  return fluid;
}

inline OpenSlabOptions slab_options() {
  OpenSlabOptions options;
  options.isa = choose_isa("auto");
  options.faces.insertion.tolerance = 0.1;
  return options;
}

// The pressure of the fluid and a flow of this velocity, without an answer to it.
inline Outside::Demands slab_demands(double velocity) {
  FaceDemand demand;
  demand.pressure = slab_pressure;
  demand.temperature = slab_temperature;
  demand.mass_flux = slab_density * velocity;
  demand.velocity = {velocity, 0.0, 0.0};
  return {demand, demand};
}

}  // namespace lanescape::testing
