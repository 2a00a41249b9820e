#include "run/path_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <utility>

#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "core/parallel.hpp"
#include "run/path_search.hpp"
#include "run/shared_progress.hpp"

namespace lanescape {
namespace {

// The searches of one run.
struct Searches {
  const AnyModel& model;
  const std::vector<ConfigurationPair>& pairs;
  const std::vector<PreparedPair>& prepared;
  const PathRunOptions& options;
  Isa isa;
  const CheckpointOptions& checkpoint;
  SharedProgress& progress;
  const LandscapeOfPair& landscape;

  SoftLandscapeMaker landscape_of(std::size_t number) const {
    if (!landscape) return {};
    return [this, number] { return landscape(pairs[number], prepared[number].layout); };
  }

  PathResult one_way(std::size_t number, bool reversed) const {
    // One level of threads: many paths at once, or the evaluations of one.
    const int threads = pairs.size() == 1 ? options.threads : 1;
    const auto search = begin_path({model, pairs[number], prepared[number], options, isa, threads, reversed, landscape_of(number)});
    PartMonitor monitor(progress, number, reversed ? 0.5 : 0.0, options.reverse ? 0.5 : 1.0);
    run_to_end(*search, fmt::format("path-{:04}{}.h5", number + 1, reversed ? "-reverse" : ""), checkpoint, monitor);
    return search->result();
  }

  PathResult pair(std::size_t number) const {
    PathResult forward = one_way(number, false);
    if (!options.reverse || forward.outcome == Outcome::interrupted) return forward;
    return shorter_way(std::move(forward), one_way(number, true));
  }
};

PreparedPair prepare(const AnyModel& model, const ConfigurationPair& pair, const std::string& where, const PathRunOptions& options,
                     Isa isa, const LandscapeOfPair& landscape) {
  if (!landscape) return prepare_pair(model, pair, where, options, isa);
  check_end_points(pair, model, where);
  const Mixture& mixture = mixture_of(model);
  const ParticleLayout layout = ParticleLayout::in_space_order(pair.start, mixture.species.size());
  return prepare_pair_on([&] { return landscape(pair, layout); }, mixture, layout, pair, where, options, isa);
}

}  // namespace

std::vector<PathResult> run_paths(const AnyModel& model, const std::vector<ConfigurationPair>& pairs, const PathRunOptions& options,
                                  Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor,
                                  const LandscapeOfPair& landscape) {
  options.check(model);
  if (pairs.empty()) throw_bad_input("no pair of end points was given");
  check_method(*options.method, model);

  std::vector<PreparedPair> prepared;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    prepared.push_back(prepare(model, pairs[k], fmt::format("pair {}", k + 1), options, isa, landscape));
  SharedProgress progress(monitor, "paths", pairs.size(), static_cast<double>(pairs.size()));
  const Searches searches{model, pairs, prepared, options, isa, checkpoint, progress, landscape};
  std::vector<PathResult> results(pairs.size());
  std::vector<std::exception_ptr> failures(pairs.size());
  for_each_block(landscape ? 1 : options.threads, pairs.size(), [&](std::size_t k) {
    try {
      results[k] = searches.pair(k);
    } catch (...) {
      failures[k] = std::current_exception();
    }
  });
  for (const auto& failure : failures)
    if (failure) std::rethrow_exception(failure);
  return results;
}

}  // namespace lanescape
