#include "stepper/escape.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "memory_archive.hpp"
#include "one_particle.hpp"

namespace lanescape {
namespace {

using testing::Bowl;
using testing::Hill;
using testing::OneParticle;
using testing::Way;

TEST(EscapeStepper, GoesStraightWhereItMay) {
  Hill landscape;
  AlignedArray next(landscape.dimension(), 0.0);
  EscapeStepper stepper(landscape, 0.5, {.direct_step = 0.125});
  EXPECT_EQ(stepper.step(Way(landscape, {-4.0, 1.0, 0.0}, {4.0, 1.0, 0.0}).at(), next), StepKind::direct);
  EXPECT_EQ(next, landscape.array({-3.875, 1.0, 0.0}));
  EXPECT_EQ(stepper.monitored(), landscape.energy(next));
}

// In the bowl Newton's descent maps r to (r + 2 E/r)/2, like Heron's method for the square root.
TEST(EscapeStepper, DescendsFromTheForbiddenTrialAsNewtonDoes) {
  Bowl landscape;
  AlignedArray next(landscape.dimension(), 0.0);
  for (const double tolerance : {0.1, 1e-3, 1e-6}) {
    EscapeStepper stepper(landscape, 0.5, {.direct_step = 0.5, .tolerance = tolerance});
    ASSERT_EQ(stepper.step(Way(landscape, {0.9, 0.0, 0.0}, {3.0, 0.0, 0.0}).at(), next), StepKind::detour);
    double r = 1.4;
    std::size_t iterations = 0;
    for (; 0.5 * r * r > 0.5 + tolerance; ++iterations) r = 0.5 * (r + 1.0 / r);
    EXPECT_NEAR(landscape.point(next)[0], r, 1e-14);
    EXPECT_EQ(stepper.corrections()[iterations], 1u) << tolerance;
    EXPECT_LE(stepper.violation(), tolerance);
  }
}

TEST(EscapeStepper, NeverAcceptsMoreThanTheToleranceAboveTheLandscapeEnergy) {
  Hill landscape;
  const double energy = std::exp(-0.5), tolerance = 1e-5;
  EscapeStepper stepper(landscape, energy, {.direct_step = 0.01, .tolerance = tolerance});
  AlignedArray next(landscape.dimension(), 0.0);
  Point at{-2.0, 0.1, 0.2};
  int escapes = 0;
  for (int k = 0; k < 1000 && at[0] < 0.0; ++k) {
    const auto kind = stepper.step(Way(landscape, at, {2.0, 0.1, 0.2}).at(), next);
    ASSERT_TRUE(kind) << stepper.failure();
    ASSERT_LE(landscape.energy(next), energy + tolerance);
    ASSERT_EQ(stepper.violation(), landscape.energy(next) - energy);
    escapes += *kind == StepKind::detour;
    at = landscape.point(next);
  }
  EXPECT_GT(escapes, 50);
  EXPECT_GE(at[0], 0.0);
}

// The number of gradients provided for a descent depends on the length of the previous one.
TEST(EscapeStepper, HandedOnToAnotherItGoesOnWithTheSameEvaluations) {
  Bowl landscape;
  const EscapeStepper::Options options{.direct_step = 0.5, .tolerance = 1e-6};
  EscapeStepper whole(landscape, 0.5, options), resumed(landscape, 0.5, options);
  AlignedArray next(landscape.dimension(), 0.0), other(next);
  const Way way(landscape, {0.9, 0.0, 0.0}, {3.0, 0.0, 0.0});
  ASSERT_TRUE(whole.step(way.at(), next));
  testing::MemoryArchive archive;
  whole.exchange(archive, way.position);
  archive.rewind();
  resumed.exchange(archive, way.position);
  EXPECT_EQ(resumed.monitored(), whole.monitored());
  ASSERT_EQ(resumed.step(way.at(), other), whole.step(way.at(), next));
  EXPECT_EQ(other, next);
  EXPECT_EQ(resumed.evaluations(), whole.evaluations());
  EXPECT_EQ(resumed.corrections(), whole.corrections());
}

TEST(EscapeStepper, SaysWhyThereIsNoStep) {
  AlignedArray next(24, 0.0);
  testing::Plateau plateau;
  EscapeStepper flat(plateau, 0.5, {});
  EXPECT_FALSE(flat.step(Way(plateau, {1.0, 0.0, 0.0}, {0.0, 3.0, 0.0}).at(), next));
  EXPECT_EQ(flat.failure(), "the trial is forbidden and the potential is flat");
  Bowl bowl;
  EscapeStepper below(bowl, -1.0, {.max_iterations = 7});  // below the minimum of V
  EXPECT_FALSE(below.step(Way(bowl, {1.0, 0.0, 0.0}, {0.0, 3.0, 0.0}).at(), next));
  EXPECT_EQ(below.failure(), "no allowed point after 7 iterations of the descent");
}

}  // namespace
}  // namespace lanescape
