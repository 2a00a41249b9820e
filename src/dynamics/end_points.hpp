#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/archive.hpp"
#include "dynamics/velocity_verlet.hpp"
#include "interaction/pair/pair_interaction.hpp"

namespace lanescape {

// DeltaR between the ends of a pair where the user gives none [the model's unit of length].
double default_distance(std::size_t particles);

// The protocol of [G] 3.1.2.2: melt at a high temperature, cool, check that the temperature holds without a thermostat, settle,
// then collect pairs of configurations a given distance apart. Counts are molecular dynamics steps.
struct EndPointOptions {
  double temperature = 1.0;             // [epsilon/k_B]
  double distance = 0.0;                // DeltaR between the ends of a pair [sigma]
  std::optional<int> distance_species;  // only this species counts for the distance
  std::uint64_t pairs = 1;
  double time_step = 0.001;  // [sigma sqrt(m/epsilon)]
  double length_unit = 1.0;  // of the model, which limits the time step [sigma]
  double melt_temperature = 5.0;
  std::uint64_t melt_steps = 200'000;
  std::uint64_t cooling_steps = 1'000'000;
  std::uint64_t rescale_interval = 1'000;  // steps between velocity rescalings while melting and cooling
  std::uint64_t check_steps = 1'000'000;
  std::uint64_t check_interval = 100;  // steps between temperature samples
  double check_tolerance = 0.005;      // largest |<T> - T|; beyond it velocities are rescaled and the check is repeated
  std::uint64_t max_checks = 100;
  std::uint64_t settle_steps = 1'000'000;
  std::uint64_t between_steps = 100'000;  // from the end of a pair to the start of the next
  std::uint64_t max_pair_steps = 1'000'000'000;
  std::uint64_t seed = 1;
  int threads = 1;  // of one evaluation; the results do not depend on it
  Precision precision = Precision::double_precision;

  // Reduces the counts for short trial runs.
  void make_quick();
  // Throws Error(bad_input) that names the option out of range.
  void check() const;
};

// Two configurations of one trajectory, unwrapped, in the layout's order.
struct EndPointPair {
  AlignedArray start, finish;
  double distance = 0.0;    // |R_f - R_i| without the motion of the centre of mass [sigma]
  std::uint64_t steps = 0;  // from start to finish; collisions for hard spheres
  double time = 0.0;        // from start to finish [sigma sqrt(m/epsilon)]
  void exchange(Archive& archive);
};

// Archives all pairs, each in its own group.
void exchange_pairs(Archive& archive, std::vector<EndPointPair>& pairs);

// Runs the protocol one step at a time. The whole state can be archived between any two steps.
class EndPointGenerator {
 public:
  enum class Phase : std::uint64_t { melt, cool, check, settle, pair, between, done, temperature_not_held, distance_not_reached };

  // Draws initial velocities. `landscape` and `layout` must outlive this object.
  EndPointGenerator(SoftLandscape& landscape, const Mixture& model, const ParticleLayout& layout, AlignedArray start,
                    const EndPointOptions& options);

  void step();
  bool ended() const { return phase_ >= Phase::done; }
  Phase phase() const { return phase_; }
  static const char* name(Phase phase);
  // Steps done in the current phase, and its total number of steps (0 if unknown in advance).
  std::uint64_t phase_done() const { return verlet_.steps() - phase_start_; }
  std::uint64_t phase_total() const { return steps_of(phase_); }
  bool equilibrated() const { return phase_ >= Phase::settle && phase_ <= Phase::done; }

  const VelocityVerlet& verlet() const { return verlet_; }
  // For callers that continue the dynamics after the settling phase.
  VelocityVerlet& verlet() { return verlet_; }
  const std::vector<EndPointPair>& pairs() const { return pairs_; }
  // Mean temperature during the last check.
  double checked_temperature() const { return checked_temperature_; }
  // Mean temperature since the check was passed; that of the check if there are no later samples.
  double mean_temperature() const {
    return mean_samples_ == 0 ? checked_temperature_ : mean_sum_ / static_cast<double>(mean_samples_);
  }
  // From the start of the current pair; 0 outside of pairs [sigma].
  double distance_so_far() const;

  void exchange(Archive& archive);

 private:
  std::uint64_t steps_of(Phase phase) const;
  // The next phase after one that ends at a fixed number of steps; nothing for phases that end otherwise.
  static std::optional<Phase> after(Phase phase);
  void enter(Phase phase);
  void sample_temperature();

  const SoftLandscape* landscape_;
  const ParticleLayout* layout_;
  std::vector<double> masses_;
  EndPointOptions options_;
  VelocityVerlet verlet_;
  Phase phase_ = Phase::melt;
  std::uint64_t phase_start_ = 0;
  std::uint64_t checks_ = 0, check_samples_ = 0, mean_samples_ = 0;
  double check_sum_ = 0.0, mean_sum_ = 0.0, checked_temperature_ = 0.0;
  AlignedArray pair_start_;
  std::vector<EndPointPair> pairs_;
};

// |b - a| over all particles, or those of one species, with the displacement of the centre of mass removed [sigma]. `masses` are
// per species.
double end_point_distance(const AlignedArray& a, const AlignedArray& b, const ParticleLayout& layout,
                          const std::vector<double>& masses, std::optional<int> species);

}  // namespace lanescape
