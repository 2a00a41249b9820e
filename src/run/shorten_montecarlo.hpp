#pragma once

#include <memory>

#include "run/shorten_method.hpp"

namespace lanescape {

// The optimisation of [G] 3.1.2.4 and 3.2.2.3: pick one of 1000 configurations R recorded along the path, displace it by Monte
// Carlo moves of single particles to an allowed R', find the paths from R' to both ends, and keep them if they are shorter
// together. Five failures in a row end it. Paths in between are not recorded whole, so there is no certificate.
std::unique_ptr<ShortenWork> begin_montecarlo_shortening(const ShortenSetup& setup);

}  // namespace lanescape
