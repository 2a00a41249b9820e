#include "stepper/avoidance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "landscape/hard_sphere_landscape.hpp"
#include "memory_archive.hpp"
#include "reference/hard_sphere.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

constexpr Box box{{20.0, 20.0, 20.0}};

// Spheres of diameter 1 with the start and the goal of their path.
class Spheres {
 public:
  Spheres(std::vector<double> start, const std::vector<double>& goal, const AvoidanceStepper::Options& options = {})
      : radii_(start.size() / 3, 0.5),
        layout_(std::vector<int>(radii_.size(), 0), 1),
        landscape_(box, layout_, radii_, choose_isa("auto")),
        position_(layout_.to_slots(start)),
        goal_(layout_.to_slots(goal)),
        to_goal_(position_),
        next_(position_),
        stepper_(landscape_, options) {}

  std::optional<StepKind> step() {
    const VectorAlgebra& algebra = landscape_.algebra();
    algebra.difference(to_goal_, goal_, position_);
    const auto kind = stepper_.step({position_, to_goal_, algebra.norm(to_goal_)}, next_);
    if (kind) position_.swap(next_);
    return kind;
  }

  std::vector<double> positions() const { return layout_.to_user(position_); }
  bool any_overlap() const { return reference::any_overlap(positions(), radii_, box.length); }
  double distance_left() const { return landscape_.algebra().distance(position_, goal_); }
  const AvoidanceStepper& stepper() const { return stepper_; }
  void exchange(Archive& archive) {
    archive.field("position", position_);
    stepper_.exchange(archive, position_);
  }

 private:
  std::vector<double> radii_;
  ParticleLayout layout_;
  HardSphereLandscape landscape_;
  AlignedArray position_, goal_, to_goal_, next_;
  AvoidanceStepper stepper_;
};

TEST(AvoidanceStepper, GoesStraightWhereItMayToTheTouch) {
  // The first sphere touches the second; all numbers are exact.
  Spheres spheres({5.0, 5.0, 5.0, 6.5, 5.0, 5.0}, {5.75, 5.0, 5.0, 6.5, 5.0, 5.0}, {.direct_step = 0.5});
  EXPECT_EQ(spheres.step(), StepKind::direct);
  EXPECT_EQ(spheres.positions(), (std::vector<double>{5.5, 5.0, 5.0, 6.5, 5.0, 5.0}));
  EXPECT_FALSE(spheres.any_overlap());
  EXPECT_EQ(spheres.stepper().monitored(), 2.0);
}

TEST(AvoidanceStepper, MovesTheTwoThatWouldOverlapApartByItsStepAndNoOther) {
  // The third sphere takes most of a direct step and does not move in the avoidance step.
  Spheres spheres({5.0, 5.0, 5.0, 6.0001, 5.0, 5.0, 9.0, 5.0, 5.0}, {6.0, 5.0, 5.0, 5.0001, 5.0, 5.0, 12.0, 5.0, 5.0},
                  {.direct_step = 0.01, .avoidance_step = 1e-3});
  ASSERT_EQ(spheres.step(), StepKind::detour);
  const std::vector<double> expected{4.999, 5.0, 5.0, 6.0011, 5.0, 5.0, 9.0, 5.0, 5.0};
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(spheres.positions()[k], expected[k], 1e-14) << k;
  EXPECT_EQ(spheres.stepper().monitored(), 2.0);
  EXPECT_EQ(spheres.stepper().corrections()[0], 1u);
  EXPECT_EQ(spheres.stepper().statistics().moved()[2], 1u);
}

// In a line, 0 moves into 1; 1 gives way and overlaps 2 in the first trial. The forces of both trials have equal weight, so those
// on 1 cancel and it does not move.
Spheres three_in_line(std::uint64_t max_trials) {
  return {{5.0, 5.0, 5.0, 6.0, 5.0, 5.0, 7.0, 5.0, 5.0},
          {8.0, 5.0, 5.0, 6.0, 5.0, 5.0, 7.0, 5.0, 5.0},
          {.direct_step = 0.0625, .avoidance_step = 0.03125, .max_trials = max_trials}};
}

TEST(AvoidanceStepper, MovesTheThirdInLineAtTheSecondTrial) {
  Spheres spheres = three_in_line(2);
  ASSERT_EQ(spheres.step(), StepKind::detour) << spheres.stepper().failure();
  EXPECT_FALSE(spheres.any_overlap());
  EXPECT_EQ(spheres.stepper().monitored(), 2.0);
  EXPECT_EQ(spheres.stepper().corrections()[1], 1u);
  EXPECT_EQ(spheres.stepper().evaluations(), 3u);
  EXPECT_EQ(spheres.positions(), (std::vector<double>{4.96875, 5.0, 5.0, 6.0, 5.0, 5.0, 7.03125, 5.0, 5.0}));
}

TEST(AvoidanceStepper, SaysWhyThereIsNoStep) {
  Spheres spheres = three_in_line(1);
  EXPECT_FALSE(spheres.step());
  EXPECT_EQ(spheres.stepper().failure(), "1 pairs still overlap after 1 trials of 0.03125");
}

// Two spheres exchange positions and must pass a third; the three are not quite in line.
Spheres three_that_pass() { return {{4.0, 5.0, 5.0, 5.5, 5.2, 5.0, 7.0, 5.1, 5.3}, {7.0, 5.0, 5.0, 5.5, 5.2, 5.0, 4.0, 5.1, 5.3}}; }

TEST(AvoidanceStepper, NeverAcceptsAnOverlap) {
  Spheres spheres = three_that_pass();
  int detours = 0;
  for (int k = 0; k < 2000 && spheres.distance_left() > 0.01; ++k) {
    const auto kind = spheres.step();
    ASSERT_TRUE(kind) << spheres.stepper().failure();
    ASSERT_FALSE(spheres.any_overlap()) << k;
    detours += *kind == StepKind::detour;
  }
  EXPECT_GT(detours, 100);
}

TEST(AvoidanceStepper, HandedOnToAnotherItGoesOnWithTheSameBits) {
  Spheres whole = three_that_pass(), resumed = three_that_pass();
  for (int k = 0; k < 300; ++k) ASSERT_TRUE(whole.step());
  ASSERT_GT(whole.stepper().statistics().group_numbers()[1], 0u);
  testing::hand_on(whole, resumed);
  EXPECT_EQ(resumed.stepper().monitored(), whole.stepper().monitored());
  for (int k = 0; k < 100; ++k) ASSERT_EQ(resumed.step(), whole.step());
  EXPECT_EQ(resumed.positions(), whole.positions());
  EXPECT_EQ(resumed.stepper().evaluations(), whole.stepper().evaluations());
  EXPECT_EQ(resumed.stepper().corrections(), whole.stepper().corrections());
  EXPECT_EQ(resumed.stepper().statistics().moved(), whole.stepper().statistics().moved());
}

TEST(ContactPotential, HasNamesThatAreReadBack) {
  for (const auto potential :
       {kernels::ContactPotential::harmonic, kernels::ContactPotential::linear, kernels::ContactPotential::cubic})
    EXPECT_EQ(parse_contact_potential(to_string(potential)), potential);
  EXPECT_EQ(testing::refusal([] { parse_contact_potential("soft"); }),
            "unknown fictitious potential 'soft': allowed are harmonic, linear, cubic");
}

}  // namespace
}  // namespace lanescape
