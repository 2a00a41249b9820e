#include "stepper/escape.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lanescape {

EscapeStepper::EscapeStepper(SoftLandscape& landscape, double landscape_energy, const Options& options)
    : landscape_(&landscape),
      landscape_energy_(landscape_energy),
      options_(options),
      corrections_(16, 0),
      gradient_(landscape.dimension(), 0.0) {}

std::optional<StepKind> EscapeStepper::step(const PathPoint& at, AlignedArray& next) {
  const VectorAlgebra& algebra = landscape_->algebra();
  direct_trial(algebra, at, options_.direct_step, next);
  // Evaluates the gradient too: near the boundary, where a path spends its time, the trial is nearly always forbidden.
  ++evaluations_;
  energy_ = landscape_->energy_and_gradient(next, gradient_);
  if (allowed(energy_)) return StepKind::direct;
  for (std::uint64_t n = 1; n <= options_.max_iterations; ++n) {
    const double slope_squared = algebra.dot(gradient_, gradient_);
    if (!(slope_squared > 0.0)) {
      failure_ = "the trial is forbidden and the potential is flat";
      return std::nullopt;
    }
    algebra.axpy(next, next, -(energy_ - landscape_energy_) / slope_squared, gradient_);
    const bool with_gradient = n < expected_iterations_;
    ++evaluations_;
    energy_ = with_gradient ? landscape_->energy_and_gradient(next, gradient_) : landscape_->energy(next);
    if (allowed(energy_)) {
      ++corrections_[std::min<std::size_t>(n, corrections_.size() - 1)];
      expected_iterations_ = n;
      return StepKind::detour;
    }
    if (with_gradient) continue;
    ++evaluations_;
    landscape_->energy_and_gradient(next, gradient_);
  }
  failure_ = fmt::format("no allowed point after {} iterations of the descent", options_.max_iterations);
  return std::nullopt;
}

void EscapeStepper::exchange(Archive& archive, const AlignedArray&) {
  archive.field("stepper_energy", energy_);
  archive.field("evaluations", evaluations_);
  archive.field("corrections", corrections_);
  archive.field("expected_iterations", expected_iterations_);
  landscape_->exchange(archive);
}

}  // namespace lanescape
