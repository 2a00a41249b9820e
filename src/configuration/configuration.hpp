#pragma once

#include <cstddef>
#include <vector>

#include "core/box.hpp"
#include "core/point.hpp"

namespace lanescape {

// Which size of a particle a model needs from a file: radius:R:1 becomes Configuration::radii, diameter:R:1
// Configuration::diameters. A column that is not needed is ignored.
enum class SizeColumn { ignored, radius, diameter };

// Particles in the user's order. Positions may be unwrapped: only separations are periodic.
struct Configuration {
  Box box;
  std::vector<int> species;         // N indices into the model's species
  std::vector<double> positions;    // 3N: x0 y0 z0 x1 ... [sigma]
  std::vector<double> radii{};      // N, hard spheres only, else empty [sigma]
  std::vector<double> diameters{};  // N, polydisperse soft particles only, else empty [sigma]

  std::size_t size() const { return species.size(); }
  Point position(std::size_t i) const { return point_at(positions.data(), i); }
  // Moves each particle into the box.
  void wrap() {
    for (std::size_t k = 0; k < positions.size(); ++k) positions[k] = box.wrapped(k % 3, positions[k]);
  }
};

}  // namespace lanescape
