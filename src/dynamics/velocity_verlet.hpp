#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "configuration/mixture.hpp"
#include "configuration/particle_layout.hpp"
#include "core/archive.hpp"
#include "landscape/soft_landscape.hpp"

namespace lanescape {

// Newton's equations on a landscape by the velocity Verlet algorithm (Swope et al., doi 10.1063/1.442716). Positions are unwrapped.
// Time in sigma sqrt(m/epsilon).
class VelocityVerlet {
 public:
  // Starts at rest. `landscape` and `layout` must outlive this object.
  VelocityVerlet(SoftLandscape& landscape, const Mixture& model, const ParticleLayout& layout, AlignedArray position,
                 double time_step);

  // Draws velocities from Maxwell's distribution, then calls rescale_to().
  void draw_velocities(double temperature, std::uint64_t seed);
  // Removes the total momentum and scales so that sum m v^2 / 2 = (3/2) N T, the convention of [G] 3.1.2.2.
  void rescale_to(double temperature);
  void step();

  double temperature() const;     // 2 K / (3 N)
  double kinetic_energy() const;  // [epsilon]
  double potential_energy();      // costs an evaluation after each step
  std::uint64_t steps() const { return steps_; }
  double time_step() const { return time_step_; }
  const AlignedArray& position() const { return position_; }
  const AlignedArray& velocity() const { return velocity_; }
  // In the layout's order, with zeros in the padding.
  void set_velocity(AlignedArray velocity) { velocity_ = std::move(velocity); }
  void reverse_velocities();

  // Archives positions, velocities and counters. Reading recomputes forces, to the same bits.
  void exchange(Archive& archive);

 private:
  // The coordinates of one species along one axis, or all coordinates if all masses are equal.
  struct Segment {
    std::size_t begin, length;
    double mass;
  };
  // Half a step of particles in slots [begin, end), multiples of slot_padding; a whole one.
  void kick(std::size_t begin, std::size_t end);
  void drift(std::size_t begin, std::size_t end);

  SoftLandscape* landscape_;
  const ParticleLayout* layout_;
  std::vector<double> masses_;  // per species
  std::vector<Segment> segments_;
  AlignedArray position_, velocity_, gradient_;
  double time_step_;
  std::optional<double> potential_;  // at the current position, if known
  std::uint64_t steps_ = 0;
};

}  // namespace lanescape
