#include "reference/hard_geodesic.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>

namespace {

using namespace lanescape::reference;

using Point = std::vector<double>;

constexpr Vector kBox{40.0, 40.0, 40.0};
constexpr double kAngle = 170.0 * std::numbers::pi / 180.0;
constexpr std::array kPotentials{FictitiousPotential::harmonic, FictitiousPotential::linear, FictitiousPotential::cubic};
const std::vector<double> kTwo{0.5, 0.5};

double distance(const Point& a, const Point& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

double moved(const Point& a, const Point& b, std::size_t j) {
  return std::hypot(b[3 * j] - a[3 * j], b[3 * j + 1] - a[3 * j + 1], b[3 * j + 2] - a[3 * j + 2]);
}

/// Two spheres about a resting centre of mass, at the given distance and angle in a tilted plane.
Point two_spheres(double r, double angle) {
  const double x = 0.5 * r * std::cos(angle);
  const double y = 0.5 * r * std::sin(angle) * 0.6;
  const double z = 0.5 * r * std::sin(angle) * 0.8;
  return {x, y, z, -x, -y, -z};
}

/// PHYSICS 6: tangents from both ends to the sphere and the arc between. In relative coordinates; over sqrt(2) in 6-D.
double shortest(double a, double s, double angle) { return 2.0 * std::sqrt(a * a - s * s) + s * (angle - 2.0 * std::acos(s / a)); }

/// What the avoidance finder gives for vanishing steps, in relative coordinates: straight to contact; along the sphere to where
/// the goal comes into sight; straight again. On the sphere each direct step ds, at the angle alpha to the inward normal,
/// is undone by ds cos(alpha) of steps outwards. It advances by ds sin(alpha) and counts ds (1 + cos(alpha)), where a slide
/// would count ds sin(alpha).
double zigzag(double a, double s, double angle) {
  const double closest = a * std::cos(0.5 * angle);
  const double to_contact = a * std::sin(0.5 * angle) - std::sqrt(s * s - closest * closest);
  const double first = 0.5 * angle + std::acos(closest / s);  // between the pair's direction at contact and at the goal
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

TEST(ReferenceHardGeodesic, AFreePathIsStraightAndItsLastHopCounts) {
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

  const HardGeodesic away = find_away_geodesic(start, finish, kTwo, kBox);
  EXPECT_EQ(away.outcome, Outcome::reached);
  EXPECT_NEAR(away.length, 3.0, 1e-14);
  EXPECT_EQ(away.direct_steps + away.away_steps, 0);
  EXPECT_EQ(away.end, finish);
}

TEST(ReferenceHardGeodesic, EqualEndsGiveAPathOfNoLength) {
  const Point here{0.0, 0.0, 0.0, 5.0, 5.0, 5.0};
  for (const HardGeodesic& path : {find_avoidance_geodesic(here, here, kTwo, kBox), find_away_geodesic(here, here, kTwo, kBox)}) {
    EXPECT_EQ(path.outcome, Outcome::reached);
    EXPECT_EQ(path.length, 0.0);
    EXPECT_EQ(path.participation, 0.0);
  }
}

TEST(ReferenceHardGeodesic, TheTwoSphereFormulasGiveTheKnownNumbers) {
  EXPECT_NEAR(shortest(3.0, 1.0, kAngle), 6.1620, 5e-5);
  EXPECT_NEAR(zigzag(3.0, 1.0, kAngle), 9.0229, 5e-5);
}

TEST(ReferenceHardGeodesic, AvoidanceAroundTwoSpheresApproachesTheZigzagInProportionToTheDirectStep) {
  // Measured: 8.8595, 9.0076, 9.0220 for direct steps of 0.1, 0.01, 0.001; the shortest is 6.1620, a slide 6.4106.
  const double expected = zigzag(3.0, 1.0, kAngle) / std::sqrt(2.0);
  for (const double step : {0.1, 0.01, 0.001}) {
    AvoidanceOptions options;
    options.direct_step = step;
    const HardGeodesic path = find_avoidance_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox, options);
    ASSERT_EQ(path.outcome, Outcome::reached) << path.reason;
    // Steps of finite size avoid from further out, where the goal is seen at a better angle.
    EXPECT_LT(path.length, expected) << step;
    EXPECT_NEAR(path.length, expected, 1.5 * step) << step;
    EXPECT_GT(path.length, shortest(3.0, 1.0, kAngle) / std::sqrt(2.0));
    EXPECT_NEAR(path.participation, 2.0, 1e-9);  // the two always move by opposite amounts
  }
}

TEST(ReferenceHardGeodesic, ThePathOfTwoSpheresDoesNotDependOnThePotential) {
  // One overlap has one direction whatever its force.
  const HardGeodesic path = find_avoidance_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox);
  for (const FictitiousPotential potential : kPotentials) {
    AvoidanceOptions options;
    options.potential = potential;
    const HardGeodesic other = find_avoidance_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox, options);
    EXPECT_EQ(other.avoidance_steps, path.avoidance_steps);
    EXPECT_NEAR(other.length, path.length, 1e-9);
  }
}

