#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/box.hpp"

namespace lanescape {

// Particles in the user's order. Positions may be unwrapped: only separations are periodic.
struct Configuration {
  Box box;
  std::vector<int> species;       // N indices into the model's species
  std::vector<double> positions;  // 3N: x0 y0 z0 x1 ... [sigma]
  std::vector<double> radii{};    // N, hard spheres only, else empty [sigma]

  std::size_t size() const { return species.size(); }
  std::array<double, 3> position(std::size_t i) const { return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]}; }
  // Every particle into the box.
  void wrap() {
    for (std::size_t k = 0; k < positions.size(); ++k) positions[k] = box.wrapped(k % 3, positions[k]);
  }
};

}  // namespace lanescape
