#include "stepper/adaptive_contour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lanescape {
namespace {

// Of the displacement before; 1/3 is that of the second backward differentiation formula, extrapolated.
constexpr double momentum = 1.0 / 3.0;
constexpr std::uint64_t max_returns = 8;  // along the gradient, of one step
// Lengths, in the model's unit.
constexpr double slack = 1e-6;      // distance by which the straight way to the goal may leave the allowed region, for rounding
constexpr double fine_step = 1e-4;  // below it steps are not shortened for their error: gradients may jump
constexpr double shortest_step = 1e-10, longest_step = 0.5;

}  // namespace

AdaptiveContourStepper::AdaptiveContourStepper(SoftLandscape& landscape, double landscape_energy, const Options& options)
    : landscape_(&landscape),
      landscape_energy_(landscape_energy),
      options_(options),
      direct_step_(0.05 * options.unit),
      contour_step_(0.01 * options.unit),
      goal_tried_(std::numeric_limits<double>::infinity()),
      corrections_(16, 0),
      gradient_(landscape.dimension(), 0.0),
      trial_gradient_(gradient_),
      tangent_(gradient_),
      trial_tangent_(gradient_),
      tangent_before_(gradient_),
      moved_(gradient_),
      move_(gradient_),
      chord_(gradient_),
      scratch_(gradient_),
      zero_(gradient_) {}

// Where the goal lies downhill the flow leaves the contour: P is 1 there.
AdaptiveContourStepper::Flow AdaptiveContourStepper::flow(const AlignedArray& to_goal, const AlignedArray& gradient,
                                                          AlignedArray& tangent) const {
  const VectorAlgebra& algebra = landscape_->algebra();
  const double square = algebra.dot(gradient, gradient);
  const double rise = std::max(0.0, algebra.dot(gradient, to_goal));
  algebra.axpy(tangent, to_goal, square > 0.0 ? -rise / square : 0.0, gradient);
  const double along = algebra.norm(tangent);
  algebra.axpy(tangent, zero_, 1.0 / along, tangent);
  return {std::sqrt(square), along};
}

double AdaptiveContourStepper::evaluate(const AlignedArray& position) {
  ++evaluations_;
  return trial_energy_ = landscape_->energy_and_gradient(position, trial_gradient_);
}

// V at R + part * along.
double AdaptiveContourStepper::energy_at(const PathPoint& at, double part, const AlignedArray& along) {
  landscape_->algebra().axpy(scratch_, at.position, part, along);
  ++evaluations_;
  return landscape_->energy(scratch_);
}

std::optional<StepKind> AdaptiveContourStepper::step(const PathPoint& at, AlignedArray& next) {
  const VectorAlgebra& algebra = landscape_->algebra();
  if (!gradient_known_) {
    energy_ = evaluate(at.position);
    gradient_.swap(trial_gradient_);
    gradient_known_ = true;
  }
  if (hop(at, next)) return StepKind::direct;
  const double slope = algebra.dot(gradient_, at.to_goal) / at.distance, steepness = algebra.norm(gradient_);
  const double room = level(steepness) - energy_;
  if (slope <= 0.0 || room > 0.1 * contour_step_ * slope)
    if (go_straight(at, slope, steepness, next)) return StepKind::direct;
  if (follow_contour(at, next)) return StepKind::detour;
  return std::nullopt;
}

bool AdaptiveContourStepper::hop(const PathPoint& at, AlignedArray& next) {
  if (at.distance > std::min(2.0 * contour_step_, 0.5 * goal_tried_)) return false;
  if (try_straight(at, at.distance, landscape_->algebra().norm(gradient_), next) == 0.0) return true;
  goal_tried_ = at.distance;
  return false;
}

