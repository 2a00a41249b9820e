#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "configuration/particle_layout.hpp"
#include "core/point.hpp"
#include "dispatch/isa.hpp"
#include "landscape/soft_landscape.hpp"
#include "stepper/direct.hpp"

namespace lanescape::testing {

// V depends on one particle's distance r from the origin, so paths can be computed by hand.
class OneParticle : public SoftLandscape {
 public:
  OneParticle() : layout_({0}, 1), algebra_(kernel_table(choose_isa("auto"))) {}
  std::size_t dimension() const override { return layout_.dimension(); }
  std::size_t particles() const override { return 1; }
  const VectorAlgebra& algebra() const override { return algebra_; }
  double energy(const AlignedArray& position) override { return value(norm(point(position))); }
  double energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) override {
    const Point at = point(position);
    std::fill(gradient.begin(), gradient.end(), 0.0);
    for (std::size_t axis = 0; axis < 3; ++axis) gradient[axis * layout_.slots()] = slope_over_r(norm(at)) * at[axis];
    return value(norm(at));
  }

  AlignedArray array(const Point& at) const { return layout_.to_slots(at); }
  Point point(const AlignedArray& array) const { return {array[0], array[layout_.slots()], array[2 * layout_.slots()]}; }
  static double norm(const Point& a) { return std::sqrt(dot(a, a)); }

 private:
  virtual double value(double r) const = 0;
  virtual double slope_over_r(double r) const = 0;  // V'(r)/r

  ParticleLayout layout_;
  VectorAlgebra algebra_;
};

// V = r^2/2: V <= E is the region inside a sphere of radius sqrt(2 E).
class Bowl final : public OneParticle {
  double value(double r) const override { return 0.5 * r * r; }
  double slope_over_r(double) const override { return 1.0; }
};

// V = exp(-r^2/2): V <= E is the region outside a sphere of radius sqrt(-2 ln E).
class Hill final : public OneParticle {
  double value(double r) const override { return std::exp(-0.5 * r * r); }
  double slope_over_r(double r) const override { return -std::exp(-0.5 * r * r); }
};

// V = 1 everywhere.
class Plateau final : public OneParticle {
  double value(double) const override { return 1.0; }
  double slope_over_r(double) const override { return 0.0; }
};

// The input of a stepper for the path from one point to another.
struct Way {
  AlignedArray position, to_goal;
  double distance;

  Way(const OneParticle& landscape, const Point& from, const Point& to)
      : position(landscape.array(from)),
        to_goal(landscape.array(difference(to, from))),
        distance(OneParticle::norm(difference(to, from))) {}
  PathPoint at() const { return {position, to_goal, distance}; }
};

}  // namespace lanescape::testing
