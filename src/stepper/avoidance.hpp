#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/archive.hpp"
#include "landscape/hard_landscape.hpp"
#include "stepper/avoidance_statistics.hpp"
#include "stepper/direct.hpp"

namespace lanescape {

// Throws Error(bad_input) naming the allowed words.
kernels::ContactPotential parse_contact_potential(std::string_view word);
const char* to_string(kernels::ContactPotential potential);

// Direct steps. Where spheres would overlap, collision-avoidance steps ([G] Eqs. 3.16-3.33): from R(t), every particle that
// overlapped in a failed trial moves by one small distance along the sum of its fictitious forces over all trials so far, until
// none overlaps.
class AvoidanceStepper {
 public:
  struct Options {
    double direct_step = 1e-2;     // length of a step in 3N space [sigma]
    double avoidance_step = 1e-4;  // of each particle that moves [sigma]
    kernels::ContactPotential potential = kernels::ContactPotential::harmonic;
    std::uint64_t max_trials = 10'000;  // of one avoidance step
  };
  // Overlaps and moved particles are counted in every eighth avoidance step: neighbouring steps hardly differ, and counting takes
  // half as long as a step.
  static constexpr std::uint64_t statistics_interval = 8;

  AvoidanceStepper(HardLandscape& landscape, const Options& options);

  std::optional<StepKind> step(const PathPoint& at, AlignedArray& next);

  double step_length() const { return options_.direct_step; }
  double monitored() const { return static_cast<double>(moved_); }  // particles moved by the last step
  double violation() const { return 0.0; }                          // accepted points have no overlap, by an exact test
  std::uint64_t evaluations() const { return evaluations_; }        // of whole configurations for overlaps
  const std::string& failure() const { return failure_; }
  // How many avoidance steps took 1, 2, 3, ... trials after the failed direct one; the last entry counts all beyond.
  const std::vector<std::uint64_t>& corrections() const { return corrections_; }
  const AvoidanceStatistics& statistics() const { return statistics_; }
  std::vector<StepHistogram> histograms() const { return statistics_.histograms(); }

  void exchange(Archive& archive, const AlignedArray& position);

 private:
  HardLandscape* landscape_;
  Options options_;
  std::size_t moved_ = 0;
  std::uint64_t evaluations_ = 0, avoidance_steps_ = 0;
  std::vector<std::uint64_t> corrections_;
  std::string failure_;
  AvoidanceStatistics statistics_;
  AlignedArray force_, sum_;
};

}  // namespace lanescape
