#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/model.hpp"
#include "configuration/particle_layout.hpp"
#include "core/decimated_trace.hpp"
#include "core/run_monitor.hpp"
#include "core/step_histogram.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "landscape/soft_landscape.hpp"
#include "path/finder.hpp"
#include "run/configuration_pair.hpp"
#include "run/path_method.hpp"
#include "run/run_loop.hpp"
#include "stepper/avoidance.hpp"

namespace lanescape {

struct PathRunOptions {
  const PathMethod* method = &default_path_method(false);
  // Faithful: every step as published, of the lengths below. Adaptive: as long as an estimate of the error allows.
  Stepping stepping = Stepping::faithful;
  std::optional<double> direct_step;     // delta_di, in 3N space; else the method's own in the model's unit of length [sigma]
  std::optional<double> avoidance_step;  // delta_ca, of each particle that moves; else 1e-4 of that unit [sigma]
  kernels::ContactPotential fictitious = kernels::ContactPotential::harmonic;
  std::optional<double> escape_tolerance;  // dV of the escape method; else 1e-4 [epsilon]
  // Of one detour, after which the path is stalled: corrections (contour), iterations (escape), trials (avoidance), moves of single
  // spheres (away); else the stepper's own.
  std::optional<std::uint64_t> max_trials;
  std::optional<std::uint64_t> max_depth;  // of the away method: spheres pushed one by the other; else 2000
  std::optional<double> landscape_energy;  // E_L; else the higher of the two ends [epsilon]
  bool reverse = false;                    // search from the far end too and keep the shorter path
  FinderOptions finder;
  int threads = 1;  // paths searched at once, or of one path the evaluations; no effect on any result
  Precision precision = Precision::double_precision;  // of soft particles

  // Whether direct steps have a given length.
  bool has_step_length() const { return stepping == Stepping::faithful && method->direct_step.has_value(); }
  // The length of direct steps; 0 where they have none.
  double step_length(const AnyModel& model) const {
    return has_step_length() ? direct_step.value_or(*method->direct_step * length_unit(model)) : 0.0;
  }
  double avoidance_step_length(const AnyModel& model) const { return avoidance_step.value_or(1e-4 * length_unit(model)); }
  // Throws Error(bad_input) naming the option that is out of range.
  void check(const AnyModel& model) const;
};

// A landscape for a pair's particles, in positions and this order.
using LandscapeOfPair = std::function<std::unique_ptr<SoftLandscape>(const ConfigurationPair&, const ParticleLayout&)>;

struct PathResult {
  Outcome outcome = Outcome::running;
  std::string reason;                 // why it ended where it did not reach its goal
  bool reversed = false;              // found from R_f to R_i; frames and trace run that way
  double length = 0.0;                // g [sigma], the last hop included
  double distance = 0.0;              // DeltaR = |R_f - R_i| [sigma]
  double participation_number = 0.0;  // n, mean over steps weighted with their length
  std::uint64_t direct_steps = 0, detour_steps = 0, evaluations = 0;
  double direct_length = 0.0, detour_length = 0.0;  // g by kind of step; the last hop is direct [sigma]
  std::vector<std::uint64_t> corrections;           // histogram of the stepper's inner iterations per detour
  double landscape_energy = 0.0;                    // E_L, soft [epsilon]
  double largest_violation = 0.0;  // soft: largest V - E_L of an accepted point, of adaptive steps along their segments; hard:
                                   // deepest overlap in a frame; at least 0
  std::vector<StepHistogram> histograms;
  // Of each particle, user's order: g_j, and the distance between its ends [sigma].
  std::vector<double> particle_lengths, particle_displacements;
  std::vector<double> heterogeneity;  // heterogeneity_widths() per species
  double seconds = 0.0;
  DecimatedTrace trace{PathRecorder::columns, PathRecorder::trace_rows};
  std::vector<Configuration> frames;  // from one end to the other, ends included

  double ratio_squared() const { return length > 0.0 ? distance * distance / (length * length) : 0.0; }
};

// One path for each pair, paths in parallel. The results depend neither on the number of threads nor on interruption and
// resumption. Throws Error(bad_input) for a pair that prepare_pair() refuses, and for a method that is not for this kind of model.
// `landscape`, in place of the model's, serves one path after the other.
std::vector<PathResult> run_paths(const AnyModel& model, const std::vector<ConfigurationPair>& pairs, const PathRunOptions& options,
                                  Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor,
                                  const LandscapeOfPair& landscape = {});

}  // namespace lanescape
