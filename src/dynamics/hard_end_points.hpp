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

// The protocol of [G] 3.2.3.2 for hard spheres: equilibrate, then collect pairs of configurations a given distance apart. Counts
// are collisions.
struct HardEndPointOptions {
  double distance = 0.0;                // DeltaR between the ends of a pair [sigma]
  std::optional<int> distance_species;  // only this species counts for the distance
  std::uint64_t pairs = 1;
  std::uint64_t equilibration_collisions = 10'000'000;
  std::uint64_t between_collisions = 100'000;  // from the end of a pair to the start of the next
  std::uint64_t check_interval = 20;           // collisions between evaluations of the distance
  std::uint64_t max_pair_collisions = 1'000'000'000'000;
  std::uint64_t seed = 1;

  // Reduces the counts for short trial runs.
  void make_quick();
  // Throws Error(bad_input) that names the option out of range.
  void check() const;
};

// Runs the protocol one collision at a time. Configurations are taken midway between two events, so no spheres are in contact.
class HardEndPointGenerator {
 public:
  enum class Phase : std::uint64_t { equilibrate, pair, between, done, distance_not_reached };

  // Draws initial velocities at T = 1. `layout` must outlive this object.
  HardEndPointGenerator(const HardSphereModel& model, const ParticleLayout& layout, const Configuration& start,
                        const HardEndPointOptions& options, Isa isa);

  void step();
  bool ended() const { return phase_ >= Phase::done; }
  Phase phase() const { return phase_; }
  static const char* name(Phase phase);
  std::uint64_t phase_done() const { return dynamics_.collisions() - phase_start_; }
  // Total number of collisions in the current phase; 0 if unknown in advance.
  std::uint64_t phase_total() const;
  bool equilibrated() const { return phase_ != Phase::equilibrate; }

  const EventDriven& dynamics() const { return dynamics_; }
  const std::vector<EndPointPair>& pairs() const { return pairs_; }
  // From the start of the current pair; 0 outside of pairs [sigma].
  double distance_so_far() const;
  // Since the end of equilibration, or since the start while it lasts; 3N - 3 degrees of freedom.
  double compressibility() const { return dynamics_.compressibility(virial_start_, time_start_); }

  // Allowed only if dynamics().at_resync().
  void exchange(Archive& archive);

 private:
  void enter(Phase phase);
  double distance_to(const std::vector<double>& positions) const;
  // Positions midway between the last event and the next. Returns false if rounding makes spheres overlap there.
  bool sample(std::vector<double>& positions, double& time);

  const ParticleLayout* layout_;
  std::vector<double> masses_;  // per species
  HardEndPointOptions options_;
  EventDriven dynamics_;
  HardSphereOverlap spheres_;
  Phase phase_ = Phase::equilibrate;
  std::uint64_t phase_start_ = 0;
  double virial_start_ = 0.0, time_start_ = 0.0;
  std::vector<double> pair_start_;  // user's order; empty until the first configuration of the pair is taken
  double look_again_ = 0.0;         // earliest time at which the distance can be reached
  double pair_start_time_ = 0.0;
  std::vector<EndPointPair> pairs_;
  std::vector<double> scratch_;
};

}  // namespace lanescape
