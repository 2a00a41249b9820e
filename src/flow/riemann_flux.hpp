#pragma once

#include "flow/flow_state.hpp"

namespace lanescape {

// The fluid on one side of a face.
struct FaceSide {
  double density = 0.0;
  Point velocity{};
  double pressure = 0.0;
  double energy_density = 0.0;  // internal, per volume
  double sound_velocity = 0.0;
};

FaceSide face_side(const FlowState& state);

// The flux through a face between two states by the HLLC solver ([TO], chapter 10), which knows nothing of the equation of state
// but the sound velocities. A contact at rest stays sharp.
Conserved riemann_flux(const FaceSide& left, const FaceSide& right);

}  // namespace lanescape
