// A whole path of Kob-Andersen's mixture, N = 108, T = 1, DeltaR = 108, with [C]'s own step lengths, to compare with the seconds in
// [C] table 1. The instruction set is the best available one, or LANESCAPE_ISA.

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "bench_support.hpp"
#include "io/extended_xyz.hpp"
#include "run/path_run.hpp"
#include "stepper/escape.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape::bench {
namespace {

ConfigurationPair read_pair(const PairModel& model) {
  const auto frames = read_frames(LANESCAPE_BENCH_DATA_DIR "/ka108-T1-pair.extxyz", model);
  return {frames.front().configuration, frames.back().configuration};
}

double polyline_length(const std::vector<Configuration>& frames) {
  double length = 0.0;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    double squared = 0.0;
    for (std::size_t c = 0; c < frames[k].positions.size(); ++c)
      squared += std::pow(frames[k].positions[c] - frames[k - 1].positions[c], 2);
    length += std::sqrt(squared);
  }
  return length;
}

// Checks a path by the scalar reference and by geometry; returns the first error, or an empty string.
std::string check(const PathResult& path, const PairModel& model, const PathMethod& method) {
  if (path.outcome != Outcome::reached) return fmt::format("{}: {}", to_string(path.outcome), path.reason);
  const double allowed = method.word == std::string("escape") ? EscapeStepper::Options{}.tolerance : 0.0;
  if (path.largest_violation > allowed) return fmt::format("V exceeds E_L by {}", path.largest_violation);
  for (const Configuration& frame : path.frames) {
    const reference::Evaluation expected = evaluate_reference(model, frame);
    const double excess = expected.energy - path.landscape_energy - allowed;
    if (!(excess <= 1e-12 * expected.magnitude))
      return fmt::format("a frame lies {} above what is allowed, by the reference", excess);
  }
  if (polyline_length(path.frames) > path.length * (1.0 + 1e-12))
    return fmt::format("the length {} is less than that of a line through the frames", path.length);
  return "";
}

void find_path(benchmark::State& state, const PathMethod& method, Stepping stepping, ImageRule images) {
  const PairModel model = kob_andersen_with(images);
  const ConfigurationPair pair = read_pair(model);
  PathRunOptions options;
  options.method = &method;
  options.stepping = stepping;
  options.finder.frames = 20;
  SilentMonitor monitor;
  PathResult path;
  for (auto _ : state) {
    path = run_paths(model, {pair}, options, choose_isa("auto"), {}, monitor).front();
    state.SetIterationTime(path.seconds);
  }
  if (const std::string wrong = check(path, model, method); !wrong.empty()) return state.SkipWithError(wrong.c_str());
  const auto steps = static_cast<double>(path.direct_steps + path.detour_steps);
  state.counters["steps"] = steps;
  state.counters["evaluations"] = static_cast<double>(path.evaluations);
  state.counters["us_per_step"] = 1e6 * path.seconds / steps;
  state.counters["us_per_evaluation"] = 1e6 * path.seconds / static_cast<double>(path.evaluations);
  state.counters["ratio_squared"] = path.ratio_squared();
  state.SetLabel(to_string(choose_isa("auto")));
}

void register_all() {
  for (const PathMethod& method : path_methods())
    for (const ImageRule images : {ImageRule::minimum, ImageRule::all})
      for (const Stepping stepping : {Stepping::faithful, Stepping::adaptive}) {
        if (method.is_hard || (stepping == Stepping::adaptive && method.begin_adaptive == nullptr)) continue;
        register_run(fmt::format("path/{}{}/{}", method.word, stepping == Stepping::adaptive ? "-adaptive" : "", to_string(images)),
                     [&method, stepping, images](benchmark::State& state) { find_path(state, method, stepping, images); });
      }
}

}  // namespace
}  // namespace lanescape::bench

int main(int argc, char** argv) {
  lanescape::bench::register_all();
  return lanescape::bench::run_benchmarks(argc, argv);
}
