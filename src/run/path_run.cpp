#include "run/path_run.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <exception>
#include <utility>

#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "run/path_search.hpp"

namespace lanescape {
namespace {

// The progress of all paths together, from that of each.
class SharedProgress {
 public:
  SharedProgress(RunMonitor& monitor, std::size_t paths) : monitor_(&monitor), covered_(paths) {}

  void report(std::size_t path, double part) {
    covered_[path] = part;
    double sum = 0.0;
    for (const auto& c : covered_) sum += c;
    monitor_->progress("paths", sum, static_cast<double>(covered_.size()));
  }
  bool stop_requested() const { return monitor_->stop_requested(); }

 private:
  RunMonitor* monitor_;
  std::vector<std::atomic<double>> covered_;  // of the way, 0 ... 1 per path
};

// What one search reports: a share of one path, from `offset` on.
class SearchMonitor final : public RunMonitor {
 public:
  SearchMonitor(SharedProgress& progress, std::size_t path, double offset, double share)
      : progress_(&progress), path_(path), offset_(offset), share_(share) {}
  void progress(std::string_view, double done, double) override { progress_->report(path_, offset_ + share_ * done); }
  bool stop_requested() const override { return progress_->stop_requested(); }

 private:
  SharedProgress* progress_;
  std::size_t path_;
  double offset_, share_;
};

// The searches of one run.
struct Searches {
  const AnyModel& model;
  const std::vector<ConfigurationPair>& pairs;
  const std::vector<PreparedPair>& prepared;
  const PathRunOptions& options;
  Isa isa;
  const CheckpointOptions& checkpoint;
  SharedProgress& progress;

  PathResult one_way(std::size_t number, bool reversed) const {
    // One level of threads: many paths at once, or the evaluations of one.
    const int threads = pairs.size() == 1 ? options.threads : 1;
    const auto search = begin_path({model, pairs[number], prepared[number], options, isa, threads, reversed, {}});
    SearchMonitor monitor(progress, number, reversed ? 0.5 : 0.0, options.reverse ? 0.5 : 1.0);
    run_to_end(*search, fmt::format("path-{:04}{}.h5", number + 1, reversed ? "-reverse" : ""), checkpoint, monitor);
    return search->result();
  }

  PathResult pair(std::size_t number) const {
    PathResult forward = one_way(number, false);
    if (!options.reverse || forward.outcome == Outcome::interrupted) return forward;
    return shorter_way(std::move(forward), one_way(number, true));
  }
};

}  // namespace

std::vector<PathResult> run_paths(const AnyModel& model, const std::vector<ConfigurationPair>& pairs, const PathRunOptions& options,
                                  Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  options.check(model);
  if (pairs.empty()) throw_bad_input("no pair of end points was given");
  check_method(*options.method, model);

  std::vector<PreparedPair> prepared;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    prepared.push_back(prepare_pair(model, pairs[k], fmt::format("pair {}", k + 1), options, isa));
  SharedProgress progress(monitor, pairs.size());
  const Searches searches{model, pairs, prepared, options, isa, checkpoint, progress};
  std::vector<PathResult> results(pairs.size());
  std::vector<std::exception_ptr> failures(pairs.size());
  const int threads = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(std::max(1, options.threads)), pairs.size()));
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) if (threads > 1)
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    try {
      results[k] = searches.pair(k);
    } catch (...) {
      failures[k] = std::current_exception();
    }
  }
  for (const auto& failure : failures)
    if (failure) std::rethrow_exception(failure);
  return results;
}

}  // namespace lanescape
