#include "run/shorten_starts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "run/path_pieces.hpp"
#include "run/shared_progress.hpp"

namespace lanescape {
namespace {

std::vector<PathPieces::Piece> initial_pieces(const ConfigurationPair& pair, const std::vector<Configuration>& nodes) {
  if (nodes.empty()) return {{pair.start.positions, pair.finish.positions}};
  std::vector<PathPieces::Piece> pieces;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
    if (nodes[k].positions != nodes[k + 1].positions) pieces.push_back({nodes[k].positions, nodes[k + 1].positions});
  return pieces;
}

// The starts of one run.
struct Starts {
  const SearchSetup& search;
  const PathResult& initial;
  const ShortenOptions& options;
  const WorkLoop& loop;
  SharedProgress& progress;

  std::unique_ptr<ShortenWork> run(std::size_t number, bool& interrupted) const {
    auto work = options.method->begin({search, initial, options.seed, static_cast<std::uint32_t>(number)});
    PartMonitor monitor(progress, number, 0.0, 1.0);
    interrupted = loop(*work, fmt::format("shorten-{:04}.h5", number + 1), monitor);
    return work;
  }
};

// Takes over the shortest path of the starts that succeeded, or of all where none did.
void keep_shortest(ShortenResult& result, const std::vector<std::unique_ptr<ShortenWork>>& starts) {
  for (const auto& start : starts) {
    result.start_lengths.push_back(start->length());
    result.seconds += start->clock().seconds();
  }
  const auto is_better = [](const auto& a, const auto& b) {
    return std::pair(!a->succeeded(), a->length()) < std::pair(!b->succeeded(), b->length());
  };
  result.shortest = (*std::min_element(starts.begin(), starts.end(), is_better))->result();
}

void shorten(ShortenResult& result, const Starts& starts, std::size_t count, int threads) {
  std::vector<std::unique_ptr<ShortenWork>> works(count);
  std::vector<char> interrupted(count, 0);
  for_each_block(threads, count, [&](std::size_t k) {
    bool stopped = false;
    works[k] = starts.run(k, stopped);
    interrupted[k] = stopped ? 1 : 0;
  });
  const bool all = std::find(interrupted.begin(), interrupted.end(), 1) == interrupted.end();
  keep_shortest(result, works);
  result.outcome = all ? result.shortest.path.outcome : Outcome::interrupted;
  if (all) result.reason = result.shortest.path.reason;
}

}  // namespace

void ShortenOptions::check(const AnyModel& model) const {
  search.check(model);
  check_method(*search.method, model);
  if (starts < 1 || starts > 10'000) throw_bad_input(fmt::format("{} starts are not allowed: from 1 to 10000", starts));
}

ShortenResult shorten_between(const SearchSetup& search, const std::vector<Configuration>& nodes, const ShortenOptions& options,
                              const WorkLoop& loop, RunMonitor& monitor) {
  PathPieces initial(search, initial_pieces(search.pair, nodes), recorded_configurations);
  const bool stopped = loop(initial, "shorten-initial.h5", monitor);
  const PathResult& before = initial.joined();
  ShortenResult result;
  result.outcome = stopped ? Outcome::interrupted : before.outcome;
  result.reason = before.reason;
  result.length_before = before.length;
  result.seconds = initial.clock().seconds();
  result.initial = before.frames;
  if (result.outcome != Outcome::reached) return result;
  SharedProgress progress(monitor, options.method->units, options.starts, 0.0);
  shorten(result, {search, before, options, loop, progress}, options.starts, search.landscape ? 1 : options.search.threads);
  return result;
}

}  // namespace lanescape
