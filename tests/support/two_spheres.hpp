#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "dispatch/isa.hpp"
#include "landscape/soft_landscape.hpp"

namespace lanescape::testing {

// V = -|r_1 - r_2| of two particles: V <= -s is the region outside a hard sphere of diameter s.
class TwoSpheres final : public SoftLandscape {
 public:
  TwoSpheres() : layout_({0, 0}, 1), algebra_(kernel_table(choose_isa("auto"))) {}
  const ParticleLayout& layout() const { return layout_; }
  std::size_t dimension() const override { return layout_.dimension(); }
  std::size_t particles() const override { return 2; }
  const VectorAlgebra& algebra() const override { return algebra_; }
  double energy(const AlignedArray& r) override { return -std::sqrt(squared(separation(r))); }
  double energy_and_gradient(const AlignedArray& r, AlignedArray& gradient) override {
    const auto d = separation(r);
    const double length = std::sqrt(squared(d));
    std::fill(gradient.begin(), gradient.end(), 0.0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      gradient[axis * layout_.slots()] = -d[axis] / length;
      gradient[axis * layout_.slots() + 1] = d[axis] / length;
    }
    return -length;
  }

 private:
  std::array<double, 3> separation(const AlignedArray& r) const {
    std::array<double, 3> d{};
    for (std::size_t axis = 0; axis < 3; ++axis) d[axis] = r[axis * layout_.slots()] - r[axis * layout_.slots() + 1];
    return d;
  }
  static double squared(const std::array<double, 3>& d) { return d[0] * d[0] + d[1] * d[1] + d[2] * d[2]; }

  ParticleLayout layout_;
  VectorAlgebra algebra_;
};

// Interleaved: two spheres with a resting centre of mass, `r` apart, at an angle in a tilted plane.
inline std::vector<double> two_spheres(double r, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  const double x = 0.5 * r * std::cos(angle), y = 0.3 * r * std::sin(angle), z = 0.4 * r * std::sin(angle);
  return {x, y, z, -x, -y, -z};
}

}  // namespace lanescape::testing
