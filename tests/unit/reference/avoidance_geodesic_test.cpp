#include "reference/hard_geodesic.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "hard_paths.hpp"

namespace {

using namespace lanescape::reference;

constexpr std::array kPotentials{FictitiousPotential::harmonic, FictitiousPotential::linear, FictitiousPotential::cubic};

/// Length of an avoidance path for vanishing steps, in relative coordinates: straight to contact; along the sphere to the tangent
/// through the goal; straight to the goal. On the sphere each direct step ds, at the angle alpha to the inward normal, is followed
/// by avoidance steps of ds cos(alpha) outwards. The pair advances by ds sin(alpha), and ds (1 + cos(alpha)) is added to the
/// length.
double zigzag(double a, double s, double angle) {
  const double closest = a * std::cos(0.5 * angle);
  const double to_contact = a * std::sin(0.5 * angle) - std::sqrt(s * s - closest * closest);
  const double first = 0.5 * angle + std::acos(closest / s);  // angle between contact and goal
  const double last = std::acos(s / a);
  const int cells = 10'000;
  const double width = (first - last) / cells;
  double arc = 0.0;
  for (int k = 0; k < cells; ++k) {
    const double beta = last + (k + 0.5) * width;
    const double to_goal = std::sqrt(s * s + a * a - 2.0 * s * a * std::cos(beta));
    const double cos_alpha = (s - a * std::cos(beta)) / to_goal;
    const double sin_alpha = a * std::sin(beta) / to_goal;
    arc += s * width * (1.0 + cos_alpha) / sin_alpha;
  }
  return to_contact + arc + std::sqrt(a * a - s * s);
}

TEST(ReferenceAvoidance, AFreePathIsStraightAndItsLastHopCounts) {
  const Point start{0.0, 0.0, 0.0, 5.0, 5.0, 5.0};
  const Point finish{1.0, 2.0, 2.0, 5.0, 5.0, 5.0};
  AvoidanceOptions options;
  options.direct_step = 0.07;
  const HardGeodesic path = find_avoidance_geodesic(start, finish, kTwo, kBox, options);
  EXPECT_EQ(path.outcome, Outcome::reached);
  EXPECT_NEAR(path.length, 3.0, 1e-13);
  EXPECT_EQ(path.direct_steps, 42);  // 42 x 0.07 = 2.94, and a hop of 0.06
  EXPECT_EQ(path.avoidance_steps, 0);
  EXPECT_EQ(path.end, finish);
  EXPECT_NEAR(path.participation, 1.0, 1e-12);
}

TEST(ReferenceAvoidance, EqualEndsGiveAPathOfNoLength) {
  const Point here{0.0, 0.0, 0.0, 5.0, 5.0, 5.0};
  const HardGeodesic path = find_avoidance_geodesic(here, here, kTwo, kBox);
  EXPECT_EQ(path.outcome, Outcome::reached);
  EXPECT_EQ(path.length, 0.0);
  EXPECT_EQ(path.participation, 0.0);
}

TEST(ReferenceAvoidance, TheTwoSphereFormulasGiveTheKnownNumbers) {
  EXPECT_NEAR(shortest(3.0, 1.0, kAngle), 6.1620, 5e-5);
  EXPECT_NEAR(zigzag(3.0, 1.0, kAngle), 9.0229, 5e-5);
}

TEST(ReferenceAvoidance, AvoidanceAroundTwoSpheresApproachesTheZigzagInProportionToTheDirectStep) {
  // Measured: 8.8595, 9.0076, 9.0220 for direct steps of 0.1, 0.01, 0.001; the shortest is 6.1620, a slide 6.4106.
  const double expected = zigzag(3.0, 1.0, kAngle) / std::sqrt(2.0);
  for (const double step : {0.1, 0.01, 0.001}) {
    AvoidanceOptions options;
    options.direct_step = step;
    const HardGeodesic path = find_avoidance_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox, options);
    ASSERT_EQ(path.outcome, Outcome::reached) << path.reason;
    // With finite steps avoidance acts further from the sphere, where alpha is larger.
    EXPECT_LT(path.length, expected) << step;
    EXPECT_NEAR(path.length, expected, 1.5 * step) << step;
    EXPECT_GT(path.length, shortest(3.0, 1.0, kAngle) / std::sqrt(2.0));
    EXPECT_NEAR(path.participation, 2.0, 1e-9);  // both always move, by opposite vectors
  }
}

