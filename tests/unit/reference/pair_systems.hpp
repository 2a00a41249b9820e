#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "pair_cases.hpp"
#include "reference/pair_sum.hpp"

/// Systems of particles for tests of sums over pairs.
namespace lanescape::reference {

struct System {
  std::vector<double> positions;
  std::vector<int> species;
  Vector box;
  std::vector<double> diameters = {};

  Particles particles() const { return {positions, species, box, diameters}; }
};

inline System two_particles(double r, Vector box = {20.0, 20.0, 20.0}) { return {{0.0, 0.0, 0.0, r, 0.0, 0.0}, {0, 0}, box}; }

/// nx x ny x nz cells of a face-centred lattice, every coordinate displaced by at most `rattle`; each fifth particle
/// is B where there are two species.
inline System rattled_fcc(Vector cells, double constant, double rattle, std::size_t species_count, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return 2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0; };
  System system;
  for (std::size_t axis = 0; axis < 3; ++axis) system.box[axis] = cells[axis] * constant;
  const std::array<Vector, 4> basis{{{0.0, 0.0, 0.0}, {0.0, 0.5, 0.5}, {0.5, 0.0, 0.5}, {0.5, 0.5, 0.0}}};
  for (int x = 0; x < cells[0]; ++x)
    for (int y = 0; y < cells[1]; ++y)
      for (int z = 0; z < cells[2]; ++z)
        for (const Vector& site : basis) {
          const Vector corner{double(x), double(y), double(z)};
          for (std::size_t axis = 0; axis < 3; ++axis)
            system.positions.push_back(constant * (corner[axis] + site[axis]) + rattle * uniform());
          system.species.push_back(species_count == 2 && system.species.size() % 5 == 4 ? 1 : 0);
        }
  return system;
}

/// The same with box and positions stretched by 1 + strain along one axis.
inline System stretched(System system, std::size_t axis, double strain) {
  system.box[axis] *= 1.0 + strain;
  for (std::size_t k = axis; k < system.positions.size(); k += 3) system.positions[k] *= 1.0 + strain;
  return system;
}

inline double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

/// Equal up to rounding.
inline void expect_same(const Evaluation& a, const Evaluation& b) {
  EXPECT_NEAR(a.energy, b.energy, 1e-13 * a.magnitude);
  EXPECT_NEAR(a.virial, b.virial, 1e-13 * a.virial_magnitude);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(a.virial_tensor[k], b.virial_tensor[k], 1e-13 * a.virial_magnitude) << k;
  ASSERT_EQ(a.gradient.size(), b.gradient.size());
  const double scale = largest(a.gradient_magnitude);
  for (std::size_t k = 0; k < a.gradient.size(); ++k) EXPECT_NEAR(a.gradient[k], b.gradient[k], 1e-13 * scale) << k;
}

}  // namespace lanescape::reference
