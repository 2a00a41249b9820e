#pragma once

#include <cstdint>

#include "run/slab_run.hpp"

namespace lanescape::testing {

inline SlabOptions small_slab(std::uint64_t equilibration_steps, std::uint64_t sampling_steps) {
  SlabOptions options;
  options.particles = 512;
  options.width = 8.0;
  options.length = 24.0;
  options.equilibration_steps = equilibration_steps;
  options.sampling_steps = sampling_steps;
  options.bins = 24;
  return options;
}

}  // namespace lanescape::testing