bool AdaptiveContourStepper::go_straight(const PathPoint& at, double slope, double steepness, AlignedArray& next) {
  double length = std::min(direct_step_, at.distance);
  if (slope > 0.0) length = std::min(length, (level(steepness) - energy_) / slope);
  while (length > shortest_step * options_.unit) {
    const double shorter = try_straight(at, length, steepness, next);
    if (shorter == 0.0) {
      direct_step_ = std::min(std::max(direct_step_, 2.0 * length), longest_step * options_.unit);
      return true;
    }
    length = direct_step_ = shorter;
  }
  direct_step_ = contour_step_;
  return false;
}

double AdaptiveContourStepper::try_straight(const PathPoint& at, double length, double steepness, AlignedArray& next) {
  const VectorAlgebra& algebra = landscape_->algebra();
  const double part = length / at.distance;
  const double limit = landscape_energy_ + (part == 1.0 ? slack * options_.unit * steepness : 0.0);
  algebra.axpy(next, at.position, part, at.to_goal);
  const double energy = evaluate(next);
  if (!std::isfinite(energy)) return 0.25 * length;
  const CubicSegment segment{energy_, energy, part * algebra.dot(gradient_, at.to_goal),
                             part * algebra.dot(trial_gradient_, at.to_goal)};
  const double aim = level(steepness);
  if (energy > limit) return length * (energy_ < aim ? std::clamp(segment.crossing(aim), 0.1, 0.9) : 0.5);
  const double error = std::abs(energy_at(at, 0.5 * part, at.to_goal) - segment.at(0.5));
  double highest = segment.maximum().value;
  for (int k = 1; k < 16; ++k) {
    const double x = k / 16.0, between = 4.0 * x * (1.0 - x);
    highest = std::max(highest, segment.at(x) + 2.0 * error * between * between);
  }
  if (!(highest <= limit)) return 0.5 * length;
  length_before_ = 0.0;
  accept(highest);
  return 0.0;
}

bool AdaptiveContourStepper::follow_contour(const PathPoint& at, AlignedArray& next) {
  const Flow here = flow(at.to_goal, gradient_, tangent_);
  if (!(here.steepness > 0.0)) {
    failure_ = "the direct step is forbidden and the potential is flat";
    return false;
  }
  if (!(here.along > 1e-12 * at.distance)) {
    failure_ = "the direction to the goal is parallel to the gradient";
    return false;
  }
  double length = contour_step_;
  while (length > shortest_step * options_.unit) {
    const double shorter = try_contour(at, here.steepness, length, next);
    if (shorter == 0.0) return true;
    length = shorter;
  }
  failure_ = fmt::format("no step along the contour longer than {} is allowed", shortest_step * options_.unit);
  return false;
}

double AdaptiveContourStepper::try_contour(const PathPoint& at, double steepness, double length, AlignedArray& next) {
  const VectorAlgebra& algebra = landscape_->algebra();
  predict(length);
  const double lift = std::clamp((level(steepness) - energy_) / steepness, -length, 0.1 * length);
  algebra.combine(next, at.position, 1.0, move_, lift / steepness, gradient_);
  evaluate(next);
  const std::optional<std::uint64_t> returns = return_to_allowed(next, length);
  if (!returns) return 0.5 * length;
  algebra.difference(chord_, next, at.position);
  const double ratio = options_.tolerance / relative_error(at, length);
  const double factor = std::clamp(0.9 * (length_before_ > 0.0 ? std::sqrt(ratio) : ratio), 0.2, 2.0);
  const double fine = fine_step * options_.unit;
  if (!(ratio >= 1.0) && length > fine) return std::max(std::min(factor, 0.8) * length, fine);
  if (!segment_is_allowed(at, steepness)) return 0.5 * length;
  tangent_before_.swap(tangent_);
  moved_.swap(move_);
  length_before_ = length;
  contour_step_ = std::clamp(factor * length, fine, longest_step * options_.unit);
  ++corrections_[std::min<std::size_t>(*returns, corrections_.size() - 1)];
  return 0.0;
}