TEST(ReferenceAvoidance, ThePathOfTwoSpheresDoesNotDependOnThePotential) {
  // The direction of the force of one overlap does not depend on the potential.
  const HardGeodesic path = find_avoidance_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox);
  for (const FictitiousPotential potential : kPotentials) {
    AvoidanceOptions options;
    options.potential = potential;
    const HardGeodesic other = find_avoidance_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox, options);
    EXPECT_EQ(other.avoidance_steps, path.avoidance_steps);
    EXPECT_NEAR(other.length, path.length, 1e-9);
  }
}

TEST(ReferenceAvoidance, AStepIntoTheGapBehindASphereMovesTheOuterTwoAndLeavesTheMiddleOne) {
  // 0 moves into 1, which nearly touches 2. The first trial presses 1 into 2. The two normalised forces on 1 then cancel, so the
  // second trial moves 0 back and 2 forward and leaves 1: the case F_1 = 0.
  const std::vector<double> radii(3, 0.5);
  // The line is tilted, so that rounding makes F_1 small but not zero.
  const Vector line{0.48, 0.6, 0.64};
  Point start, finish;
  for (const double x : {0.0, 1.0 + 1e-3, 2.0 + 1e-3 + 1e-5})
    for (const double component : line) start.push_back(x * component);
  finish = start;
  for (std::size_t axis = 0; axis < 3; ++axis) finish[axis] += 5.0 * line[axis];
  AvoidanceOptions options;
  options.record = 1;
  options.max_steps = 1;
  for (const FictitiousPotential potential : kPotentials) {
    options.potential = potential;
    const HardGeodesic path = find_avoidance_geodesic(start, finish, radii, kBox, options);
    ASSERT_EQ(path.accepted.size(), 1u);
    EXPECT_EQ(path.accepted[0].kind, StepKind::avoidance);
    EXPECT_EQ(path.accepted[0].trials, 2);
    EXPECT_EQ(path.trials, (std::vector<long>{0, 0, 1}));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(path.end[axis], start[axis] - 1e-4 * line[axis], 1e-14);
      EXPECT_EQ(path.end[3 + axis], start[3 + axis]);
      EXPECT_NEAR(path.end[6 + axis], start[6 + axis] + 1e-4 * line[axis], 1e-14);
    }
    EXPECT_NEAR(path.participation, 2.0, 1e-9);
    EXPECT_EQ(path.outcome, Outcome::step_limit);
  }
}

TEST(ReferenceAvoidance, FailedTrialsAreWeightedByTheNormOverTheWholeSystem) {
  // 0 overlaps 1 from the left and 2 from below, at different depths; [G] Eq. 3.23 by hand.
  const std::vector<double> radii(3, 0.5);
  const Point start{0.0, 0.0, 0.0, 1.002, 0.0, 0.0, 0.0, 1.004, 0.0};
  const Point finish{5.0, 5.0, 0.0, 1.002, 0.0, 0.0, 0.0, 1.004, 0.0};
  AvoidanceOptions options;
  options.record = 1;
  options.max_steps = 1;
  const double x = 0.01 / std::sqrt(2.0);  // the direct trial
  const double r_1 = std::hypot(1.002 - x, x), r_2 = std::hypot(x, 1.004 - x);
  const double f_1 = 1.0 - r_1, f_2 = 1.0 - r_2;
  const double f_x = -f_1 * (1.002 - x) / r_1 + f_2 * x / r_2;
  const double f_y = f_1 * x / r_1 - f_2 * (1.004 - x) / r_2;
  const HardGeodesic path = find_avoidance_geodesic(start, finish, radii, kBox, options);
  ASSERT_EQ(path.accepted.size(), 1u);
  EXPECT_EQ(path.accepted[0].trials, 1);
  EXPECT_NEAR(path.end[0], 1e-4 * f_x / std::hypot(f_x, f_y), 1e-15);
  EXPECT_NEAR(path.end[1], 1e-4 * f_y / std::hypot(f_x, f_y), 1e-15);
  for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(moved(start, path.end, j), 1e-4, 1e-15);
}