TEST(ReferenceHardGeodesic, AStepIntoTheGapBehindASphereMovesTheOuterTwoAndLeavesTheMiddleOne) {
  // 0 runs into 1, which touches 2 almost. The first trial presses 1 into 2; the two normalised pushes on 1 then cancel,
  // so that the second moves 0 back and 2 on and leaves 1: the guard for F_1 = 0.
  const std::vector<double> radii(3, 0.5);
  // On a tilted line, so that rounding leaves something of F_1.
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

TEST(ReferenceHardGeodesic, FailedTrialsAreWeightedByTheNormOverTheWholeSystem) {
  // 0 overlaps 1 from the left and 2 from below, by different depths; [G] Eq. 3.23 by hand.
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

struct Pair {
  Point start;
  Point finish;
  std::vector<double> radii;
  Vector box;
};

/// n^3 spheres, every second one 1.4 times as large, and what event-driven dynamics makes of them
Pair fluid(std::size_t n, double packing_fraction, double separation, unsigned seed) {
  Pair result;
  double volume = 0.0;
  const std::size_t count = n * n * n;
  for (std::size_t j = 0; j < count; ++j) {
    result.radii.push_back(j % 2 == 0 ? 0.5 : 0.7);
    volume += 4.0 / 3.0 * std::numbers::pi * std::pow(result.radii.back(), 3);
  }
  const double edge = std::cbrt(volume / packing_fraction);
  result.box = {edge, edge, edge};
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Point sites, velocities;
  for (std::size_t j = 0; j < count; ++j)
    for (const std::size_t k : {j % n, j / n % n, j / n / n}) {
      sites.push_back(static_cast<double>(k) * edge / static_cast<double>(n));
      velocities.push_back(uniform(engine));
    }
  for (std::size_t k = 0; k < 3 * count - 3; ++k) velocities[3 * count - 3 + k % 3] -= velocities[k];
  // the last sphere takes up the momentum of the others, at first
  EventDriven simulation(sites, velocities, result.radii, std::vector<double>(count, 1.0), result.box);
  for (int k = 0; k < 500; ++k) simulation.step(1e6);
  simulation.step(simulation.time() + 1e-4);
  result.start = simulation.positions();
  double until = simulation.time();
  do {
    until += 0.01;
    while (simulation.step(until)) {
    }
    result.finish = simulation.positions();
  } while (distance(result.start, result.finish) < separation);
  return result;
}

TEST(ReferenceHardGeodesic, EveryAcceptedConfigurationIsFreeOfOverlapsAndEveryAvoidanceStepMovesParticlesByItsLength) {
  const Pair pair = fluid(3, 0.3, 6.0, 1);
  AvoidanceOptions options;
  options.record = 100'000;
  const HardGeodesic path = find_avoidance_geodesic(pair.start, pair.finish, pair.radii, pair.box, options);
  ASSERT_EQ(path.outcome, Outcome::reached) << path.reason;
  ASSERT_LT(path.accepted.size(), options.record);
  EXPECT_EQ(path.end, pair.finish);
  EXPECT_GT(path.avoidance_steps, 1000);
  EXPECT_GT(path.trials.size(), 2u);  // some needed a second trial
  EXPECT_EQ(std::accumulate(path.trials.begin(), path.trials.end(), 0L), path.avoidance_steps);
  EXPECT_EQ(static_cast<long>(path.accepted.size()), path.direct_steps + path.avoidance_steps + 1);
  EXPECT_EQ(path.accepted.back().kind, StepKind::last_hop);
  double length = 0.0, weighted = 0.0;
  const Point* before = &pair.start;
  for (const AcceptedStep& step : path.accepted) {
    ASSERT_FALSE(any_overlap(step.positions, pair.radii, pair.box));
    const double dr = distance(*before, step.positions);
    double second = 0.0, fourth = 0.0, movers = 0.0;
    for (std::size_t j = 0; j < pair.radii.size(); ++j) {
      const double by = moved(*before, step.positions, j);
      second += by * by;
      fourth += by * by * by * by;
      if (step.kind == StepKind::avoidance && by != 0.0) {
        ASSERT_NEAR(by, 1e-4, 1e-13);
        movers += 1.0;
      }
    }
    if (step.kind == StepKind::avoidance) {
      ASSERT_NEAR(second * second / fourth, movers, 1e-7);  // n = c
    } else if (step.kind == StepKind::direct) {
      ASSERT_NEAR(dr, 0.01, 1e-12);
    }
    length += dr;
    weighted += dr * second * second / fourth;
    before = &step.positions;
  }
  EXPECT_NEAR(path.length, length, 1e-9);
  EXPECT_NEAR(path.participation, weighted / length, 1e-6);
  EXPECT_GT(path.length, distance(pair.start, pair.finish));
}

TEST(ReferenceHardGeodesic, AStartMovedByWholeBoxesTakesTheSameSteps) {
  Pair pair = fluid(2, 0.2, 3.0, 2);
  const HardGeodesic path = find_avoidance_geodesic(pair.start, pair.finish, pair.radii, pair.box);
  for (Point* end : {&pair.start, &pair.finish})
    for (std::size_t k = 0; k < end->size(); k += 2) (*end)[k] += static_cast<double>(k / 3 % 3) * pair.box[0];
  const HardGeodesic shifted = find_avoidance_geodesic(pair.start, pair.finish, pair.radii, pair.box);
  ASSERT_EQ(path.outcome, Outcome::reached);
  EXPECT_EQ(shifted.outcome, Outcome::reached);
  EXPECT_GT(path.avoidance_steps, 0);
  EXPECT_NEAR(shifted.length, path.length, 0.02 * path.length);  // rounding may shift a step or two
}

/// Two spheres that change places on a line, exactly
const Point kHeadOn{1.5, 0.0, 0.0, -1.5, 0.0, 0.0};
const Point kHeadOnFinish{-1.5, 0.0, 0.0, 1.5, 0.0, 0.0};

TEST(ReferenceHardGeodesic, AvoidanceStallsHeadOn) {
  AvoidanceOptions options;
  options.patience = 1000;
  const HardGeodesic path = find_avoidance_geodesic(kHeadOn, kHeadOnFinish, kTwo, kBox, options);
  EXPECT_EQ(path.outcome, Outcome::stalled);
  EXPECT_EQ(std::string(path.reason), "no progress towards the end point");
  EXPECT_NEAR(smallest_gap(path.end, kTwo, kBox), 0.0, 0.02);
  EXPECT_TRUE(std::isfinite(path.length));
}

TEST(ReferenceHardGeodesic, AvoidanceStallsInARowThatFillsTheBox) {
  // A row of three touching spheres fills the box: whatever is pushed along it overlaps.
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

TEST(ReferenceHardGeodesic, AvoidanceStallsWhereADirectStepMakesCentresCoincide) {
  AvoidanceOptions options;
  options.direct_step = 2.0;  // no force has a direction there
  const HardGeodesic path =
      find_avoidance_geodesic({0.0, 0.0, 0.0, 2.0, 0.0, 0.0}, {6.0, 0.0, 0.0, 2.0, 0.0, 0.0}, kTwo, kBox, options);
  EXPECT_EQ(path.outcome, Outcome::stalled);
  EXPECT_EQ(std::string(path.reason), "the forces of the overlaps cancel");
}

TEST(ReferenceHardGeodesic, CapsOnStepsAndTrialsEndInTypedOutcomes) {
  AvoidanceOptions options;
  options.max_steps = 300;
  HardGeodesic path = find_avoidance_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox, options);
  EXPECT_EQ(path.outcome, Outcome::step_limit);
  EXPECT_EQ(path.direct_steps + path.avoidance_steps, 300);
  options.max_trials = 0;
  path = find_avoidance_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox, options);
  EXPECT_EQ(path.outcome, Outcome::stalled);
  EXPECT_EQ(path.avoidance_steps, 0);

  AwayOptions away;
  away.max_steps = 0;
  EXPECT_EQ(find_away_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox, away).outcome, Outcome::step_limit);
  away = {};
  away.max_depth = 0;
  EXPECT_EQ(find_away_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox, away).outcome, Outcome::stalled);
}

