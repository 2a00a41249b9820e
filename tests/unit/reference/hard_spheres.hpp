#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "reference/hard_sphere.hpp"

/// Systems for tests of hard spheres.
namespace lanescape::reference {

using Point = std::vector<double>;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Vector kBox{10.0, 12.0, 14.0};
inline constexpr std::array kPotentials{FictitiousPotential::harmonic, FictitiousPotential::linear, FictitiousPotential::cubic};

/// n spheres of two sizes at random positions, inside and outside the box; many overlap.
struct Crowd {
  Point positions;
  std::vector<double> radii;
};
inline Crowd crowd(std::size_t n, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> coordinate(-20.0, 20.0);
  Crowd result;
  for (std::size_t k = 0; k < 3 * n; ++k) result.positions.push_back(coordinate(engine));
  for (std::size_t j = 0; j < n; ++j) result.radii.push_back(j % 2 == 0 ? 0.5 : 0.7);
  return result;
}

}  // namespace lanescape::reference