/// Checks the length of one step and the particles that it moves, and returns its participation number.
double check_step(const Point& before, const AcceptedStep& step) {
  double second = 0.0, fourth = 0.0, movers = 0.0;
  for (std::size_t j = 0; j < before.size() / 3; ++j) {
    const double by = moved(before, step.positions, j);
    second += by * by;
    fourth += by * by * by * by;
    if (step.kind != StepKind::avoidance || by == 0.0) continue;
    EXPECT_NEAR(by, 1e-4, 1e-13);
    movers += 1.0;
  }
  const double participation = second * second / fourth;
  if (step.kind == StepKind::avoidance) {
    EXPECT_NEAR(participation, movers, 1e-7);  // n = c
  } else if (step.kind == StepKind::direct) {
    EXPECT_NEAR(distance(before, step.positions), 0.01, 1e-12);
  }
  return participation;
}

TEST(ReferenceAvoidance, EveryAcceptedConfigurationIsFreeOfOverlapsAndEveryAvoidanceStepMovesParticlesByItsLength) {
  const Pair pair = fluid(3, 0.3, 6.0, 1);
  AvoidanceOptions options;
  options.record = 100'000;
  const HardGeodesic path = find_avoidance_geodesic(pair.start, pair.finish, pair.radii, pair.box, options);
  ASSERT_EQ(path.outcome, Outcome::reached) << path.reason;
  ASSERT_LT(path.accepted.size(), options.record);
  EXPECT_EQ(path.end, pair.finish);
  EXPECT_GT(path.avoidance_steps, 1000);
  EXPECT_GT(path.trials.size(), 2u);  // some steps needed a second trial
  EXPECT_EQ(std::accumulate(path.trials.begin(), path.trials.end(), 0L), path.avoidance_steps);
  EXPECT_EQ(static_cast<long>(path.accepted.size()), path.direct_steps + path.avoidance_steps + 1);
  EXPECT_EQ(path.accepted.back().kind, StepKind::last_hop);
  double length = 0.0, weighted = 0.0;
  const Point* before = &pair.start;
  for (const AcceptedStep& step : path.accepted) {
    ASSERT_FALSE(any_overlap(step.positions, pair.radii, pair.box));
    const double dr = distance(*before, step.positions);
    length += dr;
    weighted += dr * check_step(*before, step);
    before = &step.positions;
  }
  EXPECT_NEAR(path.length, length, 1e-9);
  EXPECT_NEAR(path.participation, weighted / length, 1e-6);
  EXPECT_GT(path.length, distance(pair.start, pair.finish));
}

TEST(ReferenceAvoidance, AStartMovedByWholeBoxesTakesTheSameSteps) {
  Pair pair = fluid(2, 0.2, 3.0, 2);
  const HardGeodesic path = find_avoidance_geodesic(pair.start, pair.finish, pair.radii, pair.box);
  for (Point* end : {&pair.start, &pair.finish})
    for (std::size_t k = 0; k < end->size(); k += 2) (*end)[k] += static_cast<double>(k / 3 % 3) * pair.box[0];
  const HardGeodesic shifted = find_avoidance_geodesic(pair.start, pair.finish, pair.radii, pair.box);
  ASSERT_EQ(path.outcome, Outcome::reached);
  EXPECT_EQ(shifted.outcome, Outcome::reached);
  EXPECT_GT(path.avoidance_steps, 0);
  EXPECT_NEAR(shifted.length, path.length, 0.02 * path.length);  // rounding may change a few steps
}

