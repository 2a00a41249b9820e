#include "dynamics/hard_end_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/enum_words.hpp"
#include "core/error.hpp"
#include "core/option_checks.hpp"

namespace lanescape {
namespace {

using HardPhase = HardEndPointGenerator::Phase;

constexpr EnumWord<HardPhase> hard_phase_names[] = {{HardPhase::equilibrate, "equilibration"},
                                                    {HardPhase::pair, "towards the far end point"},
                                                    {HardPhase::between, "between pairs"},
                                                    {HardPhase::done, "done"},
                                                    {HardPhase::distance_not_reached, "distance not reached"}};

}  // namespace

void HardEndPointOptions::make_quick() {
  equilibration_collisions = 200'000;
  between_collisions = 20'000;
}

void HardEndPointOptions::check() const {
  check_positive("distance", distance);
  check_at_least_one("number of pairs", pairs);
  check_at_least_one("check interval", check_interval);
  check_at_least_one("collisions of a pair", max_pair_collisions);
}

HardEndPointGenerator::HardEndPointGenerator(const HardSphereModel& model, const ParticleLayout& layout, const Configuration& start,
                                             const HardEndPointOptions& options, Isa isa)
    : layout_(&layout),
      masses_(model.species_masses()),
      options_(options),
      dynamics_(start, model.masses_of(start.species), kernel_table(isa)),
      spheres_(start.box, layout, start.radii, kernel_table(isa)) {
  options_.check();
  if (layout.size() < 2)
    throw_bad_input(fmt::format("{} particle has nothing to collide with: at least 2 are needed", layout.size()));
  dynamics_.draw_velocities(options_.seed);
  enter(options_.equilibration_collisions > 0 ? Phase::equilibrate : Phase::pair);
}

const char* HardEndPointGenerator::name(Phase phase) { return word_of(hard_phase_names, phase); }

std::uint64_t HardEndPointGenerator::phase_total() const {
  if (phase_ == Phase::equilibrate) return options_.equilibration_collisions;
  return phase_ == Phase::between ? options_.between_collisions : 0;
}

void HardEndPointGenerator::enter(Phase phase) {
  if (phase == Phase::between && options_.between_collisions == 0) phase = Phase::pair;
  if (phase_ == Phase::equilibrate && phase != phase_) {
    virial_start_ = dynamics_.virial();
    time_start_ = dynamics_.time();
  }
  phase_ = phase;
  phase_start_ = dynamics_.collisions();
  look_again_ = 0.0;
  if (phase == Phase::pair) pair_start_.clear();
}

bool HardEndPointGenerator::sample(std::vector<double>& positions, double& time) {
  time = dynamics_.time() + 0.5 * (dynamics_.next_event_time() - dynamics_.time());
  dynamics_.positions(time, positions);
  return !spheres_.any_overlap(layout_->to_slots(positions));
}

double HardEndPointGenerator::distance_to(const std::vector<double>& positions) const {
  return end_point_distance(layout_->to_slots(pair_start_), layout_->to_slots(positions), *layout_, masses_,
                            options_.distance_species);
}

double HardEndPointGenerator::distance_so_far() const {
  return phase_ == Phase::pair && !pair_start_.empty() ? distance_to(dynamics_.positions()) : 0.0;
}

void HardEndPointGenerator::step() {
  dynamics_.collide();
  const std::uint64_t done = phase_done();
  if (phase_ == Phase::equilibrate || phase_ == Phase::between) {
    if (done >= phase_total()) enter(Phase::pair);
    return;
  }
  if (pair_start_.empty()) {
    if (!sample(pair_start_, pair_start_time_)) pair_start_.clear();
    phase_start_ = dynamics_.collisions();
    return;
  }
  if (done >= options_.max_pair_collisions) return enter(Phase::distance_not_reached);
  if (done % options_.check_interval != 0 || dynamics_.time() < look_again_) return;
  // The distance of all particles, drift included, is an upper bound. The exact distance is computed only if this bound suffices.
  dynamics_.positions(dynamics_.time(), scratch_);
  double squared = 0.0;
  for (std::size_t k = 0; k < scratch_.size(); ++k) squared += (scratch_[k] - pair_start_[k]) * (scratch_[k] - pair_start_[k]);
  if (squared < options_.distance * options_.distance) {
    // Each evaluation costs O(N). |dR/dt|^2 = sum v^2 <= 2 K / m, with m the least mass and K conserved, gives the earliest time at
    // which the distance can be reached.
    const double fastest = std::sqrt(2.0 * dynamics_.kinetic_energy() / *std::min_element(masses_.begin(), masses_.end()));
    look_again_ = dynamics_.time() + 0.999 * (options_.distance - std::sqrt(squared)) / fastest;
    return;
  }
  double time = 0.0;
  if (!sample(scratch_, time)) return;
  const double distance = distance_to(scratch_);
  if (distance < options_.distance) return;
  pairs_.push_back({layout_->to_slots(pair_start_), layout_->to_slots(scratch_), distance, done, time - pair_start_time_});
  enter(pairs_.size() < options_.pairs ? Phase::between : Phase::done);
}

void HardEndPointGenerator::exchange(Archive& archive) {
  archive.enter("dynamics");
  dynamics_.exchange(archive);
  archive.leave();
  exchange_enum(archive, "phase", phase_);
  archive.field("phase_start", phase_start_);
  archive.field("virial_start", virial_start_);
  archive.field("time_start", time_start_);
  archive.field("pair_start", pair_start_);
  archive.field("pair_start_time", pair_start_time_);
  exchange_pairs(archive, pairs_);
}

}  // namespace lanescape