TEST(ReferenceHardGeodesic, AnAwayStepMovesOneSphereOutOfTheWayAndTheOtherBesideIt) {
  // q flies along x at p, at rest in its goal, off the axis by 0.6: contact at x = -0.8. p is moved to 1 from the axis, q
  // to x = 0. From there to the goals is free.
  const Point start{0.0, 0.6, 0.0, -3.0, 0.0, 0.0};
  const Point finish{0.0, 0.6, 0.0, 3.0, 0.0, 0.0};
  AwayOptions options;
  options.record = 10;
  const HardGeodesic path = find_away_geodesic(start, finish, kTwo, kBox, options);
  ASSERT_EQ(path.outcome, Outcome::reached) << path.reason;
  ASSERT_GE(path.accepted.size(), 3u);
  const Point contact{0.0, 0.6, 0.0, -0.8, 0.0, 0.0};
  const Point beside{0.0, 1.0, 0.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(path.accepted[0].kind, StepKind::direct);
  EXPECT_LT(distance(path.accepted[0].positions, contact), 1e-9);
  EXPECT_EQ(path.accepted[1].kind, StepKind::away);
  EXPECT_LT(distance(path.accepted[1].positions, beside), 1e-9);
}

TEST(ReferenceHardGeodesic, ASphereBesideAnotherIsNotInItsWayWhateverRoundingSays) {
  // In contact, 1 about to pass 0 exactly sideways (their projection is rounding, of either sign), 0 pressing against 1. It is 1
  // that must make way: moving 0, the nearer to its goal, by nothing would go on for ever.
  for (int k = 1; k <= 30; ++k) {
    const double turn = 0.1 * k;
    const double c = std::cos(turn), s = std::sin(turn);
    const double out = 1.0 + 1e-15;
    const Point start{0.0, 0.0, 0.0, out * c, out * s, 0.0};
    const Point finish{0.2 * c, 0.2 * s, 0.6, out * c - 3.0 * s, out * s + 3.0 * c, 0.0};
    AwayOptions options;
    options.patience = 100;
    const HardGeodesic path = find_away_geodesic(start, finish, kTwo, kBox, options);
    EXPECT_EQ(path.outcome, Outcome::reached) << turn << ' ' << path.reason;
  }
}

TEST(ReferenceHardGeodesic, AnAwayStepMovesSpheresOutOfTheWayOfSpheresThatMakeWay) {
  // As before, with a third sphere above p and a little aside. p goes up by 0.4 and pushes it straight away from there.
  const std::vector<double> radii(3, 0.5);
  const Point start{0.0, 0.6, 0.0, -3.0, 0.0, 0.0, 0.1, 1.61, 0.0};
  Point finish = start;
  finish[3] = 3.0;
  AwayOptions options;
  options.record = 2;
  const HardGeodesic path = find_away_geodesic(start, finish, radii, kBox, options);
  ASSERT_GE(path.accepted.size(), 2u);
  const double before = std::hypot(0.1, 0.61);
  const Point expected{0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.1 / before, 1.0 + 0.61 / before, 0.0};
  EXPECT_LT(distance(path.accepted[1].positions, expected), 1e-9);
}

TEST(ReferenceHardGeodesic, TheAwayMethodPassesHeadOnWithAFixedPerpendicular) {
  // Avoidance stalls here. Measured, in relative coordinates: 7.519 at 180 degrees, 7.102 at 170, shortest 6.162.
  const HardGeodesic head_on = find_away_geodesic(kHeadOn, kHeadOnFinish, kTwo, kBox);
  EXPECT_EQ(head_on.outcome, Outcome::reached) << head_on.reason;
  const HardGeodesic path = find_away_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox);
  ASSERT_EQ(path.outcome, Outcome::reached) << path.reason;
  EXPECT_EQ(path.direct_steps, 2);  // the second one closes the gap that the first away step has left
  EXPECT_EQ(path.away_steps, 2);
  EXPECT_NEAR(path.length * std::sqrt(2.0), 7.102, 1e-3);
  EXPECT_LT(path.length, head_on.length);
  EXPECT_GT(path.length, shortest(3.0, 1.0, kAngle) / std::sqrt(2.0));
  EXPECT_GT(path.participation, 1.0);
  EXPECT_LT(path.participation, 2.0);
}