TEST(ReferenceAvoidance, AvoidanceStallsHeadOn) {
  AvoidanceOptions options;
  options.patience = 1000;
  const HardGeodesic path = find_avoidance_geodesic(kHeadOn, kHeadOnFinish, kTwo, kBox, options);
  EXPECT_EQ(path.outcome, Outcome::stalled);
  EXPECT_EQ(std::string(path.reason), "no progress towards the end point");
  EXPECT_NEAR(smallest_gap(path.end, kTwo, kBox), 0.0, 0.02);
  EXPECT_TRUE(std::isfinite(path.length));
}

TEST(ReferenceAvoidance, AvoidanceStallsInARowThatFillsTheBox) {
  // A row of three touching spheres fills the box: any move along it makes an overlap.
  const std::vector<double> radii(3, 0.5);
  const Vector box{3.0, 10.0, 10.0};
  const Point start{0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0};
  Point finish = start;
  finish[3] += 1.5;
  finish[4] += 2.0;
  AvoidanceOptions options;
  options.max_trials = 50;
  const HardGeodesic path = find_avoidance_geodesic(start, finish, radii, box, options);
  EXPECT_EQ(path.outcome, Outcome::stalled);
  EXPECT_EQ(std::string(path.reason), "no avoidance trial is free of overlaps");
  EXPECT_EQ(path.end, start);
}

TEST(ReferenceAvoidance, AvoidanceStallsWhereADirectStepMakesCentresCoincide) {
  AvoidanceOptions options;
  options.direct_step = 2.0;  // to the same point, where the force has no direction
  const HardGeodesic path =
      find_avoidance_geodesic({0.0, 0.0, 0.0, 2.0, 0.0, 0.0}, {6.0, 0.0, 0.0, 2.0, 0.0, 0.0}, kTwo, kBox, options);
  EXPECT_EQ(path.outcome, Outcome::stalled);
  EXPECT_EQ(std::string(path.reason), "the forces of the overlaps cancel");
}

TEST(ReferenceAvoidance, CapsOnStepsAndTrialsEndInTypedOutcomes) {
  AvoidanceOptions options;
  options.max_steps = 300;
  HardGeodesic path = find_avoidance_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox, options);
  EXPECT_EQ(path.outcome, Outcome::step_limit);
  EXPECT_EQ(path.direct_steps + path.avoidance_steps, 300);
  options.max_trials = 0;
  path = find_avoidance_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox, options);
  EXPECT_EQ(path.outcome, Outcome::stalled);
  EXPECT_EQ(path.avoidance_steps, 0);
}

TEST(ReferenceAvoidance, EndsThatDoNotFitAreRefused) {
  const Point start{0.0, 0.0, 0.0, 5.0, 5.0, 5.0};
  const Point overlapping{0.0, 0.0, 0.0, 0.5, 0.0, 0.0};
  EXPECT_THROW(find_avoidance_geodesic(start, Point(3), kTwo, kBox), std::invalid_argument);
  EXPECT_THROW(find_avoidance_geodesic(start, start, Point{0.5}, kBox), std::invalid_argument);
  EXPECT_THROW(find_avoidance_geodesic(start, overlapping, kTwo, kBox), std::invalid_argument);
  Point lost = start;
  lost[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(find_avoidance_geodesic(lost, start, kTwo, kBox), std::invalid_argument);
  AvoidanceOptions options;
  options.avoidance_step = 0.0;
  EXPECT_THROW(find_avoidance_geodesic(start, start, kTwo, kBox, options), std::invalid_argument);
}

}  // namespace
