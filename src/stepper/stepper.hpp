#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/aligned_array.hpp"
#include "core/archive.hpp"

namespace lanescape {

// The point a path has reached: R(t), and the vector from there to the goal, R_f - R(t).
struct PathPoint {
  const AlignedArray& position;
  const AlignedArray& to_goal;
  double distance;  // |R_f - R(t)|
};

// How long the steps of a path are: as published, all alike, or as long as an estimate of their error allows.
enum class Stepping { faithful, adaptive };

// How an accepted step was made.
enum class StepKind { direct, detour };

// A method of making steps, as the path finder sees it. A stepper may also have `histograms()`, a vector of StepHistogram with what
// it counts along the path. docs/HACKING.md, "Add a path method", lists what a new one takes.
template <class S>
concept Stepper = requires(S& stepper, const S& seen, const PathPoint& at, AlignedArray& next, Archive& archive) {
  // Writes one allowed point to `next`, which is overwritten in any case. Returns nothing if the stepper finds no step; failure()
  // then says why.
  { stepper.step(at, next) } -> std::same_as<std::optional<StepKind>>;
  { seen.failure() } -> std::convertible_to<const std::string&>;
  // Length of a direct step in 3N space [sigma]. Within this distance of the goal the path ends with a hop.
  { seen.step_length() } -> std::same_as<double>;
  // The number to record of each step, such as V.
  { seen.monitored() } -> std::same_as<double>;
  // By how much the last accepted point leaves the allowed region; at most 0 inside.
  { seen.violation() } -> std::same_as<double>;
  // Evaluations of the whole configuration so far.
  { seen.evaluations() } -> std::same_as<std::uint64_t>;
  // Histogram of the iterations that detours took; the last entry counts all beyond.
  { seen.corrections() } -> std::convertible_to<const std::vector<std::uint64_t>&>;
  // State beyond the position, which is that of the last accepted point.
  stepper.exchange(archive, at.position);
};

}  // namespace lanescape
