#include "stepper/adaptive_contour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "memory_archive.hpp"
#include "one_particle.hpp"
#include "path/finder.hpp"
#include "two_sphere_path.hpp"
#include "two_spheres.hpp"

namespace lanescape {
namespace {

using testing::Bowl;
using testing::Hill;
using testing::OneParticle;
using testing::TwoSpheres;
using testing::Way;
using Options = AdaptiveContourStepper::Options;
using Finder = PathFinder<AdaptiveContourStepper>;

Finder on_two_spheres(TwoSpheres& landscape, double degrees, const Options& options = {}) {
  return {landscape.algebra(),
          AdaptiveContourStepper(landscape, -1.0, options),
          landscape.layout().to_slots(testing::two_spheres(3.0, 0.0)),
          landscape.layout().to_slots(testing::two_spheres(3.0, degrees)),
          landscape.particles(),
          {.stepping = Stepping::adaptive}};
}

double length_on_two_spheres(double degrees, const Options& options = {}) {
  TwoSpheres landscape;
  Finder finder = on_two_spheres(landscape, degrees, options);
  finder.advance(100'000);
  EXPECT_EQ(finder.outcome(), Outcome::reached) << finder.reason();
  EXPECT_LE(finder.largest_violation(), 1e-6);
  EXPECT_EQ(finder.distance_left(), 0.0);
  EXPECT_LT(finder.stepper().evaluations(), 3000u);
  return finder.statistics().length();
}

// In 6-D, between spheres of diameter 1 that are 3 apart.
double greedy_length(double degrees) {
  return testing::TwoSpherePath{3.0, 3.0, degrees * std::numbers::pi / 180.0}.greedy_length() / std::numbers::sqrt2;
}

TEST(AdaptiveContourStepper, SlidesAroundASphereByTheGreedyLength) {
  EXPECT_NEAR(greedy_length(170.0), 6.4106 / std::numbers::sqrt2, 1e-4);
  for (const double degrees : {150.0, 160.0, 170.0, 179.0}) {
    const double expected = greedy_length(degrees);
    EXPECT_NEAR(length_on_two_spheres(degrees) / expected, 1.0, 2e-3) << degrees;
  }
}

TEST(AdaptiveContourStepper, ComesCloserToTheGreedyLengthWithASmallerToleranceAndMargin) {
  const double expected = greedy_length(170.0);
  const auto error = [&](const Options& options) { return std::abs(length_on_two_spheres(170.0, options) / expected - 1.0); };
  const double coarse = error({}), fine = error({.tolerance = 2e-4, .margin = 2e-6});
  EXPECT_LT(fine, 0.1 * coarse);
  EXPECT_LT(fine, 3e-5);
}

TEST(AdaptiveContourStepper, GoesStraightToTheGoalWhereThatIsAllowed) {
  Hill landscape;
  Finder finder(landscape.algebra(), AdaptiveContourStepper(landscape, std::exp(-0.5), {}), landscape.array({-3.0, 1.1, 0.0}),
                landscape.array({3.0, 1.1, 0.0}), 1, {});
  finder.advance(1000);
  ASSERT_EQ(finder.outcome(), Outcome::reached);
  EXPECT_EQ(finder.detour_steps(), 0u);
  EXPECT_NEAR(finder.statistics().length(), 6.0, 1e-12);
  EXPECT_LT(finder.direct_steps(), 100u);
  EXPECT_EQ(finder.position(), landscape.array({3.0, 1.1, 0.0}));
}

TEST(AdaptiveContourStepper, FindsTheBoundaryAndStaysAtItsMargin) {
  Hill landscape;
  const double energy = std::exp(-0.5), margin = 1e-3;  // the sphere of radius 1
  AdaptiveContourStepper stepper(landscape, energy, {.margin = margin});
  Point from{-2.0, 0.1, 0.2};
  const Point goal{2.0, 0.1, 0.2};
  AlignedArray next(landscape.dimension(), 0.0);
  int detours = 0;
  for (int k = 0; k < 1000 && from != goal; ++k) {
    const auto kind = stepper.step(Way(landscape, from, goal).at(), next);
    ASSERT_TRUE(kind) << stepper.failure();
    const Point to = landscape.point(next);
    ASSERT_LE(stepper.monitored(), energy);
    ASSERT_EQ(stepper.monitored(), landscape.energy(next));
    for (int part = 1; part < 20; ++part) {
      const double x = part / 20.0;
      const Point between{from[0] + x * (to[0] - from[0]), from[1] + x * (to[1] - from[1]), from[2] + x * (to[2] - from[2])};
      ASSERT_LE(landscape.energy(landscape.array(between)), energy + std::max(0.0, stepper.violation()) + 1e-6);
    }
    if (*kind == StepKind::detour && ++detours > 3) {
      ASSERT_NEAR(OneParticle::norm(to), 1.0 + margin, 0.5 * margin);
    }
    from = to;
    if (OneParticle::norm(difference(goal, from)) < 1e-12) break;
  }
  EXPECT_NEAR(OneParticle::norm(difference(goal, from)), 0.0, 1e-12);
  EXPECT_GT(detours, 5);
}

// V = -(|x| + |y| + |z|), whose gradient jumps where a coordinate changes its sign: V <= -1 is the region outside an octahedron.
class Octahedron final : public OneParticle {
 public:
  double energy(const AlignedArray& position) override {
    const Point at = point(position);
    return -(std::abs(at[0]) + std::abs(at[1]) + std::abs(at[2]));
  }
  double energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) override {
    const Point at = point(position);
    gradient = array({-std::copysign(1.0, at[0]), -std::copysign(1.0, at[1]), -std::copysign(1.0, at[2])});
    return energy(position);
  }

 private:
  double value(double) const override { return 0.0; }
  double slope_over_r(double) const override { return 0.0; }
};

TEST(AdaptiveContourStepper, PassesJumpsOfTheGradient) {
  Octahedron landscape;
  Finder finder(landscape.algebra(), AdaptiveContourStepper(landscape, -1.0, {}), landscape.array({-2.0, 0.1, 0.2}),
                landscape.array({2.0, 0.1, -0.2}), 1, {.stepping = Stepping::adaptive});
  finder.advance(10'000);
  EXPECT_EQ(finder.outcome(), Outcome::reached) << finder.reason();
  EXPECT_GT(finder.detour_length(), 0.5);
  EXPECT_LE(finder.largest_violation(), 1e-6);
}

TEST(AdaptiveContourStepper, ScalesWithTheUnitOfLength) {
  Hill landscape;
  const auto evaluations = [&](double unit) {
    AdaptiveContourStepper stepper(landscape, std::exp(-0.5), {.unit = unit});
    AlignedArray next(landscape.dimension(), 0.0);
    stepper.step(Way(landscape, {-3.0, 0.1, 0.2}, {3.0, 0.1, 0.2}).at(), next);
    return OneParticle::norm(difference(landscape.point(next), Point{-3.0, 0.1, 0.2}));
  };
  EXPECT_NEAR(evaluations(0.01) / evaluations(1.0), 0.01, 1e-12);
}

TEST(AdaptiveContourStepper, SaysWhyThereIsNoStep) {
  AlignedArray next(24, 0.0);
  Bowl bowl;
  AdaptiveContourStepper up(bowl, 0.5, {});
  EXPECT_FALSE(up.step(Way(bowl, {1.0, 0.0, 0.0}, {3.0, 0.0, 0.0}).at(), next));
  EXPECT_EQ(up.failure(), "the direction to the goal is parallel to the gradient");
  testing::Plateau plateau;
  AdaptiveContourStepper flat(plateau, 0.5, {});
  EXPECT_FALSE(flat.step(Way(plateau, {1.0, 0.0, 0.0}, {0.0, 3.0, 0.0}).at(), next));
  EXPECT_EQ(flat.failure(), "the direct step is forbidden and the potential is flat");
}

TEST(AdaptiveContourStepper, EndsStalledWhereTheBoundaryIsNearestToTheGoal) {
  Bowl landscape;
  Finder finder(landscape.algebra(), AdaptiveContourStepper(landscape, 0.5, {}), landscape.array({1.0, 0.0, 0.0}),
                landscape.array({3.0, 3.0, 0.0}), 1, {.stepping = Stepping::adaptive});
  finder.advance(1'000'000);
  EXPECT_EQ(finder.outcome(), Outcome::stalled);
  EXPECT_NEAR(finder.distance_left(), std::sqrt(18.0) - 1.0, 1e-3);
  EXPECT_LE(finder.largest_violation(), 0.0);
  EXPECT_LT(finder.stepper().evaluations(), 20'000u);
}

// V is not a number beyond x = 0.
class Cliff final : public OneParticle {
 public:
  double energy(const AlignedArray& position) override {
    return position[0] > 0.0 ? std::numeric_limits<double>::quiet_NaN() : OneParticle::energy(position);
  }
  double energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) override {
    OneParticle::energy_and_gradient(position, gradient);
    return energy(position);
  }

 private:
  double value(double) const override { return 0.0; }
  double slope_over_r(double) const override { return -1.0; }
};

TEST(AdaptiveContourStepper, NeverAcceptsAPointWhereVIsNotANumber) {
  Cliff landscape;
  Finder finder(landscape.algebra(), AdaptiveContourStepper(landscape, 0.0, {}), landscape.array({-1.0, 0.0, 0.0}),
                landscape.array({1.0, 0.0, 0.0}), 1, {.stepping = Stepping::adaptive});
  finder.advance(100'000);
  EXPECT_EQ(finder.outcome(), Outcome::stalled);
  EXPECT_LE(finder.position()[0], 0.0);
}

TEST(AdaptiveContourStepper, ResumedGoesOnWithTheSameBits) {
  TwoSpheres landscape, other;
  Finder whole = on_two_spheres(landscape, 170.0);
  whole.advance(100'000);
  for (const std::uint64_t stop : {1, 17, 60}) {
    ASSERT_LT(stop, whole.steps());
    Finder begun = on_two_spheres(landscape, 170.0), resumed = on_two_spheres(other, 170.0);
    begun.advance(stop);
    testing::hand_on(begun, resumed);
    resumed.advance(100'000);
    EXPECT_EQ(resumed.statistics().length(), whole.statistics().length());
    EXPECT_EQ(resumed.stepper().evaluations(), whole.stepper().evaluations());
    EXPECT_EQ(resumed.detour_length(), whole.detour_length());
    EXPECT_EQ(resumed.largest_violation(), whole.largest_violation());
    EXPECT_EQ(resumed.stepper().corrections(), whole.stepper().corrections());
  }
}

}  // namespace
}  // namespace lanescape
