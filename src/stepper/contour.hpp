#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "core/archive.hpp"
#include "landscape/soft_landscape.hpp"
#include "stepper/direct.hpp"
#include "stepper/trial_bound.hpp"

namespace lanescape {

// Direct steps. Where one is forbidden, a step along the contour of V through the current point ([C] Eqs. 11-15).
class ContourStepper {
 public:
  struct Options {
    double direct_step = 1e-3;  // length of a step in 3N space [sigma]
    double correction = 1e-5;   // of each correction against the gradient [sigma]
    std::uint64_t max_corrections = 100'000;
  };

  ContourStepper(SoftLandscape& landscape, double landscape_energy, const Options& options);

  std::optional<StepKind> step(const PathPoint& at, AlignedArray& next);

  double step_length() const { return options_.direct_step; }
  double monitored() const { return energy_; }  // V at the last accepted point
  double violation() const { return energy_ - landscape_energy_; }
  std::uint64_t evaluations() const {
    return evaluations_;
  }  // of V, with or without gradient; not of trials that are known to be forbidden
  const std::string& failure() const { return failure_; }
  // How many contour steps took k = 0, 1, 2, ... corrections; the last entry counts all beyond.
  const std::vector<std::uint64_t>& corrections() const { return corrections_; }

  void exchange(Archive& archive, const AlignedArray& position);

 private:
  struct Contour {
    double slope, along_length;  // |grad V|, |along_|
  };
  // Whether the direct trial is forbidden for certain.
  bool known_forbidden(const PathPoint& at);
  std::optional<Contour> find_contour(const PathPoint& at);

  SoftLandscape* landscape_;
  double landscape_energy_;
  Options options_;
  TrialBound bound_;
  double energy_ = 0.0;
  std::uint64_t evaluations_ = 0;
  std::vector<std::uint64_t> corrections_;
  std::string failure_;
  // Whether gradient_ is that of the current point: so if the last accepted trial was evaluated with it.
  bool gradient_known_ = false;
  double along_goal_ = 0.0;  // grad V . (R_f - R), where the gradient is known
  AlignedArray gradient_, trial_gradient_, along_;
};

}  // namespace lanescape
