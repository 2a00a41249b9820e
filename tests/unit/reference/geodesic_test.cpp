#include "reference/geodesic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "reference/lennard_jones.hpp"
#include "reference/path_sum.hpp"

namespace {

using namespace lanescape::reference;

constexpr std::array kMethods{Method::contour, Method::escape};

double flat_energy(const Point&) { return 0.0; }
void flat_gradient(const Point&, Point& gradient) { std::fill(gradient.begin(), gradient.end(), 0.0); }

/// V = -|r_1 - r_2|, so V <= -s is the region |r_1 - r_2| >= s of two hard spheres. V does not depend on further particles.
double separation(const Point& r) {
  return std::sqrt((r[0] - r[3]) * (r[0] - r[3]) + (r[1] - r[4]) * (r[1] - r[4]) + (r[2] - r[5]) * (r[2] - r[5]));
}
double repulsion(const Point& r) { return -separation(r); }
void repulsion_gradient(const Point& r, Point& gradient) {
  std::fill(gradient.begin(), gradient.end(), 0.0);
  const double d = separation(r);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    gradient[axis] = -(r[axis] - r[axis + 3]) / d;
    gradient[axis + 3] = -gradient[axis];
  }
}

/// Two spheres about a resting centre of mass, at the given distance and angle in a tilted plane.
Point two_spheres(double r, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  const double x = 0.5 * r * std::cos(angle);
  const double y = 0.5 * r * std::sin(angle) * 0.6;
  const double z = 0.5 * r * std::sin(angle) * 0.8;
  return {x, y, z, -x, -y, -z};
}

GeodesicOptions hard_spheres(double step = 1e-3) {
  GeodesicOptions options;
  options.landscape_energy = -1.0;
  options.step = step;
  return options;
}

/// PHYSICS 6, analytic check: tangents from both ends to the sphere and the arc between, in 6N coordinates.
double shortest(double a, double b, double s, double angle) {
  const double bracket = std::sqrt(a * a - s * s) + std::sqrt(b * b - s * s) + s * (angle - std::acos(s / a) - std::acos(s / b));
  return bracket / std::sqrt(2.0);
}

/// Length of a path that always heads for the goal, between ends at equal distance a: straight to contact, along the sphere to the
/// tangent through the goal, straight to the goal.
double greedy_slide(double a, double s, double angle) {
  const double half_chord = a * std::sin(0.5 * angle);
  const double closest = a * std::cos(0.5 * angle);
  const double to_contact = half_chord - std::sqrt(s * s - closest * closest);
  const double arc = std::acos(closest / s) + 0.5 * angle - std::acos(s / a);
  return (to_contact + s * arc + std::sqrt(a * a - s * s)) / std::sqrt(2.0);
}

constexpr double kAngle = 170.0 * std::numbers::pi / 180.0;

TEST(ReferenceGeodesic, AFreePathIsStraightAndItsLastHopCounts) {
  const Point start{0.0, 0.0, 0.0, 1.0, 1.0, 1.0};
  const Point finish{1.0, 2.0, 2.0, 1.0, 1.0, 1.0004};
  for (const Method method : kMethods) {
    GeodesicOptions options;
    options.step = 0.07;
    const Geodesic path = find_geodesic(start, finish, flat_energy, flat_gradient, method, options);
    EXPECT_EQ(path.outcome, Outcome::reached);
    EXPECT_NEAR(path.length, distance(start, finish), 1e-13);
    EXPECT_EQ(path.direct_steps, 42);  // 42 x 0.07 = 2.94, and a hop of 0.06
    EXPECT_EQ(path.contour_steps, 0);
    EXPECT_EQ(path.escape_steps, 0);
    EXPECT_EQ(path.end, finish);
  }
}

TEST(ReferenceGeodesic, EqualEndsGiveAPathOfNoLength) {
  const Point here{1.0, 2.0, 3.0};
  const Geodesic path = find_geodesic(here, here, flat_energy, flat_gradient, Method::contour);
  EXPECT_EQ(path.outcome, Outcome::reached);
  EXPECT_EQ(path.length, 0.0);
  EXPECT_EQ(path.direct_steps, 0);
  EXPECT_EQ(path.participation, 0.0);
}

