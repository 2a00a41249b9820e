#include "dynamics/end_points.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/enum_words.hpp"
#include "core/error.hpp"
#include "core/option_checks.hpp"

namespace lanescape {
namespace {

using Phase = EndPointGenerator::Phase;

constexpr EnumWord<Phase> phase_names[] = {{Phase::melt, "melting"},
                                           {Phase::cool, "cooling"},
                                           {Phase::check, "temperature check"},
                                           {Phase::settle, "settling"},
                                           {Phase::pair, "towards the far end point"},
                                           {Phase::between, "between pairs"},
                                           {Phase::done, "done"},
                                           {Phase::temperature_not_held, "temperature not held"},
                                           {Phase::distance_not_reached, "distance not reached"}};

}  // namespace

double default_distance(std::size_t particles) {
  return particles == 108 ? 108.0 : 10.0 * std::sqrt(static_cast<double>(particles));
}

void EndPointOptions::make_quick() {
  melt_steps = 20'000;
  cooling_steps = 50'000;
  check_steps = 50'000;
  check_tolerance = 0.02;
  settle_steps = 50'000;
  between_steps = 20'000;
}

void EndPointOptions::check() const {
  check_positive("temperature", temperature);
  check_positive("melting temperature", melt_temperature);
  check_positive("distance", distance);
  check_positive("time step", time_step);
  check_positive("temperature tolerance", check_tolerance);
  check_at_least_one("number of pairs", pairs);
  check_at_least_one("rescale interval", rescale_interval);
  check_at_least_one("check interval", check_interval);
  if (const double most = 0.02 * length_unit; time_step > most)
    throw_bad_input(fmt::format("time step {} is not allowed: at most {}, or energy is not conserved", time_step, most));
  if (check_steps < check_interval)
    throw_bad_input(fmt::format("check steps {} must be at least the check interval {}", check_steps, check_interval));
}

void EndPointPair::exchange(Archive& archive) {
  archive.field("start", start);
  archive.field("finish", finish);
  archive.field("distance", distance);
  archive.field("steps", steps);
  archive.field("time", time);
}

void exchange_pairs(Archive& archive, std::vector<EndPointPair>& pairs) {
  std::uint64_t count = pairs.size();
  archive.field("pairs", count);
  pairs.resize(count);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    archive.enter(fmt::format("pair{:04}", k + 1));
    pairs[k].exchange(archive);
    archive.leave();
  }
}

double end_point_distance(const AlignedArray& a, const AlignedArray& b, const ParticleLayout& layout,
                          const std::vector<double>& masses, std::optional<int> species) {
  std::array<double, 3> drift{};
  double mass = 0.0;
  const auto for_each_block = [&](auto action) {
    for (std::size_t s = 0; s < layout.blocks().size(); ++s) action(s, layout.blocks()[s]);
  };
  for_each_block([&](std::size_t s, const kernels::SpeciesBlock& block) {
    mass += masses[s] * static_cast<double>(block.count);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t k = axis * layout.slots() + block.begin, end = k + block.count; k < end; ++k)
        drift[axis] += masses[s] * (b[k] - a[k]);
  });
  double squared = 0.0;
  for_each_block([&](std::size_t s, const kernels::SpeciesBlock& block) {
    if (species && *species != static_cast<int>(s)) return;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t k = axis * layout.slots() + block.begin, end = k + block.count; k < end; ++k) {
        const double d = b[k] - a[k] - drift[axis] / mass;
        squared += d * d;
      }
  });
  return std::sqrt(squared);
}

EndPointGenerator::EndPointGenerator(SoftLandscape& landscape, const Mixture& model, const ParticleLayout& layout,
                                     AlignedArray start, const EndPointOptions& options)
    : landscape_(&landscape),
      layout_(&layout),
      masses_(model.species_masses()),
      options_(options),
      verlet_(landscape, model, layout, std::move(start), options.time_step) {
  options_.check();
  if (layout.size() < 2)
    throw_bad_input(
        fmt::format("{} particle has no temperature once its momentum is removed: at least 2 are needed", layout.size()));
  verlet_.draw_velocities(options_.melt_temperature, options_.seed);
  enter(Phase::melt);
}

