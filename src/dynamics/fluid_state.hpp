#pragma once

#include <vector>

#include "configuration/configuration.hpp"
#include "core/archive.hpp"
#include "core/point.hpp"

namespace lanescape {

// Positions and velocities in the user's order. The state of a fluid between two runs of molecular dynamics, while its number of
// particles may change.
struct FluidState {
  Configuration configuration;
  std::vector<double> velocities;  // 3N [sigma / time]

  void add(int species, const Point& position, const Point& velocity);
  // Archives box, species, positions and velocities.
  void exchange(Archive& archive);
};

}  // namespace lanescape
