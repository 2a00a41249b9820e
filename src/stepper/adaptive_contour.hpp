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
// is allowed, direct steps follow it. Elsewhere the path follows dR/ds = P d/|P d| along V = E_L, P = 1 - n n^T, by the
// extrapolated second backward differentiation formula for steps of any length. Stiff pairs, which pull the direction back within a
// hundredth of sigma, limit explicit methods; this one allows steps a third longer than that of Adams and Bashforth. The length of
// a step follows from how far the direction at its end is from the extrapolated one.
//
// Most steps take one evaluation. The path keeps a small distance, `margin`, from the boundary, so that errors of second order
// leave it allowed; a point above E_L is moved back along the gradient. V along each segment is estimated from its ends
// (CubicSegment), and evaluated once more where the estimate comes near E_L.
class AdaptiveContourStepper {
 public:
  struct Options {
    double unit = 1.0;        // the model's unit of length, which the lengths below are in [sigma]
    double tolerance = 0.02;  // error of a step along the contour over its length
    double margin = 2e-4;     // distance to the boundary that steps along it aim for
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
  struct Flow {
    double steepness, along;  // |grad V|, |P (R_f - R)|
  };
  Flow flow(const AlignedArray& to_goal, const AlignedArray& gradient, AlignedArray& tangent) const;
  double evaluate(const AlignedArray& position);
  double energy_at(const PathPoint& at, double part, const AlignedArray& along);
  double level(double steepness) const { return landscape_energy_ - options_.margin * options_.unit * steepness; }

  bool hop(const PathPoint& at, AlignedArray& next);
  bool go_straight(const PathPoint& at, double slope, double steepness, AlignedArray& next);
  bool follow_contour(const PathPoint& at, AlignedArray& next);
  // One segment of this length. Each returns 0 if it is accepted, else the length to try next.
  double try_straight(const PathPoint& at, double length, double steepness, AlignedArray& next);
  double try_contour(const PathPoint& at, double steepness, double length, AlignedArray& next);
  std::optional<std::uint64_t> return_to_allowed(AlignedArray& next, double length);
  void predict(double length);
  double relative_error(const PathPoint& at, double length);
  bool segment_is_allowed(const PathPoint& at, double steepness);
  void accept(double highest);

  SoftLandscape* landscape_;
  double landscape_energy_;
  Options options_;
  double energy_ = 0.0, violation_ = 0.0;
  double direct_step_, contour_step_;  // lengths to try next [sigma]
  double goal_tried_;                  // distance from which the straight way to the goal was found forbidden
  double length_before_ = 0.0;         // of the contour step before; 0 after a direct one
  std::uint64_t evaluations_ = 0;
  std::vector<std::uint64_t> corrections_;
  std::string failure_;
  bool gradient_known_ = false;
  double trial_energy_ = 0.0;
  AlignedArray gradient_, trial_gradient_, tangent_, trial_tangent_, tangent_before_, moved_, move_, chord_, scratch_;
  AlignedArray zero_;  // to which products are added
};

}  // namespace lanescape
