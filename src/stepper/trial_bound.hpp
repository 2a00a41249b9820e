#pragma once

#include <memory>
#include <optional>

#include "landscape/soft_landscape.hpp"

namespace lanescape {

// Proves that trials are forbidden without evaluating them, where the landscape has a SegmentBound.
class TrialBound {
 public:
  // For trials a distance `step` away [sigma].
  TrialBound(const SoftLandscape& landscape, double step) : landscape_(&landscape), step_(step) {}

  // Whether V of the trial exceeds `limit` for certain, from V here and its slope towards the trial [epsilon, epsilon/sigma].
  bool exceeds(const AlignedArray& here, double energy, double slope, double limit);
  // Every accepted step is told here, by its length or more [sigma].
  void moved(double length) { walked_ += length; }

  // So that a resumed path evaluates the same trials.
  void exchange(Archive& archive);

 private:
  // Null: nothing is proven. Made at the first use: its tables cost about a hundred evaluations, and many paths go straight.
  SegmentBound* bound();
  // Makes loss_ valid from `here` to any trial.
  void find_loss(const AlignedArray& here);

  const SoftLandscape* landscape_;
  std::optional<std::unique_ptr<SegmentBound>> bound_;
  double step_;
  AlignedArray centre_;  // where loss_ was found; empty: nowhere yet
  SegmentLoss loss_{};
  double moved_apart_ = 0.0;  // at most, of two particles since centre_, as measured last [sigma]
  double walked_ = 0.0;       // since then [sigma]
};

}  // namespace lanescape