TEST(ReferenceGeodesic, ParticipationCountsTheParticlesThatMove) {
  const Point start(12, 0.0);
  for (std::size_t moving = 1; moving <= 4; ++moving) {
    Point finish = start;
    for (std::size_t j = 0; j < moving; ++j) finish[3 * j + j % 3] = j % 2 == 0 ? 0.5 : -0.5;
    const Geodesic path = find_geodesic(start, finish, flat_energy, flat_gradient, Method::contour);
    EXPECT_NEAR(path.participation, static_cast<double>(moving), 1e-9);
  }
}

TEST(ReferenceGeodesic, ParticipationOfUnequalDisplacementsIsTheQuotientOfMoments) {
  const Point start(6, 0.0);
  const Point finish{2.0, 0.0, 0.0, 0.0, 1.0, 0.0};
  const Geodesic path = find_geodesic(start, finish, flat_energy, flat_gradient, Method::contour);
  EXPECT_NEAR(path.participation, 25.0 / 17.0, 1e-9);
}

TEST(ReferenceGeodesic, TheTwoSphereFormulasGiveTheKnownNumbers) {
  EXPECT_NEAR(shortest(3.0, 3.0, 1.0, kAngle) * std::sqrt(2.0), 6.1620, 5e-5);
  EXPECT_NEAR(greedy_slide(3.0, 1.0, kAngle) * std::sqrt(2.0), 6.4106, 5e-5);
}

TEST(ReferenceGeodesic, ContourAndEscapeSlideAroundTwoSpheres) {
  const Point start = two_spheres(3.0, 0.0);
  const Point finish = two_spheres(3.0, 170.0);
  for (const Method method : kMethods) {
    const Geodesic path = find_geodesic(start, finish, repulsion, repulsion_gradient, method, hard_spheres());
    ASSERT_EQ(path.outcome, Outcome::reached) << path.reason;
    EXPECT_NEAR(path.length, greedy_slide(3.0, 1.0, kAngle), 2e-3);
    EXPECT_GT(path.length, shortest(3.0, 3.0, 1.0, kAngle));
    EXPECT_GT(path.length, distance(start, finish));
    EXPECT_NEAR(path.participation, 2.0, 1e-9);  // both always move, by opposite vectors
    EXPECT_EQ(path.escape_steps == 0, method == Method::contour);
    EXPECT_EQ(path.contour_steps == 0, method == Method::escape);
  }
}

TEST(ReferenceGeodesic, ContourApproachesTheGreedySlideInProportionToTheStep) {
  const Point start = two_spheres(3.0, 0.0);
  const Point finish = two_spheres(3.0, 170.0);
  const double expected = greedy_slide(3.0, 1.0, kAngle);
  for (const double step : {1e-2, 1e-3, 1e-4}) {
    const Geodesic path = find_geodesic(start, finish, repulsion, repulsion_gradient, Method::contour, hard_spheres(step));
    EXPECT_NEAR(path.length, expected, 2.0 * step) << step;
  }
}

TEST(ReferenceGeodesic, AContourStepIsAsLongAsADirectStep) {
  const Geodesic path =
      find_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, 170.0), repulsion, repulsion_gradient, Method::contour, hard_spheres());
  const double hop = path.length - 1e-3 * static_cast<double>(path.direct_steps + path.contour_steps);
  EXPECT_GT(hop, 0.0);
  EXPECT_LT(hop, 1e-3);
}

TEST(ReferenceGeodesic, AnIdleParticleChangesNothing) {
  Point start = two_spheres(3.0, 0.0);
  Point finish = two_spheres(3.0, 150.0);
  const Geodesic two = find_geodesic(start, finish, repulsion, repulsion_gradient, Method::contour, hard_spheres(1e-2));
  for (Point* end : {&start, &finish}) end->insert(end->end(), {0.0, 5.0, 0.0});
  const Geodesic three = find_geodesic(start, finish, repulsion, repulsion_gradient, Method::contour, hard_spheres(1e-2));
  EXPECT_EQ(two.length, three.length);
  EXPECT_EQ(two.participation, three.participation);
}