// The displacement of a step in move_, without its way back to the level: after a direct step by Euler's method, else `momentum`
// times the displacement before and what makes it of second order for any ratio of the two lengths.
void AdaptiveContourStepper::predict(double length) {
  const VectorAlgebra& algebra = landscape_->algebra();
  if (!(length_before_ > 0.0)) return algebra.axpy(move_, zero_, length, tangent_);
  const double growth = length / length_before_, old = 0.5 * (growth + momentum);
  algebra.combine(move_, zero_, momentum * growth, moved_, -old * length, tangent_before_);
  algebra.axpy(move_, move_, (1.0 - momentum + old) * length, tangent_);
}

// Newton's method along the gradient, where the trial lies above E_L. Returns the number of its steps, or nothing if the trial is
// too far away for it.
std::optional<std::uint64_t> AdaptiveContourStepper::return_to_allowed(AlignedArray& next, double length) {
  const VectorAlgebra& algebra = landscape_->algebra();
  for (std::uint64_t returns = 0; returns <= max_returns; ++returns) {
    if (trial_energy_ <= landscape_energy_) return returns;
    const double steepness = algebra.norm(trial_gradient_), back = (trial_energy_ - level(steepness)) / steepness;
    if (!(back < 0.2 * length + options_.margin * options_.unit)) return std::nullopt;
    algebra.axpy(next, next, -back / steepness, trial_gradient_);
    evaluate(next);
  }
  return std::nullopt;
}

// Of the trial, R + chord_: the error of its place over the length of the step, from how the direction there differs from the
// extrapolated one.
double AdaptiveContourStepper::relative_error(const PathPoint& at, double length) {
  const VectorAlgebra& algebra = landscape_->algebra();
  algebra.axpy(scratch_, at.to_goal, -1.0, chord_);
  flow(scratch_, trial_gradient_, trial_tangent_);
  const bool second_order = length_before_ > 0.0;
  const double growth = second_order ? length / length_before_ : 0.0;
  algebra.combine(scratch_, trial_tangent_, -1.0 - growth, tangent_, growth, tangent_before_);
  const double turn = algebra.norm(scratch_);
  if (!std::isfinite(turn)) return std::numeric_limits<double>::infinity();
  return std::max(1e-12, (second_order ? (5.0 + momentum) / (12.0 * (1.0 - momentum)) : 0.5) * turn);
}

// Accepts the trial, R + chord_, if V stays below E_L on the way there.
bool AdaptiveContourStepper::segment_is_allowed(const PathPoint& at, double steepness) {
  const VectorAlgebra& algebra = landscape_->algebra();
  const CubicSegment segment{energy_, trial_energy_, algebra.dot(gradient_, chord_), algebra.dot(trial_gradient_, chord_)};
  const CubicSegment::Maximum estimate = segment.maximum();
  double highest = estimate.value;
  const bool between = estimate.x > 0.0 && estimate.x < 1.0;
  if (between && highest > landscape_energy_ - 0.5 * options_.margin * options_.unit * steepness)
    highest = std::max(energy_at(at, estimate.x, chord_), std::max(energy_, trial_energy_));
  if (!(highest <= landscape_energy_)) return false;
  accept(highest);
  return true;
}

void AdaptiveContourStepper::accept(double highest) {
  energy_ = trial_energy_;
  gradient_.swap(trial_gradient_);
  violation_ = highest - landscape_energy_;
}

void AdaptiveContourStepper::exchange(Archive& archive, const AlignedArray& position) {
  std::uint64_t known = gradient_known_ ? 1 : 0;
  archive.field("gradient_known", known);
  archive.field("stepper_energy", energy_);
  archive.field("direct_step", direct_step_);
  archive.field("contour_step", contour_step_);
  archive.field("goal_tried", goal_tried_);
  archive.field("length_before", length_before_);
  archive.field("tangent_before", tangent_before_);
  archive.field("moved", moved_);
  archive.field("evaluations", evaluations_);
  archive.field("corrections", corrections_);
  landscape_->exchange(archive);
  if (!archive.reading()) return;
  // Not archived: the same position gives the same gradient, to the bit.
  gradient_known_ = known != 0;
  if (gradient_known_) landscape_->energy_and_gradient(position, gradient_);
}

}  // namespace lanescape
