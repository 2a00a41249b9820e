#pragma once

#include <cstdint>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"
#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/velocity_verlet.hpp"
#include "landscape/pair_landscape.hpp"

namespace lanescape {

// Particles with velocities in the user's order: the state of a fluid whose number of particles changes, between two stretches of
// molecular dynamics.
struct FluidState {
  Configuration configuration;
  std::vector<double> velocities;  // 3N [sigma / time]

  void add(int species, const std::array<double, 3>& position, const std::array<double, 3>& velocity);
  // Positions, velocities and box; the species too if there are several.
  void exchange(Archive& archive);
};

// Molecular dynamics of a soft fluid at constant energy. Its bits depend on the initial state alone.
class MovingFluid {
 public:
  MovingFluid(const PairModel& model, const FluidState& state, double time_step, Isa isa, int threads);
  MovingFluid(const MovingFluid&) = delete;
  MovingFluid& operator=(const MovingFluid&) = delete;

  void run(std::uint64_t steps);
  void rescale_to(double temperature) { verlet_.rescale_to(temperature); }
  // The state now; positions in the box.
  FluidState state() const;

  double temperature() const { return verlet_.temperature(); }        // 2 K / (3 N)
  double kinetic_energy() const { return verlet_.kinetic_energy(); }  // [epsilon]
  struct Potential {
    double energy, pressure;  // [epsilon], [epsilon/sigma^3]; the virial's and the kinetic part
  };
  Potential potential();  // one evaluation

 private:
  Configuration start_;
  ParticleLayout layout_;
  PairLandscape landscape_;
  VelocityVerlet verlet_;
  AlignedArray gradient_;
};

// Particles on a lattice of this density, with Maxwellian velocities.
FluidState fluid_on_lattice(const PairModel& model, std::size_t particles, double density, double temperature, std::uint64_t seed);

// Rescales velocities to the temperature every 50 steps of the first half; the second half runs at constant energy.
void equilibrate(MovingFluid& fluid, double temperature, std::uint64_t steps);

}  // namespace lanescape
