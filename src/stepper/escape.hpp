#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/archive.hpp"
#include "landscape/soft_landscape.hpp"
#include "stepper/direct.hpp"

namespace lanescape {

// Direct steps. Where one is forbidden, a Newton descent from the trial back to the allowed region ([G] Eq. 3.11). A point is
// allowed if V <= E_L + dV, so that the descent ends.
//
// The method needs dV well below delta_di |grad V|. Otherwise paths zigzag within the shell E_L ... E_L + dV and grow longer.
class EscapeStepper {
 public:
  struct Options {
    double direct_step = 1e-3;  // length of a direct step in 3N space [sigma]
    double tolerance = 1e-4;    // dV [epsilon]
    std::uint64_t max_iterations = 10'000;
  };

  EscapeStepper(SoftLandscape& landscape, double landscape_energy, const Options& options);

  std::optional<StepKind> step(const PathPoint& at, AlignedArray& next);

  double step_length() const { return options_.direct_step; }
  double monitored() const { return energy_; }  // V at the last accepted point
  double violation() const { return energy_ - landscape_energy_; }
  std::uint64_t evaluations() const { return evaluations_; }
  const std::string& failure() const { return failure_; }
  // How many escape steps took 1, 2, 3, ... iterations of Eq. 3.11 (entry 0 stays 0); the last entry counts all beyond.
  const std::vector<std::uint64_t>& corrections() const { return corrections_; }

  void exchange(Archive& archive, const AlignedArray& position);

 private:
  bool allowed(double energy) const { return energy <= landscape_energy_ + options_.tolerance; }

  SoftLandscape* landscape_;
  double landscape_energy_;
  Options options_;
  double energy_ = 0.0;
  std::uint64_t evaluations_ = 0;
  std::vector<std::uint64_t> corrections_;
  std::string failure_;
  // Iterations of the last escape. The next one likely takes as many: up to there it evaluates gradients with the energies.
  std::uint64_t expected_iterations_ = 1;
  AlignedArray gradient_;
};

}  // namespace lanescape
