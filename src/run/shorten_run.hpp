#pragma once

#include <vector>

#include "run/run_loop.hpp"
#include "run/shorten_starts.hpp"

namespace lanescape {

// Shortens the path through `nodes` (check_given_path()) or, where there are none, the path that the path method finds between the
// ends. The landscape energy is that of the pair throughout. The result depends neither on the number of threads nor on
// interruption and resumption. Throws Error(bad_input) for what run_paths() refuses.
ShortenResult run_shorten(const AnyModel& model, const ConfigurationPair& pair, const std::vector<Configuration>& nodes,
                          const ShortenOptions& options, Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor);

}  // namespace lanescape
