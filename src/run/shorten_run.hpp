#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "run/path_run.hpp"
#include "run/shorten_method.hpp"

namespace lanescape {

struct ShortenOptions {
  const ShortenMethod* method = &default_shorten_method();
  PathRunOptions search;     // how paths between two points are found; its threads are those of the whole run
  std::uint64_t starts = 1;  // independent runs, of which the shortest path is kept
  std::uint64_t seed = 1;

  // Throws Error(bad_input) naming the option that is out of range.
  void check(const AnyModel& model) const;
};

struct ShortenResult {
  // `reached` if the method ended by its own rule; else what ended the search for the first path, or an interruption.
  Outcome outcome = Outcome::running;
  std::string reason;
  double length_before = 0.0;          // of the path that was shortened [sigma]
  std::vector<Configuration> initial;  // recorded along that path, ends included; about 1000
  ShortenedPath shortest;
  std::vector<double> start_lengths;  // of each start [sigma]
  double seconds = 0.0;               // of all starts and of the first path
};

// Shortens the path through `nodes` (check_given_path()) or, where there are none, the path that the path method finds between the
// ends. The landscape energy is that of the pair throughout. The result depends neither on the number of threads nor on
// interruption and resumption. Throws Error(bad_input) for what run_paths() refuses.
ShortenResult run_shorten(const AnyModel& model, const ConfigurationPair& pair, const std::vector<Configuration>& nodes,
                          const ShortenOptions& options, Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor);

}  // namespace lanescape
