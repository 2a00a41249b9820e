#pragma once

#include <cstdint>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"
#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/fluid_state.hpp"
#include "dynamics/velocity_verlet.hpp"
#include "landscape/pair_landscape.hpp"

namespace lanescape {

// Molecular dynamics of a soft fluid at constant energy. Its bits depend only on the initial state, the time step and the
// instruction set.
class MovingFluid {
 public:
  MovingFluid(const PairModel& model, const FluidState& state, double time_step, Isa isa, int threads);
  MovingFluid(const MovingFluid&) = delete;
  MovingFluid& operator=(const MovingFluid&) = delete;

  void run(std::uint64_t steps);
  void rescale_to(double temperature) { verlet_.rescale_to(temperature); }
  // The current state, with positions in the box.
  FluidState state() const;

  double temperature() const { return verlet_.temperature(); }        // 2 K / (3 N)
  double kinetic_energy() const { return verlet_.kinetic_energy(); }  // [epsilon]
  struct Potential {
    double energy, pressure;  // [epsilon], [epsilon/sigma^3]; pressure with its kinetic part
  };
  Potential potential();  // costs one evaluation

 private:
  Configuration start_;
  ParticleLayout layout_;
  PairLandscape landscape_;
  VelocityVerlet verlet_;
  AlignedArray gradient_;
};

// Particles on an fcc lattice of this density, with velocities from Maxwell's distribution.
FluidState fluid_on_lattice(const PairModel& model, std::size_t particles, double density, double temperature, std::uint64_t seed);

// Rescales velocities to the temperature every 50 steps during the first half. The second half runs at constant energy.
void equilibrate(MovingFluid& fluid, double temperature, std::uint64_t steps);

}  // namespace lanescape
