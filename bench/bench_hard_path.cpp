// A whole path of binary hard spheres, N = 108, DeltaR = 108, by collision avoidance with [G]'s own step lengths, and by slides
// along contacts (adaptive steps) between the same ends. Event-driven dynamics generates the end points. The instruction set is the
// best available one, or LANESCAPE_ISA.

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "bench_support.hpp"
#include "reference/hard_sphere.hpp"
#include "run/end_point_run.hpp"
#include "run/path_run.hpp"

namespace lanescape::bench {
namespace {

const ConfigurationPair& ends(double packing_fraction) {
  static std::map<double, ConfigurationPair> made;
  const auto found = made.find(packing_fraction);
  if (found != made.end()) return found->second;
  HardEndPointOptions options;
  options.distance = 108.0;
  options.equilibration_collisions = 1'000'000;
  SilentMonitor monitor;
  const auto run = run_hard_end_points(hard_sphere_binary(), hard_liquid(hard_sphere_binary(), 108, packing_fraction), options,
                                       available_isas().front(), {}, monitor);
  return made.emplace(packing_fraction, run.pairs.front()).first->second;
}

// Checks a path by the scalar reference and by geometry; returns the first error, or an empty string.
std::string check(const PathResult& path) {
  if (path.outcome != Outcome::reached) return fmt::format("{}: {}", to_string(path.outcome), path.reason);
  for (const Configuration& frame : path.frames)
    if (reference::any_overlap(frame.positions, frame.radii, frame.box.length)) return "a frame has overlaps, by the reference";
  double line = 0.0;
  for (std::size_t k = 1; k < path.frames.size(); ++k) {
    double squared = 0.0;
    for (std::size_t c = 0; c < path.frames[k].positions.size(); ++c)
      squared += std::pow(path.frames[k].positions[c] - path.frames[k - 1].positions[c], 2);
    line += std::sqrt(squared);
  }
  return line > path.length * (1.0 + 1e-12)
             ? fmt::format("the length {} is less than that of a line through the frames", path.length)
             : "";
}

PathResult path_between(double packing_fraction, PathRunOptions options) {
  options.method = &path_method("avoidance");
  options.finder.frames = 20;
  SilentMonitor monitor;
  return run_paths(hard_sphere_binary(), {ends(packing_fraction)}, options, choose_isa("auto"), {}, monitor).front();
}

// The path of collision avoidance by its default potential, for comparison.
const PathResult& faithful_path(double packing_fraction) {
  static std::map<double, PathResult> found;
  const auto old = found.find(packing_fraction);
  return old != found.end() ? old->second : found.emplace(packing_fraction, path_between(packing_fraction, {})).first->second;
}

void slide(benchmark::State& state, double packing_fraction) {
  const PathResult& faithful = faithful_path(packing_fraction);
  PathRunOptions options;
  options.stepping = Stepping::adaptive;
  PathResult path;
  for (auto _ : state) {
    path = path_between(packing_fraction, options);
    state.SetIterationTime(path.seconds);
  }
  std::string wrong = check(path);
  if (wrong.empty() && path.length > faithful.length) wrong = "the path is longer than that of collision avoidance";
  if (!wrong.empty()) return state.SkipWithError(wrong.c_str());
  double rounds = 0.0;
  for (std::size_t k = 0; k < path.corrections.size(); ++k) rounds += static_cast<double>((k + 1) * path.corrections[k]);
  const auto steps = static_cast<double>(path.direct_steps + path.detour_steps);
  state.counters["steps"] = steps;
  state.counters["rounds_per_step"] = rounds / steps;
  state.counters["us_per_step"] = 1e6 * path.seconds / steps;
  state.counters["length"] = path.length;
  state.counters["avoidance_length"] = faithful.length;
  state.counters["avoidance_seconds"] = faithful.seconds;
  state.counters["times_faster"] = faithful.seconds / path.seconds;
  state.SetLabel(to_string(choose_isa("auto")));
}

void find_path(benchmark::State& state, double packing_fraction, kernels::ContactPotential potential) {
  PathRunOptions options;
  options.fictitious = potential;
  PathResult path;
  for (auto _ : state) {
    path = path_between(packing_fraction, options);
    state.SetIterationTime(path.seconds);
  }
  if (const std::string wrong = check(path); !wrong.empty()) return state.SkipWithError(wrong.c_str());
  double trials = 0.0;
  for (std::size_t k = 0; k < path.corrections.size(); ++k) trials += static_cast<double>((k + 1) * path.corrections[k]);
  const auto steps = static_cast<double>(path.direct_steps + path.detour_steps);
  state.counters["steps"] = steps;
  state.counters["trials_per_avoidance"] = trials / static_cast<double>(path.detour_steps);
  state.counters["us_per_step"] = 1e6 * path.seconds / steps;
  state.counters["us_per_evaluation"] = 1e6 * path.seconds / static_cast<double>(path.evaluations);
  state.counters["ratio_squared"] = path.ratio_squared();
  state.SetLabel(to_string(choose_isa("auto")));
}

void register_all() {
  using Potential = kernels::ContactPotential;
  for (const auto& [phi, potential] :
       {std::pair{0.30, Potential::harmonic}, std::pair{0.50, Potential::harmonic}, std::pair{0.50, Potential::cubic},
        std::pair{0.50, Potential::linear}, std::pair{0.57, Potential::harmonic}})
    register_run(fmt::format("hard_path/avoidance/phi:{:.2f}/{}", phi, to_string(potential)),
                 [phi = phi, potential = potential](benchmark::State& state) { find_path(state, phi, potential); });
  for (const double phi : {0.30, 0.50, 0.57})
    register_run(fmt::format("hard_path/slide/phi:{:.2f}", phi), [phi](benchmark::State& state) { slide(state, phi); });
}

}  // namespace
}  // namespace lanescape::bench

int main(int argc, char** argv) {
  lanescape::bench::register_all();
  return lanescape::bench::run_benchmarks(argc, argv);
}
