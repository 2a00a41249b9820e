#include "run/shorten_run.hpp"

namespace lanescape {

ShortenResult run_shorten(const AnyModel& model, const ConfigurationPair& pair, const std::vector<Configuration>& nodes,
                          const ShortenOptions& options, Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  options.check(model);
  const PreparedPair prepared = prepare_pair(model, pair, "the pair", options.search, isa);
  const SearchSetup search{model, pair, prepared, options.search, isa, options.threads_of_one_start(), false, {}};
  const auto loop = [&](ResumableWork& work, const std::string& file, RunMonitor& reported) {
    return run_to_end(work, file, checkpoint, reported);
  };
  return shorten_between(search, nodes, options, loop, monitor);
}

}  // namespace lanescape
