#include "stepper/contour.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "one_particle.hpp"

namespace lanescape {
namespace {

using testing::Bowl;
using testing::Hill;
using testing::OneParticle;
using testing::Way;

// A walk of `steps` accepted steps; calls `look` for each.
template <class Look>
Point walk(OneParticle& landscape, ContourStepper& stepper, Point from, const Point& goal, int steps, Look look) {
  AlignedArray next(landscape.dimension(), 0.0);
  for (int k = 0; k < steps; ++k) {
    const auto kind = stepper.step(Way(landscape, from, goal).at(), next);
    EXPECT_TRUE(kind) << stepper.failure();
    if (!kind) break;
    const Point to = landscape.point(next);
    look(*kind, from, to);
    from = to;
  }
  return from;
}

double length(const Point& from, const Point& to) { return OneParticle::norm(difference(to, from)); }

TEST(ContourStepper, GoesStraightWhereItMay) {
  Hill landscape;
  ContourStepper stepper(landscape, 0.5, {.direct_step = 0.125});
  const Point end = walk(landscape, stepper, {-4.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, 20,
                         [](StepKind kind, const Point&, const Point&) { EXPECT_EQ(kind, StepKind::direct); });
  EXPECT_EQ(end, (Point{-1.5, 0.0, 0.0}));
  EXPECT_EQ(stepper.evaluations(), 20u);
  EXPECT_EQ(stepper.monitored(), std::exp(-1.125));
  EXPECT_EQ(stepper.violation(), std::exp(-1.125) - 0.5);
}

TEST(ContourStepper, GoesAroundAHillByStepsOfTheStatedLengthAndNeverAboveTheLandscapeEnergy) {
  Hill landscape;
  const double energy = std::exp(-0.5);  // the sphere of radius 1
  ContourStepper stepper(landscape, energy, {.direct_step = 0.01});
  int detours = 0;
  const Point end =
      walk(landscape, stepper, {-2.0, 0.1, 0.2}, {2.0, 0.1, 0.2}, 200, [&](StepKind kind, const Point& from, const Point& to) {
        ASSERT_LE(landscape.energy(landscape.array(to)), energy);
        // Tangents lead outside the sphere, so no step needs a correction.
        ASSERT_NEAR(length(from, to), 0.01, 1e-13);
        if (kind == StepKind::direct) return;
        ++detours;
        ASSERT_NEAR(dot(from, difference(to, from)), 0.0, 1e-13);  // along the contour
        ASSERT_LT(OneParticle::norm(to), 1.03);
      });
  EXPECT_GT(detours, 50);
  EXPECT_EQ(stepper.corrections()[0], static_cast<std::uint64_t>(detours));
  EXPECT_GT(end[0], -0.5);
}

TEST(ContourStepper, StaysInABowlWithinOneCorrectionOfTheContour) {
  Bowl landscape;
  const double energy = 0.5, step = 0.01, correction = 1e-6;
  ContourStepper stepper(landscape, energy, {.direct_step = step, .correction = correction});
  const Point goal{3.0, 3.0, 0.0};  // outside: the path follows the boundary
  walk(landscape, stepper, {1.0, 0.0, 0.0}, goal, 50, [&](StepKind kind, const Point& from, const Point& to) {
    ASSERT_EQ(kind, StepKind::detour);
    const double v = landscape.energy(landscape.array(to));
    ASSERT_LE(v, energy);
    ASSERT_GT(v, energy - 1.001 * correction * OneParticle::norm(from));  // slope: r
    ASSERT_EQ(v, stepper.monitored());
    // A tangent of length s ends s^2/2 outside the sphere of radius 1; the correction back adds almost nothing.
    ASSERT_NEAR(length(from, to), step, 1.2 * std::pow(0.5 * step * step, 2) / (2.0 * step));
    ASSERT_LT(length(to, goal), length(from, goal));
  });
  EXPECT_EQ(stepper.corrections().back(), 50u);  // about 50 corrections each, more than there are bins
}

TEST(ContourStepper, SaysWhyThereIsNoStep) {
  AlignedArray next(24, 0.0);
  Bowl bowl;
  ContourStepper up(bowl, 0.5, {.direct_step = 0.01});
  EXPECT_FALSE(up.step(Way(bowl, {1.0, 0.0, 0.0}, {3.0, 0.0, 0.0}).at(), next));
  EXPECT_EQ(up.failure(), "the direction to the goal is parallel to the gradient");
  ContourStepper few(bowl, 0.5, {.direct_step = 0.01, .correction = 1e-5, .max_corrections = 4});
  EXPECT_FALSE(few.step(Way(bowl, {1.0, 0.0, 0.0}, {3.0, 3.0, 0.0}).at(), next));
  EXPECT_EQ(few.failure(), "no allowed point after 4 corrections of 1e-05 along the gradient");
  testing::Plateau plateau;
  ContourStepper flat(plateau, 0.5, {});
  EXPECT_FALSE(flat.step(Way(plateau, {1.0, 0.0, 0.0}, {0.0, 3.0, 0.0}).at(), next));
  EXPECT_EQ(flat.failure(), "the direct step is forbidden and the potential is flat");
}

}  // namespace
}  // namespace lanescape
