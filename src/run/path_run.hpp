#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/model.hpp"
#include "core/decimated_trace.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "path/finder.hpp"
#include "run/checkpoint.hpp"
#include "run/end_point_run.hpp"
#include "stepper/avoidance.hpp"

namespace lanescape {

// Contour and escape for soft particles, avoidance and away for hard spheres.
enum class PathMethod { contour, escape, avoidance, away };
// Throws Error(bad_input) naming the allowed words.
PathMethod parse_path_method(std::string_view word);
const char* to_string(PathMethod method);
// Whether it is for hard spheres.
bool is_hard(PathMethod method);
// Throws Error(bad_input) where the method is not for this kind of model.
void check_method(PathMethod method, const Model& model);

struct PathRunOptions {
  PathMethod method = PathMethod::contour;
  std::optional<double> direct_step;  // delta_di, in 3N space; else 0.001 soft, 0.01 hard; none for away [sigma]
  double avoidance_step = 1e-4;       // delta_ca, of each particle that moves [sigma]
  kernels::ContactPotential fictitious = kernels::ContactPotential::harmonic;
  std::optional<double> landscape_energy;  // E_L; else the higher of the two ends [epsilon]
  bool reverse = false;                    // search from the far end too and keep the shorter path
  FinderOptions finder;
  int threads = 1;  // paths searched at once, or of one path the evaluations; no effect on any result
  Precision precision = Precision::double_precision;  // of soft particles
  double step_length() const;
  // Throws Error(bad_input) naming the option that is out of range.
  void check() const;
};

// How often a quantity of a path's steps took a value: entry k is for `first` + k `width`, its upper edge where values are not
// whole numbers.
struct StepHistogram {
  std::string quantity;
  double first, width;
  std::vector<std::uint64_t> counts;

  double mean() const;
};

struct PathResult {
  Outcome outcome = Outcome::running;
  std::string reason;                 // why it ended where it did not reach its goal
  bool reversed = false;              // found from R_f to R_i; frames and trace run that way
  double length = 0.0;                // g [sigma], the last hop included
  double distance = 0.0;              // DeltaR = |R_f - R_i| [sigma]
  double participation_number = 0.0;  // n, mean over steps weighted with their length
  std::uint64_t direct_steps = 0, detour_steps = 0, evaluations = 0;
  std::vector<std::uint64_t> corrections;  // histogram of the stepper's inner iterations per detour
  double landscape_energy = 0.0;           // E_L, soft [epsilon]
  double largest_violation = 0.0;  // soft: largest V - E_L of an accepted point; hard: deepest overlap in a frame; at least 0
  std::vector<StepHistogram> histograms;
  // Of each particle, user's order: g_j, and the distance between its ends [sigma].
  std::vector<double> particle_lengths, particle_displacements;
  std::vector<double> heterogeneity;  // heterogeneity_widths() per species
  double seconds = 0.0;
  DecimatedTrace trace{PathRecorder::columns, PathRecorder::trace_rows};
  std::vector<Configuration> frames;  // from one end to the other, ends included

  double ratio_squared() const { return length > 0.0 ? distance * distance / (length * length) : 0.0; }
};

// Throws Error(bad_input) where the ends of a pair differ in box, composition or radii, coincide or overlap; the message starts
// with `where`.
void check_end_points(const ConfigurationPair& pair, const Model& model, const std::string& where);

// One path for each pair, paths in parallel. The results do not depend on the number of threads, nor on interruption and
// resumption. Throws Error(bad_input) for a pair that check_end_points() refuses or with an end above a given landscape energy, and
// for a method that is not for this kind of model.
std::vector<PathResult> run_paths(const Model& model, const std::vector<ConfigurationPair>& pairs, const PathRunOptions& options,
                                  Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor);

}  // namespace lanescape
