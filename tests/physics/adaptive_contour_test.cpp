#include "stepper/adaptive_contour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "landscape/kinematic_landscape.hpp"
#include "path/finder.hpp"
#include "stepper/contour.hpp"
#include "systems.hpp"

namespace lanescape {
namespace {

using testing::System;

// The committed pair of Kob and Andersen's mixture at T = 1, DeltaR = 108.
struct Pair {
  System system;
  AlignedArray start, goal;
  double limit;

  explicit Pair(ImageRule images) : system(with(images), frames()[0].configuration) {
    start = system.start();
    goal = system.layout.to_slots(frames()[1].configuration.positions);
    limit = std::max(system.landscape.energy(start), system.landscape.energy(goal));
  }
  static PairModel with(ImageRule images) {
    PairModel model = kob_andersen();
    model.images = images;
    return model;
  }
  static std::vector<Frame> frames() {
    return read_frames(std::string(LANESCAPE_TEST_DATA_DIR) + "/ka108-T1-pair.extxyz", kob_andersen());
  }
};

class AdaptiveContourWith : public ::testing::TestWithParam<ImageRule> {};
INSTANTIATE_TEST_SUITE_P(EveryImageRule, AdaptiveContourWith, ::testing::Values(ImageRule::all, ImageRule::minimum),
                         [](const auto& tested) { return std::string(to_string(tested.param)); });

// Follows the path to its end and samples V densely on each of its segments.
TEST_P(AdaptiveContourWith, StaysAllowedAlongEverySegment) {
  Pair pair(GetParam());
  Pair other(GetParam());  // its evaluations do not touch the state of the path's own
  const VectorAlgebra& algebra = pair.system.landscape.algebra();
  PathFinder<AdaptiveContourStepper> finder(algebra, AdaptiveContourStepper(pair.system.landscape, pair.limit, {}), pair.start,
                                            pair.goal, 108, {.stepping = Stepping::adaptive});
  AlignedArray from = pair.start, chord(from.size(), 0.0), between(from.size(), 0.0);
  double highest = -HUGE_VAL;
  constexpr int samples = 12;
  while (finder.outcome() == Outcome::running) {
    finder.advance(1);
    algebra.difference(chord, finder.position(), from);
    for (int k = 1; k <= samples; ++k) {
      algebra.axpy(between, from, static_cast<double>(k) / samples, chord);
      highest = std::max(highest, other.system.landscape.energy(between) - pair.limit);
    }
    from = finder.position();
  }
  ASSERT_EQ(finder.outcome(), Outcome::reached) << finder.reason();
  EXPECT_LE(highest, 1e-3);
  EXPECT_LE(finder.largest_violation(), 1e-3);
  EXPECT_LT(finder.stepper().evaluations(), 12'000u);
}

// Unequal masses: in kinematic coordinates the same method finds a path of the length of the faithful one.
TEST(AdaptiveContour, AgreesWithFaithfulStepsInAnyMetric) {
  const PairModel model = testing::with_masses(kob_andersen(), 1.0, 3.0);
  System system(model, testing::molten_kob_andersen());
  VelocityVerlet verlet = system.moving(2.0);
  for (int k = 0; k < 1000; ++k) verlet.step();
  const KinematicMetric metric(model, system.layout);
  AlignedArray start = testing::lowest_on_the_way(verlet, 1000), goal = testing::lowest_on_the_way(verlet, 1000);
  const double limit = std::max(system.landscape.energy(start), system.landscape.energy(goal));
  metric.to_kinematic(start);
  metric.to_kinematic(goal);
  const auto length = [&](auto stepper_on) {
    KinematicLandscape landscape(
        std::make_unique<PairLandscape>(model, system.configuration.box, system.layout, testing::active_isa()), metric);
    PathFinder finder(landscape.algebra(), stepper_on(landscape), start, goal, 108, {});
    finder.advance(1'000'000);
    EXPECT_EQ(finder.outcome(), Outcome::reached) << finder.reason();
    EXPECT_GT(finder.detour_steps(), 20u);
    return finder.statistics().length();
  };
  const double faithful = length([&](SoftLandscape& landscape) { return ContourStepper(landscape, limit, {.direct_step = 1e-3}); });
  const double adaptive = length([&](SoftLandscape& landscape) { return AdaptiveContourStepper(landscape, limit, {}); });
  EXPECT_NEAR(adaptive / faithful, 1.0, 0.01);
}

}  // namespace
}  // namespace lanescape
