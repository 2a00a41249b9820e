#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/archive.hpp"
#include "landscape/soft_landscape.hpp"
#include "stepper/cubic_segment.hpp"
#include "stepper/stepper.hpp"

namespace lanescape {

// The limit of the contour method ([C] Eqs. 11-15) for infinitely short steps, in few long ones. Where the straight way to the goal
// is allowed, direct steps follow it. Elsewhere the path follows dR/ds = P d/|P d| along V = E_L, P = 1 - n n^T, by the two-step
// method of Adams and Bashforth with a step length that follows from how far the direction at the new point is from the one
// extrapolated to it.
//
// One evaluation makes most steps. The path keeps a small distance, `margin`, from the boundary, so that errors of second order
// leave it allowed; a point above E_L is moved back along the gradient. V along each segment is estimated from its ends
// (CubicSegment), and evaluated once more where the estimate comes near E_L.
class AdaptiveContourStepper {
 public:
  struct Options {
    double unit = 1.0;        // the model's unit of length, which the lengths below are in [sigma]
    double tolerance = 0.02;  // error of a step along the contour over its length
    double margin = 4e-5;     // distance to the boundary that steps along it aim for
    double slack = 1e-6;      // distance by which the straight way to the goal may leave the allowed region, for rounding
    double fine_step = 1e-4;  // below it steps are not shortened for their error: gradients may jump
    double shortest_step = 1e-10;
    double longest_step = 0.5;
  };

  AdaptiveContourStepper(SoftLandscape& landscape, double landscape_energy, const Options& options);

  // Writes the goal, but for rounding, once the rest of the way to it is allowed.
  std::optional<StepKind> step(const PathPoint& at, AlignedArray& next);

  double step_length() const { return 1e-9 * options_.unit; }  // direct steps have none; the last one reaches the goal
  double monitored() const { return energy_; }                 // V at the last accepted point
  // Largest V - E_L on the last accepted segment.
  double violation() const { return violation_; }
  std::uint64_t evaluations() const { return evaluations_; }  // of V, with or without gradient
  const std::string& failure() const { return failure_; }
  // How many steps along the contour took 0, 1, 2, ... moves back along the gradient; the last entry counts all beyond.
  const std::vector<std::uint64_t>& corrections() const { return corrections_; }

  void exchange(Archive& archive, const AlignedArray& position);

 private:
  // The flow along the contour through a point: |grad V| there, and |R_f - R| times the length of P d, which along_ or trial_along_
  // keeps with this factor.
  struct Flow {
    double steepness, length;
  };
  Flow flow(const AlignedArray& to_goal, const AlignedArray& gradient, AlignedArray& along) const;
  double evaluate(const AlignedArray& position);
  double energy_at(const PathPoint& at, double part, const AlignedArray& along);
  double level(double steepness) const { return landscape_energy_ - options_.margin * options_.unit * steepness; }

  bool hop(const PathPoint& at, AlignedArray& next);
  bool go_straight(const PathPoint& at, double slope, double steepness, AlignedArray& next);
  bool follow_contour(const PathPoint& at, AlignedArray& next);
  // One segment of this length. Each returns 0 if it is accepted, else the length to try next.
  double try_straight(const PathPoint& at, double length, double steepness, AlignedArray& next);
  double try_contour(const PathPoint& at, const Flow& here, double length, AlignedArray& next);
  std::optional<std::uint64_t> return_to_allowed(AlignedArray& next, double length);
  double relative_error(const PathPoint& at, const Flow& here, double length);
  bool segment_is_allowed(const PathPoint& at, double steepness);
  void accept(double highest);

  SoftLandscape* landscape_;
  double landscape_energy_;
  Options options_;
  double energy_ = 0.0, violation_ = 0.0;
  double direct_step_, contour_step_;  // lengths to try next [sigma]
  double goal_tried_;                  // distance from which the straight way to the goal was found forbidden
  // Of the contour step before, if there was one: its length, else 0, and |before_|.
  double length_before_ = 0.0, before_norm_ = 0.0;
  std::uint64_t evaluations_ = 0;
  std::vector<std::uint64_t> corrections_;
  std::string failure_;
  bool gradient_known_ = false;
  double trial_energy_ = 0.0;
  AlignedArray gradient_, trial_gradient_, along_, trial_along_, before_, chord_, scratch_;
};

}  // namespace lanescape
