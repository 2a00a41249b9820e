#pragma once

#include <cstdint>
#include <vector>

#include "configuration/mixture.hpp"
#include "configuration/particle_layout.hpp"
#include "core/archive.hpp"
#include "core/random.hpp"
#include "landscape/soft_landscape.hpp"

namespace lanescape {

struct LangevinOptions {
  double temperature = 1.0;  // [epsilon/k_B]
  double friction = 1.0;     // gamma, equal for all particles [sqrt(epsilon/m)/sigma]
  double time_step = 0.005;  // [sigma sqrt(m/epsilon)]
  std::uint64_t seed = 1;
  // Throws Error(bad_input) that names the option out of range.
  void check() const;
};

// m dv = -grad V dt - gamma m v dt + sqrt(2 gamma m T) dW by the splitting BAOAB (Leimkuhler and Matthews,
// doi 10.1093/amrx/abs010): half a kick, half a drift, friction and noise, half a drift, half a kick. Position averages of a
// harmonic landscape are exact at any stable time step. Noise is a function of (seed, step, particle), so results do not depend on
// threads or interruptions.
class Langevin {
 public:
  // Draws velocities from Maxwell's distribution. `landscape` and `layout` must outlive this object.
  Langevin(SoftLandscape& landscape, const Mixture& model, const ParticleLayout& layout, AlignedArray position,
           const LangevinOptions& options);

  void step();

  double temperature() const;  // sum m v^2 / (3 N)
  std::uint64_t steps() const { return steps_; }
  const AlignedArray& position() const { return position_; }
  const AlignedArray& velocity() const { return velocity_; }

  // Archives positions, velocities and counters. Reading recomputes forces, to the same bits.
  void exchange(Archive& archive);

 private:
  // Each of particles in slots [begin, end), multiples of slot_padding: half a step; half a step; a whole one.
  void kick(std::size_t begin, std::size_t end);
  void drift(std::size_t begin, std::size_t end);
  void friction_and_noise(std::size_t begin, std::size_t end);

  SoftLandscape* landscape_;
  LangevinOptions options_;
  CounterRandom noise_;
  std::vector<std::size_t> slots_;  // of the particles, in the order of their slots
  std::vector<double> masses_;      // of the particles
  AlignedArray kick_;               // -dt / 2m per coordinate, 0 for padding
  AlignedArray position_, velocity_, gradient_;
  std::uint64_t steps_ = 0;
};

}  // namespace lanescape
