#include "stepper/adaptive_contour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lanescape {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint64_t max_returns = 8;  // along the gradient, of one step

}  // namespace

AdaptiveContourStepper::AdaptiveContourStepper(SoftLandscape& landscape, double landscape_energy, const Options& options)
    : landscape_(&landscape),
      landscape_energy_(landscape_energy),
      options_(options),
      direct_step_(0.05 * options.unit),
      contour_step_(0.01 * options.unit),
      goal_tried_(infinity),
      corrections_(16, 0),
      gradient_(landscape.dimension(), 0.0),
      trial_gradient_(gradient_),
      along_(gradient_),
      trial_along_(gradient_),
      before_(gradient_),
      chord_(gradient_),
      scratch_(gradient_) {}

// Where the goal lies downhill the flow leaves the contour: P is 1 there.
AdaptiveContourStepper::Flow AdaptiveContourStepper::flow(const AlignedArray& to_goal, const AlignedArray& gradient,
                                                          AlignedArray& along) const {
  const VectorAlgebra& algebra = landscape_->algebra();
  const double square = algebra.dot(gradient, gradient);
  const double rise = std::max(0.0, algebra.dot(gradient, to_goal));
  algebra.axpy(along, to_goal, square > 0.0 ? -rise / square : 0.0, gradient);
  return {std::sqrt(square), algebra.norm(along)};
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
  while (length > options_.shortest_step * options_.unit) {
    const double shorter = try_straight(at, length, steepness, next);
    if (shorter == 0.0) {
      direct_step_ = std::min(std::max(direct_step_, 2.0 * length), options_.longest_step * options_.unit);
      return true;
    }
    length = direct_step_ = shorter;
  }
  return false;
}

double AdaptiveContourStepper::try_straight(const PathPoint& at, double length, double steepness, AlignedArray& next) {
  const VectorAlgebra& algebra = landscape_->algebra();
  const double part = length / at.distance;
  const double limit = landscape_energy_ + (part == 1.0 ? options_.slack * options_.unit * steepness : 0.0);
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
  const Flow here = flow(at.to_goal, gradient_, along_);
  if (!(here.steepness > 0.0)) {
    failure_ = "the direct step is forbidden and the potential is flat";
    return false;
  }
  if (!(here.length > 1e-12 * at.distance)) {
    failure_ = "the direction to the goal is parallel to the gradient";
    return false;
  }
  double length = contour_step_;
  while (length > options_.shortest_step * options_.unit) {
    const double shorter = try_contour(at, here, length, next);
    if (shorter == 0.0) return true;
    length = shorter;
  }
  failure_ = fmt::format("no step along the contour longer than {} is allowed", options_.shortest_step * options_.unit);
  return false;
}

double AdaptiveContourStepper::try_contour(const PathPoint& at, const Flow& here, double length, AlignedArray& next) {
  const VectorAlgebra& algebra = landscape_->algebra();
  const double extra = length_before_ > 0.0 ? 0.5 * length / length_before_ : 0.0;
  const double lift = std::clamp((level(here.steepness) - energy_) / here.steepness, -length, 0.1 * length);
  algebra.combine(next, at.position, length * (1.0 + extra) / here.length, along_, lift / here.steepness, gradient_);
  if (extra > 0.0) algebra.axpy(next, next, -length * extra / before_norm_, before_);
  evaluate(next);
  const std::optional<std::uint64_t> returns = return_to_allowed(next, length);
  if (!returns) return 0.5 * length;
  algebra.difference(chord_, next, at.position);
  const double ratio = options_.tolerance / relative_error(at, here, length);
  const double factor = std::clamp(0.9 * (extra > 0.0 ? std::sqrt(ratio) : ratio), 0.2, 2.0);
  const double fine = options_.fine_step * options_.unit;
  if (!(ratio >= 1.0) && length > fine) return std::max(std::min(factor, 0.8) * length, fine);
  if (!segment_is_allowed(at, here.steepness)) return 0.5 * length;
  before_.swap(along_);
  before_norm_ = here.length;
  length_before_ = length;
  contour_step_ = std::min(std::max(factor * length, fine), options_.longest_step * options_.unit);
  ++corrections_[std::min<std::size_t>(*returns, corrections_.size() - 1)];
  return 0.0;
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

// Of the trial, R + chord_: the local error of its place, from how the direction there differs from the extrapolated one.
double AdaptiveContourStepper::relative_error(const PathPoint& at, const Flow& here, double length) {
  const VectorAlgebra& algebra = landscape_->algebra();
  algebra.axpy(scratch_, at.to_goal, -1.0, chord_);
  const Flow there = flow(scratch_, trial_gradient_, trial_along_);
  const double extra = length_before_ > 0.0 ? length / length_before_ : 0.0;
  algebra.axpy(scratch_, trial_along_, -there.length * (1.0 + extra) / here.length, along_);
  if (extra > 0.0) algebra.axpy(scratch_, scratch_, there.length * extra / before_norm_, before_);
  const double turn = algebra.norm(scratch_) / there.length;
  if (!std::isfinite(turn)) return infinity;
  return std::max(1e-12, (extra > 0.0 ? 5.0 / 12.0 : 0.5) * turn);
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
  archive.field("before_norm", before_norm_);
  archive.field("before", before_);
  archive.field("evaluations", evaluations_);
  archive.field("corrections", corrections_);
  landscape_->exchange(archive);
  if (!archive.reading()) return;
  // Not archived: the same position gives the same gradient, to the bit.
  gradient_known_ = known != 0;
  if (gradient_known_) landscape_->energy_and_gradient(position, gradient_);
}

}  // namespace lanescape
