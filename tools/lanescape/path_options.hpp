#pragma once

#include <optional>
#include <string>

#include "program.hpp"
#include "run/path_run.hpp"

namespace lanescape::program {

// How paths are found, for `path` and `shorten`.
class PathOptions {
 public:
  // `method_option` is the option that names the path method.
  void add_to(Options& options, const std::string& method_option);
  // `frames` [100] is added apart: subcommands count different configurations.
  PathRunOptions run_options(const AnyModel& model, int threads, Precision precision) const;
  // What the method and its steps make of the run.
  RunKinds kinds(const PathRunOptions& options) const;
  // Checks the options, and fills in those that were not given, so that the resolved run file has them.
  void settle(const PathRunOptions& options, const AnyModel& model);

  std::uint64_t frames = FinderOptions{}.frames;

 private:
  std::optional<std::string> method_, fictitious_;
  bool adaptive_ = false;
  std::optional<double> step_, avoidance_step_, landscape_energy_, escape_tolerance_;
  std::optional<std::uint64_t> max_trials_, max_depth_;
  std::uint64_t max_steps_ = FinderOptions{}.max_steps, patience_ = FinderOptions{}.patience;
};

}  // namespace lanescape::program
