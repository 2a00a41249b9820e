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

// Newton's equations by the velocity form of Verlet's algorithm (Swope et al., doi 10.1063/1.442716) on a landscape, positions
// unwrapped, time in sigma sqrt(m/epsilon).
class VelocityVerlet {
 public:
  // Starts at rest. `landscape` and `layout` must outlive this object.
  VelocityVerlet(SoftLandscape& landscape, const Mixture& model, const ParticleLayout& layout, AlignedArray position,
                 double time_step);

  // Velocities from Maxwell's distribution, total momentum removed, then scaled to the temperature exactly.
  void draw_velocities(double temperature, std::uint64_t seed);
  // Removes the total momentum and scales so that sum m v^2 / 2 = (3/2) N T, the convention of [G] 3.1.2.2.
  void rescale_to(double temperature);
  void step();

  double temperature() const;     // 2 K / (3 N)
  double kinetic_energy() const;  // [epsilon]
  double potential_energy();      // an evaluation of its own where the step had no need of it
  std::uint64_t steps() const { return steps_; }
  double time_step() const { return time_step_; }
  const AlignedArray& position() const { return position_; }
  const AlignedArray& velocity() const { return velocity_; }
  // In the layout's order; padding zero.
  void set_velocity(AlignedArray velocity) { velocity_ = std::move(velocity); }
  void reverse_velocities();

  // Positions, velocities and counters; forces are recomputed when read, to the same bits.
  void exchange(Archive& archive);

 private:
  // One species' coordinates along one axis, or everything at once where all masses agree.
  struct Segment {
    std::size_t begin, length;
    double mass;
  };
  void kick(double time);

  SoftLandscape* landscape_;
  const ParticleLayout* layout_;
  std::vector<double> masses_;  // per species
  std::vector<Segment> segments_;
  AlignedArray position_, velocity_, gradient_;
  double time_step_;
  std::optional<double> potential_;  // at the present position, where it is known
  std::uint64_t steps_ = 0;
};

}  // namespace lanescape
