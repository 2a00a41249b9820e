#include "path/finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "memory_archive.hpp"
#include "one_particle.hpp"
#include "stepper/contour.hpp"
#include "stepper/escape.hpp"

namespace lanescape {
namespace {

using testing::Bowl;
using testing::Hill;
using testing::OneParticle;

template <class Stepper>
PathFinder<Stepper> finder_on(OneParticle& landscape, double energy, const Point& start, const Point& goal, double step,
                              const FinderOptions& options = {}) {
  return {landscape.algebra(),
          Stepper(landscape, energy, {.direct_step = step}),
          landscape.array(start),
          landscape.array(goal),
          1,
          options};
}

constexpr Point hill_start{-3.0, 0.2, 0.0}, hill_goal{3.0, 0.0, 0.1};

// A path around the sphere of radius 1 of the hill.
template <class Stepper>
PathFinder<Stepper> around_the_hill(Hill& hill, double step, const FinderOptions& options = {}) {
  return finder_on<Stepper>(hill, std::exp(-0.5), hill_start, hill_goal, step, options);
}

template <class Stepper>
class PathFinderWith : public ::testing::Test {};
using Steppers = ::testing::Types<ContourStepper, EscapeStepper>;
struct StepperName {
  template <class Stepper>
  static std::string GetName(int) {
    return std::is_same_v<Stepper, ContourStepper> ? "contour" : "escape";
  }
};
TYPED_TEST_SUITE(PathFinderWith, Steppers, StepperName);

TYPED_TEST(PathFinderWith, ReachesAGoalThatIsFreeInAStraightLine) {
  Hill hill;
  auto finder = finder_on<TypeParam>(hill, 2.0, {-3.0, 1.0, 0.0}, {1.0, 4.0, 0.0}, 0.03);  // above the summit, 5 from the goal
  finder.advance(1'000);
  EXPECT_EQ(finder.outcome(), Outcome::reached);
  EXPECT_EQ(finder.reason(), "");
  EXPECT_EQ(finder.direct_steps(), 166u);  // plus a hop of 0.02
  EXPECT_EQ(finder.detour_steps(), 0u);
  EXPECT_NEAR(finder.statistics().length(), 5.0, 1e-13);
  EXPECT_EQ(finder.distance_left(), 0.0);
  EXPECT_EQ(finder.position(), hill.array({1.0, 4.0, 0.0}));
}

// Straight to the unit sphere, along it to the tangent through the goal, then straight to the goal.
double greedy_length(const Point& start, const Point& goal) {
  const Point way = difference(goal, start);
  const double b = dot(start, way) / dot(way, way);
  const double t = -b - std::sqrt(b * b - (dot(start, start) - 1.0) / dot(way, way));
  const Point contact{start[0] + t * way[0], start[1] + t * way[1], start[2] + t * way[2]};
  const double distance = OneParticle::norm(goal);
  const double arc = std::acos(dot(contact, goal) / distance) - std::acos(1.0 / distance);
  return t * OneParticle::norm(way) + arc + std::sqrt(distance * distance - 1.0);
}

TYPED_TEST(PathFinderWith, GoesAroundWhatIsInTheWayByTheGreedyLength) {
  Hill hill;
  auto finder = around_the_hill<TypeParam>(hill, 1e-3);
  finder.advance(100'000);
  ASSERT_EQ(finder.outcome(), Outcome::reached) << finder.reason();
  EXPECT_NEAR(finder.statistics().length(), greedy_length(hill_start, hill_goal), 2e-3);
  EXPECT_GT(finder.detour_steps(), 500u);
  EXPECT_EQ(finder.steps(), finder.direct_steps() + finder.detour_steps());
}

// Straight up the wall of the bowl, towards a goal outside it.
TYPED_TEST(PathFinderWith, StallsAtAWallWithAReasonAndHasEnded) {
  Bowl bowl;
  auto finder = finder_on<TypeParam>(bowl, 0.5, {0.1, 0.0, 0.0}, {3.0, 0.0, 0.0}, 0.01);
  finder.advance(100'000);
  EXPECT_EQ(finder.outcome(), Outcome::stalled);
  const bool contour = std::is_same_v<TypeParam, ContourStepper>;
  EXPECT_EQ(finder.reason(),
            std::string(contour ? "the direction to the goal is parallel to the gradient" : "no progress over 1000 steps") +
                ", at a distance of " + fmt::format("{:.6g}", finder.distance_left()) + " from the goal");
  EXPECT_NEAR(bowl.point(finder.position())[0], 1.0, 0.01);
  const std::uint64_t steps = finder.steps();
  finder.advance(1000);
  EXPECT_EQ(finder.steps(), steps);
}

TYPED_TEST(PathFinderWith, EndsAtTheStepLimitAndNotBefore) {
  for (const std::uint64_t limit : {1u, 100u, 2000u}) {
    Hill hill;
    auto finder = around_the_hill<TypeParam>(hill, 1e-3, {.max_steps = limit});
    finder.advance(limit);
    EXPECT_EQ(finder.outcome(), Outcome::running);
    finder.advance(1);
    EXPECT_EQ(finder.outcome(), Outcome::step_limit);
    EXPECT_EQ(finder.reason(), std::to_string(limit) + " steps were allowed");
    EXPECT_EQ(finder.steps(), limit);
  }
}

TEST(PathFinder, GivesUpAfterAsManyStepsWithoutProgressAsItHasPatience) {
  std::vector<std::uint64_t> steps;
  for (const std::uint64_t patience : {50u, 1000u}) {
    Bowl bowl;
    auto finder = finder_on<EscapeStepper>(bowl, 0.5, {0.1, 0.0, 0.0}, {3.0, 0.0, 0.0}, 0.01, {.patience = patience});
    finder.advance(100'000);
    EXPECT_EQ(finder.outcome(), Outcome::stalled);
    steps.push_back(finder.steps());
  }
  EXPECT_EQ(steps[1] - steps[0], 950u);
}

TYPED_TEST(PathFinderWith, KeepsTheLargestViolation) {
  Hill hill;
  auto finder = around_the_hill<TypeParam>(hill, 1e-3);
  double largest = 0.0;
  while (finder.outcome() == Outcome::running) {
    finder.advance(1);
    if (finder.outcome() == Outcome::running) largest = std::max(largest, hill.energy(finder.position()) - std::exp(-0.5));
  }
  EXPECT_EQ(finder.largest_violation(), largest);
  if (std::is_same_v<TypeParam, ContourStepper>) {
    EXPECT_EQ(largest, 0.0);
  } else {
    EXPECT_GT(largest, 0.0);
    EXPECT_LE(largest, 1e-4);
  }
}

TYPED_TEST(PathFinderWith, KeepsNoMoreTheLongerThePath) {
  for (const double step : {1e-3, 1e-5}) {
    Hill hill;
    auto finder = around_the_hill<TypeParam>(hill, step, {.frames = 20});
    finder.advance(10'000'000);
    ASSERT_EQ(finder.outcome(), Outcome::reached);
    EXPECT_EQ(finder.recorder().frames().size(), 20u);
    const DecimatedTrace& trace = finder.recorder().trace();
    EXPECT_GT(trace.rows(), 1000u);
    EXPECT_LE(trace.rows(), PathRecorder::trace_rows);
    EXPECT_EQ(trace.at(trace.rows() - 1, PathRecorder::step), static_cast<double>(finder.steps()));
  }
}

TEST(PathFinder, FramesAreEquallySpacedInTheDistanceToTheGoal) {
  Hill hill;
  auto finder = around_the_hill<ContourStepper>(hill, 1e-3, {.frames = 9});
  const double whole = finder.distance_left();
  const AlignedArray goal = hill.array(hill_goal);
  finder.advance(100'000);
  ASSERT_EQ(finder.recorder().frames().size(), 9u);
  for (std::size_t k = 0; k < 9; ++k)
    EXPECT_NEAR(hill.algebra().distance(finder.recorder().frames()[k], goal), whole * (1.0 - 0.1 * static_cast<double>(k + 1)),
                1e-3);
}

TEST(PathFinder, RowsOfTheTraceAreOfTheStepsTheyName) {
  Hill hill;
  auto finder = finder_on<ContourStepper>(hill, 2.0, {-3.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.25);
  finder.advance(1'000);
  const DecimatedTrace& trace = finder.recorder().trace();
  ASSERT_EQ(trace.rows(), 16u);
  for (std::size_t row = 0; row < 16; ++row) {
    const double steps = static_cast<double>(row + 1), x = -3.0 + 0.25 * steps;
    EXPECT_EQ(trace.at(row, PathRecorder::step), steps);
    EXPECT_EQ(trace.at(row, PathRecorder::length), 0.25 * steps);
    EXPECT_EQ(trace.at(row, PathRecorder::distance), 1.0 - x);
    EXPECT_EQ(trace.at(row, PathRecorder::energy), hill.energy(hill.array({x, 0.0, 0.0})));
    EXPECT_EQ(trace.at(row, PathRecorder::direct), steps);
    EXPECT_EQ(trace.at(row, PathRecorder::participation), 1.0);
  }
}

TYPED_TEST(PathFinderWith, HandedOnToAnotherItGoesOnWithTheSameBits) {
  Hill hill;
  auto whole = around_the_hill<TypeParam>(hill, 0.01);
  whole.advance(100'000);
  ASSERT_EQ(whole.outcome(), Outcome::reached);
  // Before the hill, at the hill, and at the end.
  for (const std::uint64_t stop : {std::uint64_t{1}, whole.steps() / 2, whole.steps() / 2 + 1, whole.steps()}) {
    auto begun = around_the_hill<TypeParam>(hill, 0.01);
    begun.advance(stop);
    auto resumed = around_the_hill<TypeParam>(hill, 0.01);
    testing::hand_on(begun, resumed);
    EXPECT_EQ(resumed.position(), begun.position());
    resumed.advance(100'000);
    EXPECT_EQ(resumed.outcome(), Outcome::reached);
    EXPECT_EQ(resumed.direct_steps(), whole.direct_steps());
    EXPECT_EQ(resumed.detour_steps(), whole.detour_steps());
    EXPECT_EQ(resumed.statistics().length(), whole.statistics().length());
    EXPECT_EQ(resumed.largest_violation(), whole.largest_violation());
    EXPECT_EQ(resumed.stepper().evaluations(), whole.stepper().evaluations());
    EXPECT_EQ(resumed.stepper().corrections(), whole.stepper().corrections());
    EXPECT_EQ(resumed.recorder().frames(), whole.recorder().frames());
  }
}

// Stops while the finder makes no progress (it must remember for how long), and after it has given up.
TEST(PathFinder, HandedOnWhereItIsStuckItGivesUpAtTheSameStep) {
  Bowl bowl;
  const auto stuck = [&] { return finder_on<EscapeStepper>(bowl, 0.5, {0.1, 0.0, 0.0}, {3.0, 0.0, 0.0}, 0.01); };
  auto whole = stuck();
  whole.advance(100'000);
  for (const std::uint64_t stop : {600u, 100'000u}) {
    auto begun = stuck(), resumed = stuck();
    begun.advance(stop);
    testing::hand_on(begun, resumed);
    resumed.advance(100'000);
    EXPECT_EQ(resumed.outcome(), Outcome::stalled);
    EXPECT_EQ(resumed.reason(), whole.reason());
    EXPECT_EQ(resumed.steps(), whole.steps());
  }
}

TEST(Outcome, HasAWordForEach) {
  EXPECT_STREQ(to_string(Outcome::running), "running");
  EXPECT_STREQ(to_string(Outcome::reached), "reached");
  EXPECT_STREQ(to_string(Outcome::step_limit), "step_limit");
  EXPECT_STREQ(to_string(Outcome::stalled), "stalled");
  EXPECT_STREQ(to_string(Outcome::interrupted), "interrupted");
}

}  // namespace
}  // namespace lanescape
