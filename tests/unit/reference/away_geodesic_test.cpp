#include "reference/hard_geodesic.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "hard_paths.hpp"

namespace {

using namespace lanescape::reference;

TEST(ReferenceAway, AFreePathIsStraightAndItsLastHopCounts) {
  const Point start{0.0, 0.0, 0.0, 5.0, 5.0, 5.0};
  const Point finish{1.0, 2.0, 2.0, 5.0, 5.0, 5.0};
  const HardGeodesic path = find_away_geodesic(start, finish, kTwo, kBox);
  EXPECT_EQ(path.outcome, Outcome::reached);
  EXPECT_NEAR(path.length, 3.0, 1e-14);
  EXPECT_EQ(path.direct_steps + path.away_steps, 0);
  EXPECT_EQ(path.end, finish);
  const HardGeodesic none = find_away_geodesic(start, start, kTwo, kBox);
  EXPECT_EQ(none.outcome, Outcome::reached);
  EXPECT_EQ(none.length, 0.0);
  EXPECT_EQ(none.participation, 0.0);
}

TEST(ReferenceAway, CapsOnStepsAndDepthEndInTypedOutcomes) {
  AwayOptions away;
  away.max_steps = 0;
  EXPECT_EQ(find_away_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox, away).outcome, Outcome::step_limit);
  away = {};
  away.max_depth = 0;
  EXPECT_EQ(find_away_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox, away).outcome, Outcome::stalled);
}

TEST(ReferenceAway, AnAwayStepMovesOneSphereOutOfTheWayAndTheOtherBesideIt) {
  // q flies along x. p rests at its goal, 0.6 from the axis; contact is at x = -0.8. p moves to 1 from the axis, q to x = 0. From
  // there the way to both goals is free.
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

TEST(ReferenceAway, ASphereBesideAnotherIsNotInItsWayWhateverRoundingSays) {
  // In contact, 1 moves perpendicularly to the line of centres (its projection is rounding, of either sign) and 0 moves towards 1.
  // 1 must make way: if 0 did, being nearer to its goal, it would not move and the step would repeat without end.
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

TEST(ReferenceAway, AnAwayStepMovesSpheresOutOfTheWayOfSpheresThatMakeWay) {
  // As in the test above, with a third sphere above p and to its side. p moves up by 0.4 and pushes the third away from that point.
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

TEST(ReferenceAway, TheAwayMethodPassesHeadOnWithAFixedPerpendicular) {
  // Avoidance stalls here. Measured, in relative coordinates: 7.519 at 180 degrees, 7.102 at 170, shortest 6.162.
  const HardGeodesic head_on = find_away_geodesic(kHeadOn, kHeadOnFinish, kTwo, kBox);
  EXPECT_EQ(head_on.outcome, Outcome::reached) << head_on.reason;
  const HardGeodesic path = find_away_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, kAngle), kTwo, kBox);
  ASSERT_EQ(path.outcome, Outcome::reached) << path.reason;
  EXPECT_EQ(path.direct_steps, 2);  // the second closes the gap left by the first away step
  EXPECT_EQ(path.away_steps, 2);
  EXPECT_NEAR(path.length * std::sqrt(2.0), 7.102, 1e-3);
  EXPECT_LT(path.length, head_on.length);
  EXPECT_GT(path.length, shortest(3.0, 1.0, kAngle) / std::sqrt(2.0));
  EXPECT_GT(path.participation, 1.0);
  EXPECT_LT(path.participation, 2.0);
}

TEST(ReferenceAway, TheAwayMethodKeepsSpheresApartInAFluid) {
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
  // The away method is the negative control: its paths are longer.
  const HardGeodesic avoidance = find_avoidance_geodesic(pair.start, pair.finish, pair.radii, pair.box);
  ASSERT_EQ(avoidance.outcome, Outcome::reached) << avoidance.reason;
  EXPECT_GT(avoidance.length, distance(pair.start, pair.finish));
  EXPECT_GT(path.length, avoidance.length);
}

TEST(ReferenceAway, TheAwayMethodStallsWhereThereIsNoRoom) {
  // Two neighbours in a close-packed crystal exchange positions: there is no room to make way.
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

TEST(ReferenceAway, AnEndWithAnOverlapIsRefused) {
  const Point start{0.0, 0.0, 0.0, 5.0, 5.0, 5.0}, overlapping{0.0, 0.0, 0.0, 0.5, 0.0, 0.0};
  EXPECT_THROW(find_away_geodesic(overlapping, start, kTwo, kBox), std::invalid_argument);
}

}  // namespace
