#include "stepper/avoidance.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/enum_words.hpp"

namespace lanescape {

namespace {

using kernels::ContactPotential;
constexpr EnumWord<ContactPotential> contact_potentials[] = {
    {ContactPotential::harmonic, "harmonic"}, {ContactPotential::linear, "linear"}, {ContactPotential::cubic, "cubic"}};

}  // namespace

ContactPotential parse_contact_potential(std::string_view word) {
  return parse_word(contact_potentials, "fictitious potential", word);
}
const char* to_string(ContactPotential potential) { return word_of(contact_potentials, potential); }

AvoidanceStepper::AvoidanceStepper(HardLandscape& landscape, const Options& options)
    : landscape_(&landscape),
      options_(options),
      corrections_(32, 0),
      statistics_(landscape.dimension() / 3, landscape.particles()),
      force_(landscape.dimension(), 0.0),
      sum_(landscape.dimension(), 0.0) {}

std::optional<StepKind> AvoidanceStepper::step(const PathPoint& at, AlignedArray& next) {
  const VectorAlgebra& algebra = landscape_->algebra();
  direct_trial(algebra, at, options_.direct_step, next);
  ++evaluations_;
  ContactPairs overlaps = landscape_->find_contacts(next);
  if (overlaps.count == 0) {
    moved_ = landscape_->particles();
    return StepKind::direct;
  }
  const bool counted = avoidance_steps_++ % statistics_interval == 0;
  if (counted) statistics_.begin_step(overlaps);
  std::fill(sum_.begin(), sum_.end(), 0.0);
  for (std::uint64_t trial = 0; trial < options_.max_trials; ++trial) {
    landscape_->add_contact_forces(options_.potential, force_);
    moved_ = landscape_->avoidance_trial(next, at.position, sum_, force_, options_.avoidance_step);
    if (moved_ == 0) {
      failure_ = "the fictitious forces of all trials cancel";
      return std::nullopt;
    }
    ++evaluations_;
    overlaps = landscape_->find_contacts(next);
    if (overlaps.count == 0) {
      ++corrections_[std::min<std::size_t>(trial, corrections_.size() - 1)];
      if (counted) statistics_.end_step(moved_);
      return StepKind::detour;
    }
    if (counted) statistics_.add_trial(overlaps);
  }
  failure_ =
      fmt::format("{} pairs still overlap after {} trials of {}", overlaps.count, options_.max_trials, options_.avoidance_step);
  return std::nullopt;
}

// Forces and their sums are zero between steps, and lists follow from positions.
void AvoidanceStepper::exchange(Archive& archive, const AlignedArray&) {
  std::uint64_t moved = moved_;
  archive.field("avoidance_steps", avoidance_steps_);
  archive.field("moved", moved);
  moved_ = static_cast<std::size_t>(moved);
  archive.field("evaluations", evaluations_);
  archive.field("corrections", corrections_);
  archive.enter("overlaps");
  statistics_.exchange(archive);
  archive.leave();
}

}  // namespace lanescape
