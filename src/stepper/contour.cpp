#include "stepper/contour.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lanescape {

ContourStepper::ContourStepper(SoftLandscape& landscape, double landscape_energy, const Options& options)
    : landscape_(&landscape),
      landscape_energy_(landscape_energy),
      options_(options),
      bound_(landscape, options.direct_step),
      corrections_(16, 0),
      gradient_(landscape.dimension(), 0.0),
      trial_gradient_(landscape.dimension(), 0.0),
      along_(landscape.dimension(), 0.0) {}

bool ContourStepper::known_forbidden(const PathPoint& at) {
  if (!gradient_known_) return false;
  along_goal_ = landscape_->algebra().dot(gradient_, at.to_goal);
  return bound_.exceeds(at.position, energy_, along_goal_ / at.distance, landscape_energy_);
}

// The direction f = d - (d.n) n along the contour, kept as |R_f - R| f in along_.
std::optional<ContourStepper::Contour> ContourStepper::find_contour(const PathPoint& at) {
  const VectorAlgebra& algebra = landscape_->algebra();
  if (!gradient_known_) {
    ++evaluations_;
    landscape_->energy_and_gradient(at.position, gradient_);
    gradient_known_ = true;
    along_goal_ = algebra.dot(gradient_, at.to_goal);
  }
  const double slope = algebra.norm(gradient_);
  if (!(slope > 0.0)) {
    failure_ = "the direct step is forbidden and the potential is flat";
    return std::nullopt;
  }
  algebra.axpy(along_, at.to_goal, -along_goal_ / (slope * slope), gradient_);
  const double along_length = algebra.norm(along_);
  if (!(along_length > 1e-12 * at.distance)) {
    failure_ = "the direction to the goal is parallel to the gradient";
    return std::nullopt;
  }
  return Contour{slope, along_length};
}

std::optional<StepKind> ContourStepper::step(const PathPoint& at, AlignedArray& next) {
  const VectorAlgebra& algebra = landscape_->algebra();
  const bool forbidden = known_forbidden(at);
  if (!forbidden || landscape_->has_history()) direct_trial(algebra, at, options_.direct_step, next);
  if (forbidden) {
    if (landscape_->has_history()) landscape_->pass_over(next);
  } else {
    ++evaluations_;
    const double direct_energy = landscape_->energy(next);
    if (direct_energy <= landscape_energy_) {
      energy_ = direct_energy;
      gradient_known_ = false;
      bound_.moved(options_.direct_step);
      return StepKind::direct;
    }
  }
  const std::optional<Contour> contour = find_contour(at);
  if (!contour) return std::nullopt;
  for (std::uint64_t k = 0; k <= options_.max_corrections; ++k) {
    const double back = -static_cast<double>(k) * options_.correction / contour->slope;
    algebra.combine(next, at.position, options_.direct_step / contour->along_length, along_, back, gradient_);
    ++evaluations_;
    // Evaluates the gradient too: this trial is nearly always accepted, and the next detour starts from it.
    const double energy = landscape_->energy_and_gradient(next, trial_gradient_);
    if (energy <= landscape_energy_) {
      energy_ = energy;
      gradient_.swap(trial_gradient_);
      bound_.moved(options_.direct_step + static_cast<double>(k) * options_.correction);
      ++corrections_[std::min<std::size_t>(k, corrections_.size() - 1)];
      return StepKind::detour;
    }
  }
  failure_ =
      fmt::format("no allowed point after {} corrections of {} along the gradient", options_.max_corrections, options_.correction);
  return std::nullopt;
}

void ContourStepper::exchange(Archive& archive, const AlignedArray& position) {
  std::uint64_t known = gradient_known_ ? 1 : 0;
  archive.field("gradient_known", known);
  archive.field("stepper_energy", energy_);
  archive.field("evaluations", evaluations_);
  archive.field("corrections", corrections_);
  bound_.exchange(archive);
  landscape_->exchange(archive);
  if (!archive.reading()) return;
  // Not archived: the same position gives the same gradient, to the bit.
  gradient_known_ = known != 0;
  if (gradient_known_) landscape_->energy_and_gradient(position, gradient_);
}

}  // namespace lanescape
