#pragma once

#include <memory>

#include "run/shorten_method.hpp"

namespace lanescape {

// Constrained curve shortening (PHYSICS 4) until the path is stationary. Starts 0, 1, 2, ... begin with the initial path, the path
// found from R_f to R_i, and paths through neighbours of a configuration picked at random from the initial path; where
// such a path is not found, with the initial one. The residual and the violation are those of check_path() for the nodes.
std::unique_ptr<ShortenWork> begin_curve_shortening(const ShortenSetup& setup);

}  // namespace lanescape