TEST(ReferenceGeodesic, NoAcceptedConfigurationExceedsWhatTheMethodAllows) {
  const Point start = two_spheres(3.0, 0.0);
  const Point finish = two_spheres(3.0, 170.0);
  for (const Method method : kMethods) {
    double worst = -std::numeric_limits<double>::infinity();
    GeodesicOptions options = hard_spheres(1e-2);
    // With a limit of n steps a path ends at its n-th accepted configuration.
    for (options.max_steps = 1; options.max_steps < 600; ++options.max_steps) {
      const Geodesic path = find_geodesic(start, finish, repulsion, repulsion_gradient, method, options);
      worst = std::max(worst, repulsion(path.end));
      if (path.outcome == Outcome::reached) break;
    }
    EXPECT_LT(options.max_steps, 600);
    EXPECT_LE(worst, method == Method::contour ? -1.0 : -1.0 + 1e-4);
    EXPECT_GT(worst, -1.0 - 2e-2);  // it reaches the boundary
  }
}

TEST(ReferenceGeodesic, TheLandscapeEnergyIsTheHigherOfTheEndsUnlessGiven) {
  const Point low = two_spheres(3.0, 0.0);
  const Point high = two_spheres(1.5, 30.0);
  for (const Method method : kMethods) {
    EXPECT_DOUBLE_EQ(find_geodesic(low, high, repulsion, repulsion_gradient, method).landscape_energy, -1.5);
    EXPECT_DOUBLE_EQ(find_geodesic(high, low, repulsion, repulsion_gradient, method).landscape_energy, -1.5);
    EXPECT_EQ(find_geodesic(low, high, repulsion, repulsion_gradient, method, hard_spheres()).landscape_energy, -1.0);
  }
}

TEST(ReferenceGeodesic, ContourEvaluatesTheEnergyOncePerTrialAndTheGradientOncePerContourStep) {
  long energies = 0;
  long gradients = 0;
  const auto energy = [&](const Point& r) {
    ++energies;
    return repulsion(r);
  };
  const auto gradient = [&](const Point& r, Point& g) {
    ++gradients;
    repulsion_gradient(r, g);
  };
  const Geodesic path =
      find_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, 170.0), energy, gradient, Method::contour, hard_spheres());
  ASSERT_EQ(path.outcome, Outcome::reached);
  EXPECT_EQ(gradients, path.contour_steps);
  // A tangential trial never fails because the sphere is convex.
  EXPECT_EQ(energies, path.direct_steps + 2 * path.contour_steps);
}

TEST(ReferenceGeodesic, ContourRetreatsDownTheGradientWhereTheTangentRises) {
  // V = x^2 + y^2 <= 1: tangents leave the disc, so each contour step needs some k > 0. The goal lies outside, so the path follows
  // the circle.
  long energies = 0;
  const auto energy = [&](const Point& r) {
    ++energies;
    return r[0] * r[0] + r[1] * r[1];
  };
  const auto gradient = [](const Point& r, Point& g) { g = {2.0 * r[0], 2.0 * r[1], 0.0}; };
  GeodesicOptions options;
  options.landscape_energy = 1.0;
  options.step = 1e-2;
  options.max_steps = 100;
  const Geodesic path = find_geodesic({1.0, 0.0, 0.0}, {1.0, 2.0, 0.0}, energy, gradient, Method::contour, options);
  EXPECT_EQ(path.outcome, Outcome::step_limit);
  EXPECT_GT(path.contour_steps, 50);
  EXPECT_GT(energies, path.direct_steps + 5 * path.contour_steps);  // V rises by 1e-4 along the tangent: five retreats
  EXPECT_LE(std::hypot(path.end[0], path.end[1]), 1.0);
  EXPECT_GT(std::hypot(path.end[0], path.end[1]), 0.97);
}

TEST(ReferenceGeodesic, AHeadOnObstacleStalls) {
  for (const Method method : kMethods) {
    const Geodesic path =
        find_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, 180.0), repulsion, repulsion_gradient, method, hard_spheres());
    EXPECT_EQ(path.outcome, Outcome::stalled);
    EXPECT_NE(std::string(path.reason), "");
    EXPECT_TRUE(std::isfinite(path.length));
    EXPECT_TRUE(std::isfinite(path.participation));
    EXPECT_NEAR(separation(path.end), 1.0, 5e-3);  // it stops at contact
  }
}

