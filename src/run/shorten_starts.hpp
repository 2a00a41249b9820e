#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "run/path_run.hpp"
#include "run/path_search.hpp"
#include "run/shorten_method.hpp"

namespace lanescape {

struct ShortenOptions {
  const ShortenMethod* method = &default_shorten_method();
  PathRunOptions search;     // how paths between two points are found; its threads are those of the whole run
  std::uint64_t starts = 1;  // independent runs, of which the shortest path is kept
  std::uint64_t seed = 1;

  // Throws Error(bad_input) naming the option that is out of range.
  void check(const AnyModel& model) const;
  // One level of threads: many starts at once, or the evaluations of one.
  int threads_of_one_start() const { return starts == 1 ? search.threads : 1; }
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

// Does work until it is finished or the monitor asks to stop: true if it was interrupted. `name` is that of its checkpoint.
using WorkLoop = std::function<bool(ResumableWork& work, const std::string& name, RunMonitor& monitor)>;

// Shortens the path through `nodes` (run/given_path.hpp) or, where there are none, the path that the path method finds between the
// ends, with options that were checked. `search` has the options' search and threads_of_one_start(). Starts on a landscape in place
// of the model's follow each other on the calling thread: it is one object.
ShortenResult shorten_between(const SearchSetup& search, const std::vector<Configuration>& nodes, const ShortenOptions& options,
                              const WorkLoop& loop, RunMonitor& monitor);

}  // namespace lanescape
