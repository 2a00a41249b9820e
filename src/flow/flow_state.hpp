#pragma once

#include <array>

#include "core/point.hpp"
#include "flow/equation_of_state.hpp"

namespace lanescape {

// A fluid in motion along x, with velocities along all axes [sqrt(epsilon/m)].
struct FlowState {
  ThermodynamicState fluid;
  Point velocity{};
};

// Of mass, momentum along x, y and z, and energy: per volume, or as fluxes along +x per area and time.
using Conserved = std::array<double, 5>;

inline Conserved densities(const FlowState& state) {
  const double rho = state.fluid.density;
  const Point& v = state.velocity;
  return {rho, rho * v[0], rho * v[1], rho * v[2], rho * (state.fluid.energy + 0.5 * dot(v, v))};
}

}  // namespace lanescape
