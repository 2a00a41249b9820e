#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "core/archive.hpp"
#include "core/enum_words.hpp"
#include "dispatch/vector_algebra.hpp"
#include "path/path_statistics.hpp"
#include "path/recorder.hpp"
#include "stepper/stepper.hpp"

namespace lanescape {

// How a search for a path ended; `running` while it has not.
enum class Outcome : std::uint64_t { running, reached, step_limit, stalled, interrupted };

inline constexpr EnumWord<Outcome> outcome_words[] = {{Outcome::running, "running"},
                                                      {Outcome::reached, "reached"},
                                                      {Outcome::step_limit, "step_limit"},
                                                      {Outcome::stalled, "stalled"},
                                                      {Outcome::interrupted, "interrupted"}};
inline const char* to_string(Outcome outcome) { return word_of(outcome_words, outcome); }

struct FinderOptions {
  std::uint64_t max_steps = 1'000'000'000;
  // Accepted steps without progress after which a path is stalled; methods that make long detours multiply it
  // (run/path_methods.cpp).
  std::uint64_t patience = 1000;
  std::size_t frames = 100;                // configurations kept between the two ends
  Stepping stepping = Stepping::faithful;  // what the statistics along the path weigh steps with
};

// Walks from R_i to R_f with a stepper that makes direct steps and detours (PHYSICS 3). The state holds everything that the rest of
// the path depends on.
template <Stepper Method>
class PathFinder {
 public:
  PathFinder(const VectorAlgebra& algebra, Method stepper, AlignedArray start, AlignedArray goal, std::size_t particles,
             const FinderOptions& options)
      : algebra_(&algebra),
        stepper_(std::move(stepper)),
        options_(options),
        position_(std::move(start)),
        goal_(std::move(goal)),
        to_goal_(position_.size(), 0.0),
        next_(position_.size(), 0.0),
        best_distance_(algebra_->distance(position_, goal_)),
        statistics_(position_.size() / 3, particles, options.stepping),
        recorder_(options.frames, best_distance_) {}

  Outcome outcome() const { return outcome_; }
  const std::string& reason() const { return reason_; }
  const PathStatistics& statistics() const { return statistics_; }
  const PathRecorder& recorder() const { return recorder_; }
  const Method& stepper() const { return stepper_; }
  std::uint64_t direct_steps() const { return direct_steps_; }
  std::uint64_t detour_steps() const { return detour_steps_; }
  std::uint64_t steps() const { return direct_steps_ + detour_steps_; }
  // Of the path's length, the part that detours made [sigma]; the rest are direct steps and the last hop.
  double detour_length() const { return detour_length_; }
  double largest_violation() const { return largest_violation_; }
  double distance_left() const { return algebra_->distance(position_, goal_); }
  const AlignedArray& position() const { return position_; }

  // Advances by at most `steps` accepted steps, or to the end of the search.
  void advance(std::uint64_t steps) {
    for (; steps > 0 && outcome_ == Outcome::running; --steps) step();
  }

  void exchange(Archive& archive) {
    exchange_enum(archive, "outcome", outcome_);
    archive.field("reason", reason_);
    archive.field("position", position_);
    archive.field("direct_steps", direct_steps_);
    archive.field("detour_steps", detour_steps_);
    archive.field("detour_length", detour_length_);
    archive.field("largest_violation", largest_violation_);
    archive.field("best_distance", best_distance_);
    archive.field("best_step", best_step_);
    statistics_.exchange(archive);
    recorder_.exchange(archive);
    stepper_.exchange(archive, position_);
  }

 private:
  void step() {
    algebra_->difference(to_goal_, goal_, position_);
    const PathPoint at{position_, to_goal_, algebra_->norm(to_goal_)};
    if (steps() > 0 && recorder_.trace().wants(steps())) record(at.distance);
    recorder_.keep_frame(position_, at.distance);
    if (at.distance < stepper_.step_length()) return hop(at.distance);
    if (steps() >= options_.max_steps) return end(Outcome::step_limit, fmt::format("{} steps were allowed", options_.max_steps));
    if (no_progress(at.distance))
      return end(Outcome::stalled,
                 fmt::format("no progress over {} steps, at a distance of {:.6g} from the goal", options_.patience, at.distance));
    const auto kind = stepper_.step(at, next_);
    if (!kind)
      return end(Outcome::stalled, fmt::format("{}, at a distance of {:.6g} from the goal", stepper_.failure(), at.distance));
    ++(*kind == StepKind::direct ? direct_steps_ : detour_steps_);
    const double length = statistics_.add_step(*algebra_, position_, next_);
    if (*kind == StepKind::detour) detour_length_ += length;
    largest_violation_ = std::max(largest_violation_, stepper_.violation());
    position_.swap(next_);
  }

  // The last displacement, counted in the length but not as a step.
  void hop(double distance) {
    if (!recorder_.trace().wants(steps())) record(distance);
    statistics_.add_hop(*algebra_, position_, goal_);
    position_ = goal_;
    end(Outcome::reached, "");
  }

  void end(Outcome outcome, std::string reason) {
    outcome_ = outcome;
    reason_ = std::move(reason);
  }

  // A direct step gains its whole length; less than a millionth of that in `patience` steps is none.
  bool no_progress(double distance) {
    if (distance < best_distance_ - 1e-6 * stepper_.step_length() || steps() == 0) {
      best_distance_ = distance;
      best_step_ = steps();
    }
    return steps() - best_step_ >= options_.patience;
  }

  // `distance` from the point just accepted to the goal.
  void record(double distance) {
    const double direct =
        options_.stepping == Stepping::adaptive ? statistics_.length() - detour_length_ : static_cast<double>(direct_steps_);
    recorder_.trace().add({static_cast<double>(steps()), statistics_.length(), distance, stepper_.monitored(), direct,
                           statistics_.last_participation_number()});
  }

  const VectorAlgebra* algebra_;
  Method stepper_;
  FinderOptions options_;
  AlignedArray position_, goal_, to_goal_, next_;
  Outcome outcome_ = Outcome::running;
  std::string reason_;
  std::uint64_t direct_steps_ = 0, detour_steps_ = 0;
  double detour_length_ = 0.0, largest_violation_ = 0.0;
  double best_distance_;
  std::uint64_t best_step_ = 0;
  PathStatistics statistics_;
  PathRecorder recorder_;
};

}  // namespace lanescape