const char* EndPointGenerator::name(Phase phase) { return word_of(phase_names, phase); }

std::uint64_t EndPointGenerator::steps_of(Phase phase) const {
  switch (phase) {
    case Phase::melt:
      return options_.melt_steps;
    case Phase::cool:
      return options_.cooling_steps;
    case Phase::check:
      return options_.check_steps;
    case Phase::settle:
      return options_.settle_steps;
    case Phase::between:
      return options_.between_steps;
    default:
      return 0;
  }
}

std::optional<Phase> EndPointGenerator::after(Phase phase) {
  switch (phase) {
    case Phase::melt:
      return Phase::cool;
    case Phase::cool:
      return Phase::check;
    case Phase::settle:
    case Phase::between:
      return Phase::pair;
    default:
      return std::nullopt;
  }
}

double EndPointGenerator::distance_so_far() const {
  return phase_ == Phase::pair ? end_point_distance(pair_start_, verlet_.position(), *layout_, masses_, options_.distance_species)
                               : 0.0;
}

void EndPointGenerator::enter(Phase phase) {
  while (after(phase) && steps_of(phase) == 0) phase = *after(phase);
  phase_ = phase;
  phase_start_ = verlet_.steps();
  // A repeated check rescales by the mean of the last one, because the instantaneous temperature fluctuates too much.
  if (phase == Phase::check && checks_ > 0)
    verlet_.rescale_to(verlet_.temperature() * options_.temperature / checked_temperature_);
  else if (phase == Phase::cool || phase == Phase::check)
    verlet_.rescale_to(options_.temperature);
  if (phase == Phase::check) {
    check_sum_ = 0.0;
    check_samples_ = 0;
    ++checks_;
  }
  if (phase == Phase::pair) pair_start_ = verlet_.position();
}

void EndPointGenerator::sample_temperature() {
  if (phase_done() % options_.check_interval != 0) return;
  if (phase_ == Phase::check) {
    check_sum_ += verlet_.temperature();
    ++check_samples_;
  } else {
    mean_sum_ += verlet_.temperature();
    ++mean_samples_;
  }
}

void EndPointGenerator::step() {
  verlet_.step();
  const std::uint64_t done = phase_done();
  if (phase_ == Phase::melt || phase_ == Phase::cool) {
    if (done % options_.rescale_interval == 0)
      verlet_.rescale_to(phase_ == Phase::melt ? options_.melt_temperature : options_.temperature);
  } else {
    sample_temperature();
  }
  if (const auto next = after(phase_)) {
    if (done >= phase_total()) enter(*next);
  } else if (phase_ == Phase::check) {
    if (done < phase_total()) return;
    checked_temperature_ = check_sum_ / static_cast<double>(check_samples_);
    if (std::fabs(checked_temperature_ - options_.temperature) < options_.check_tolerance)
      enter(Phase::settle);
    else
      enter(checks_ < options_.max_checks ? Phase::check : Phase::temperature_not_held);
  } else if (phase_ == Phase::pair) {
    // The distance of all particles, drift included, is an upper bound. The exact distance is computed only if this bound suffices.
    const bool near = landscape_->algebra().distance(pair_start_, verlet_.position()) >= options_.distance;
    const double distance = near ? distance_so_far() : 0.0;
    if (distance >= options_.distance) {
      pairs_.push_back({pair_start_, verlet_.position(), distance, done, static_cast<double>(done) * options_.time_step});
      enter(pairs_.size() < options_.pairs ? Phase::between : Phase::done);
    } else if (done >= options_.max_pair_steps) {
      enter(Phase::distance_not_reached);
    }
  }
}

void EndPointGenerator::exchange(Archive& archive) {
  verlet_.exchange(archive);
  exchange_enum(archive, "phase", phase_);
  archive.field("phase_start", phase_start_);
  archive.field("checks", checks_);
  archive.field("check_samples", check_samples_);
  archive.field("check_sum", check_sum_);
  archive.field("mean_samples", mean_samples_);
  archive.field("mean_sum", mean_sum_);
  archive.field("checked_temperature", checked_temperature_);
  archive.field("pair_start", pair_start_);
  exchange_pairs(archive, pairs_);
}

}  // namespace lanescape
