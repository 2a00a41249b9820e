#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/hard_sphere_model.hpp"
#include "configuration/particle_layout.hpp"
#include "core/archive.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/end_points.hpp"
#include "dynamics/event_driven.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"

namespace lanescape {

// The protocol for hard spheres of [G] 3.2.3.2: equilibrate, then collect pairs of configurations a given distance
// apart. Counts are collisions.
struct HardEndPointOptions {
  double distance = 0.0;                // DeltaR between the ends of a pair [sigma]
  std::optional<int> distance_species;  // count only this species' motion towards the distance
  std::uint64_t pairs = 1;
  std::uint64_t equilibration_collisions = 10'000'000;
  std::uint64_t between_collisions = 100'000;  // between pairs
  std::uint64_t check_interval = 20;           // collisions between looks at the distance
  std::uint64_t max_pair_collisions = 1'000'000'000'000;
  std::uint64_t seed = 1;

  // The same protocol with counts small enough to try things out.
  void make_quick();
  // Throws Error(bad_input) naming the option that is out of range.
  void check() const;
};

// Runs the protocol one collision at a time. Configurations are taken half-way between two events, never at contact.
class HardEndPointGenerator {
 public:
  enum class Phase : std::uint64_t { equilibrate, pair, between, done, distance_not_reached };

  // Draws the velocities, T = 1. `layout` must outlive this object.
  HardEndPointGenerator(const HardSphereModel& model, const ParticleLayout& layout, const Configuration& start,
                        const HardEndPointOptions& options, Isa isa);

  void step();
  bool ended() const { return phase_ >= Phase::done; }
  Phase phase() const { return phase_; }
  static const char* name(Phase phase);
  std::uint64_t phase_done() const { return dynamics_.collisions() - phase_start_; }
  // Collisions of the phase; 0 where that is not known.
  std::uint64_t phase_total() const;
  bool equilibrated() const { return phase_ != Phase::equilibrate; }

  const EventDriven& dynamics() const { return dynamics_; }
  const std::vector<EndPointPair>& pairs() const { return pairs_; }
  double distance_so_far() const;
  // Of the time since equilibrium, or of all if there is none yet; 3N - 3 degrees of freedom.
  double compressibility() const { return dynamics_.compressibility(virial_start_, time_start_); }

  // Only where dynamics().at_resync().
  void exchange(Archive& archive);

 private:
  void enter(Phase phase);
  double distance_to(const std::vector<double>& positions) const;
  // Positions between the last event and the next, without an overlap even of rounding; false if there are none.
  bool sample(std::vector<double>& positions, double& time);

  const ParticleLayout* layout_;
  std::vector<double> masses_;  // per species
  HardEndPointOptions options_;
  EventDriven dynamics_;
  HardSphereOverlap spheres_;
  Phase phase_ = Phase::equilibrate;
  std::uint64_t phase_start_ = 0;
  double virial_start_ = 0.0, time_start_ = 0.0;
  std::vector<double> pair_start_;  // user's order; empty until the pair's first configuration is taken
  double look_again_ = 0.0;         // the distance cannot be reached before
  double pair_start_time_ = 0.0;
  std::vector<EndPointPair> pairs_;
  std::vector<double> scratch_;
};

}  // namespace lanescape