TEST(ReferenceGeodesic, AForbiddenPlateauStalls) {
  const auto plateau = [](const Point& r) { return r[0] < 0.5 ? 0.0 : 1.0; };
  for (const Method method : kMethods) {
    GeodesicOptions options;
    options.landscape_energy = 0.5;
    const Geodesic path = find_geodesic({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, plateau, flat_gradient, method, options);
    EXPECT_EQ(path.outcome, Outcome::stalled);
    EXPECT_NEAR(path.end[0], 0.5, 2e-3);
  }
}

TEST(ReferenceGeodesic, AnEnergyThatIsNotANumberIsForbidden) {
  const auto broken = [](const Point& r) { return r[0] < 0.5 ? 0.0 : std::numeric_limits<double>::quiet_NaN(); };
  GeodesicOptions options;
  options.landscape_energy = 0.0;
  for (const Method method : kMethods) {
    const Geodesic path = find_geodesic({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, broken, flat_gradient, method, options);
    EXPECT_EQ(path.outcome, Outcome::stalled);
    EXPECT_LT(path.end[0], 0.5);
  }
}

TEST(ReferenceGeodesic, ACapOnStepsEndsInStepLimit) {
  for (const Method method : kMethods) {
    GeodesicOptions options = hard_spheres();
    options.max_steps = 2000;
    const Geodesic path =
        find_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, 170.0), repulsion, repulsion_gradient, method, options);
    EXPECT_EQ(path.outcome, Outcome::step_limit);
    EXPECT_EQ(path.direct_steps + path.contour_steps + path.escape_steps, 2000);
    EXPECT_GT(path.length, 1.5);
  }
}

TEST(ReferenceGeodesic, ACapOnInnerIterationsStalls) {
  for (const Method method : kMethods) {
    GeodesicOptions options = hard_spheres();
    options.max_inner = 0;
    const Geodesic path =
        find_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, 170.0), repulsion, repulsion_gradient, method, options);
    EXPECT_EQ(path.outcome, Outcome::stalled);
    EXPECT_EQ(path.contour_steps + path.escape_steps, 0);
  }
}

TEST(ReferenceGeodesic, EndsThatDoNotFitAreRefused) {
  EXPECT_THROW(find_geodesic(Point(3), Point(6), flat_energy, flat_gradient, Method::contour), std::invalid_argument);
  EXPECT_THROW(find_geodesic(Point(4), Point(4), flat_energy, flat_gradient, Method::contour), std::invalid_argument);
  GeodesicOptions options;
  options.step = 0.0;
  EXPECT_THROW(find_geodesic(Point(3), Point(3, 1.0), flat_energy, flat_gradient, Method::contour, options), std::invalid_argument);
}

/// Two particles of a tetrahedral cluster of four exchange positions: the others must make way.
TEST(ReferenceGeodesic, ContourAndEscapeAgreeOnALennardJonesCluster) {
  const std::array<double, 3> box{20.0, 20.0, 20.0};
  const Mixture mixture{1, {1.0}, {1.0}, {2.5}};
  const std::vector<int> species(4, 0);
  const auto evaluate = [&](const Point& r) {
    return lennard_jones(r, species, box, mixture, ImageRule::all, Truncation::shifted);
  };
  const auto energy = [&](const Point& r) { return evaluate(r).energy; };
  const auto gradient = [&](const Point& r, Point& g) { g = evaluate(r).gradient; };
  const Point start{0.0, 0.0, 0.0, 1.2, 0.1, 0.0, 0.5, 1.1, 0.1, 0.6, 0.4, 1.0};
  const Point finish{1.2, 0.1, 0.0, 0.0, 0.0, 0.0, 0.5, 1.1, 0.1, 0.6, 0.4, 1.0};
  std::array<double, 2> lengths{};
  for (const Method method : kMethods) {
    GeodesicOptions options;
    options.landscape_energy = energy(start) + 1.0;
    options.max_steps = 20'000;
    const Geodesic path = find_geodesic(start, finish, energy, gradient, method, options);
    ASSERT_EQ(path.outcome, Outcome::reached) << path.reason;
    EXPECT_GT(path.contour_steps + path.escape_steps, 100);
    EXPECT_GT(path.participation, 1.0);
    EXPECT_LE(path.participation, 4.0);
    lengths[method == Method::contour ? 0 : 1] = path.length;
  }
  EXPECT_GT(lengths[0], distance(start, finish));
  EXPECT_NEAR(lengths[0], lengths[1], 5e-3 * lengths[0]);
}

}  // namespace