TEST(ReferenceHardGeodesic, TheAwayMethodKeepsSpheresApartInAFluid) {
  const Pair pair = fluid(3, 0.2, 6.0, 3);
  AwayOptions options;
  options.record = 100'000;
  const HardGeodesic path = find_away_geodesic(pair.start, pair.finish, pair.radii, pair.box, options);
  ASSERT_EQ(path.outcome, Outcome::reached) << path.reason;
  EXPECT_GT(path.away_steps, 3);
  double length = 0.0;
  const Point* before = &pair.start;
  for (const AcceptedStep& step : path.accepted) {
    EXPECT_GT(smallest_gap(step.positions, pair.radii, pair.box), -1e-10);
    length += distance(*before, step.positions);
    before = &step.positions;
  }
  EXPECT_NEAR(path.length, length, 1e-12);
  // The negative control: its paths are longer.
  const HardGeodesic avoidance = find_avoidance_geodesic(pair.start, pair.finish, pair.radii, pair.box);
  ASSERT_EQ(avoidance.outcome, Outcome::reached) << avoidance.reason;
  EXPECT_GT(avoidance.length, distance(pair.start, pair.finish));
  EXPECT_GT(path.length, avoidance.length);
}

TEST(ReferenceHardGeodesic, TheAwayMethodStallsWhereThereIsNoRoom) {
  // Neighbours in a close-packed crystal that change places: nobody can make way for long.
  const double a = std::sqrt(2.0) * 1.02;
  const Vector box{3.0 * a, 3.0 * a, 3.0 * a};
  const std::array<Vector, 4> basis{{{0.0, 0.0, 0.0}, {0.0, 0.5, 0.5}, {0.5, 0.0, 0.5}, {0.5, 0.5, 0.0}}};
  Point start;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3; ++z)
        for (const Vector& site : basis) start.insert(start.end(), {a * (x + site[0]), a * (y + site[1]), a * (z + site[2])});
  Point finish = start;
  for (std::size_t axis = 0; axis < 3; ++axis) std::swap(finish[axis], finish[3 + axis]);
  const std::vector<double> radii(108, 0.5);
  const HardGeodesic path = find_away_geodesic(start, finish, radii, box);
  EXPECT_EQ(path.outcome, Outcome::stalled);
  EXPECT_EQ(std::string(path.reason), "spheres push each other without end");
  EXPECT_GT(smallest_gap(path.end, radii, box), -1e-10);
}

TEST(ReferenceHardGeodesic, EndsThatDoNotFitAreRefused) {
  const Point start{0.0, 0.0, 0.0, 5.0, 5.0, 5.0};
  const Point overlapping{0.0, 0.0, 0.0, 0.5, 0.0, 0.0};
  EXPECT_THROW(find_avoidance_geodesic(start, Point(3), kTwo, kBox), std::invalid_argument);
  EXPECT_THROW(find_avoidance_geodesic(start, start, Point{0.5}, kBox), std::invalid_argument);
  EXPECT_THROW(find_avoidance_geodesic(start, overlapping, kTwo, kBox), std::invalid_argument);
  EXPECT_THROW(find_away_geodesic(overlapping, start, kTwo, kBox), std::invalid_argument);
  Point lost = start;
  lost[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(find_avoidance_geodesic(lost, start, kTwo, kBox), std::invalid_argument);
  AvoidanceOptions options;
  options.avoidance_step = 0.0;
  EXPECT_THROW(find_avoidance_geodesic(start, start, kTwo, kBox, options), std::invalid_argument);
}

}  // namespace
