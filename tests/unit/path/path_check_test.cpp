#include "path/path_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "configuration/pair_model.hpp"
#include "landscape/pair_landscape.hpp"
#include "path/polyline.hpp"
#include "refusal.hpp"
#include "two_sphere_path.hpp"

namespace lanescape {
namespace {

using testing::TwoSpherePath;

constexpr double degree = std::numbers::pi / 180.0;
const Point centre{3.0, -2.0, 11.0};  // unwrapped: outside the box
const TwoSpherePath examples[] = {
    {3.0, 3.0, 170 * degree}, {3.0, 2.0, 150 * degree}, {1.5, 4.0, 179 * degree}, {2.0, 2.0, 125 * degree}};

// Two spheres of diameter 1 that may not come nearer than that: hard ones, or those of Weeks, Chandler and Andersen at E_L = u(1).
struct Pair {
  Box box{{20.0, 21.0, 22.0}};
  ParticleLayout layout{{0, 0}, 1};
  std::vector<double> radii{0.5, 0.5};
  PairModel soft = wca();
  KinematicMetric metric{soft, layout};
  double landscape_energy = soft.derivatives(soft.numbers(0), 1.0).u;

  std::unique_ptr<SoftLandscape> landscape() const {
    return std::make_unique<PairLandscape>(soft, box, layout, choose_isa("auto"));
  }
  PathCheck check(bool hard, const Polyline& nodes, const PathCheckOptions& options = {}) const {
    if (hard) return check_path(HardSpherePath{box, layout, radii, metric, choose_isa("auto")}, nodes, options);
    return check_path([&] { return landscape(); }, landscape_energy, nodes, options);
  }
  Polyline geodesic(const TwoSpherePath& example, std::size_t nodes) const {
    return testing::two_particle_path(layout, nodes, centre, [&](double t) { return example.geodesic(t); });
  }
};

class PathCheckOf : public ::testing::TestWithParam<bool> {
 protected:
  Pair pair_;
  PathCheck check(const Polyline& nodes, const PathCheckOptions& options = {}) const {
    return pair_.check(GetParam(), nodes, options);
  }
};
INSTANTIATE_TEST_SUITE_P(Kind, PathCheckOf, ::testing::Bool(), [](const auto& tested) { return tested.param ? "hard" : "soft"; });

TEST_P(PathCheckOf, TheGeodesicOfTwoSpheresIsStationaryAndHasTheLengthOfTheFormula) {
  for (const TwoSpherePath& example : examples) {
    for (const std::size_t nodes : {101u, 401u, 1601u}) {
      const PathCheck found = check(pair_.geodesic(example, nodes));
      const double h = example.length() / static_cast<double>(nodes - 1);
      EXPECT_NEAR(found.length, example.length() / std::sqrt(2.0), h * h * example.arc());
      EXPECT_LE(found.length, example.length() / std::sqrt(2.0));
      EXPECT_LT(found.kuhn_tucker_residual, 0.75 * h);
      // Chords cut into the sphere by h^2/8.
      const double depth = 1.0 - std::cos(0.5 * h), slope = GetParam() ? 1.0 : 24.0;
      EXPECT_NEAR(found.largest_violation, slope * depth, 0.3 * slope * depth);
    }
  }
}

TEST_P(PathCheckOf, MultipliersAreTheCurvatureTimesTheSpacingOnTheArcAndZeroOffIt) {
  const TwoSpherePath& example = examples[0];
  const PathCheck found = check(pair_.geodesic(example, 801));
  const double h = example.length() / 800.0, first = example.free_begin() / h, last = 800.0 - example.free_end() / h;
  ASSERT_EQ(found.multipliers.size(), 801u);
  for (std::size_t k = 0; k < 801; ++k) {
    const double at = static_cast<double>(k);
    if (at < first - 1.0 || at > last + 1.0) {
      EXPECT_NEAR(found.multipliers[k], 0.0, 1e-12) << k;
    }
    if (at > first + 1.0 && at < last - 1.0) {
      EXPECT_NEAR(found.multipliers[k], h, 1e-3 * h) << k;
    }
  }
}

// The multipliers of a constrained minimum are its derivative by the constraints: the length by the diameter, or by E_L.
TEST_P(PathCheckOf, MultipliersAddUpToTheChangeOfTheShortestLengthWithTheBoundary) {
  for (const TwoSpherePath& example : examples) {
    TwoSpherePath larger = example, smaller = example;
    larger.s += 1e-5;
    smaller.s -= 1e-5;
    const double by_diameter = (larger.length() - smaller.length()) / 2e-5 / std::sqrt(2.0);
    const PathCheck found = check(pair_.geodesic(example, 2001));
    double sum = 0.0;
    for (const double lambda : found.multipliers) sum += lambda;
    EXPECT_NEAR(sum / std::sqrt(2.0), by_diameter, 1e-3);  // |grad gap| is sqrt(2)
  }
}

TEST_P(PathCheckOf, AGreedySlideIsNotStationary) {
  const TwoSpherePath& example = examples[0];
  const PathCheck found =
      check(testing::two_particle_path(pair_.layout, 1001, centre, [&](double t) { return example.greedy(t); }));
  EXPECT_GT(found.kuhn_tucker_residual, 0.5);
  EXPECT_NEAR(found.length, 6.4106 / std::sqrt(2.0), 1e-3);
}

TEST_P(PathCheckOf, AStraightLineHasNoResidual) {
  for (const std::size_t nodes : {3u, 17u, 1001u}) {
    const auto line = [](double t) { return TwoSpherePath::between({3.0, 1.5, 0.2}, {-2.9, 1.7, 0.1}, t); };
    const PathCheck found = check(testing::two_particle_path(pair_.layout, nodes, centre, line));
    EXPECT_EQ(found.kuhn_tucker_residual, 0.0);
    EXPECT_EQ(found.largest_violation, 0.0);
  }
}

TEST_P(PathCheckOf, ABendInTheOpenIsNotStationary) {
  const auto bent = [](double t) {
    return t < 0.5 ? TwoSpherePath::between({3.0, 1.5, 0.0}, {0.0, 3.0, 0.0}, 2 * t)
                   : TwoSpherePath::between({0.0, 3.0, 0.0}, {-3.0, 1.5, 0.0}, 2 * t - 1);
  };
  EXPECT_NEAR(check(testing::two_particle_path(pair_.layout, 101, centre, bent)).kuhn_tucker_residual, 1.0, 1e-6);
}

void expect_same(const PathCheck& a, const PathCheck& b) {
  EXPECT_NEAR(a.length, b.length, 1e-12);
  EXPECT_NEAR(a.largest_violation, b.largest_violation, 1e-9);
  EXPECT_NEAR(a.kuhn_tucker_residual, b.kuhn_tucker_residual, 1e-7);
}

TEST_P(PathCheckOf, DependsNeitherOnDirectionNorOnAxesNorOnTheOrderOfParticles) {
  const TwoSpherePath& example = examples[1];
  const PathCheck found = check(pair_.geodesic(example, 301));
  EXPECT_GT(found.kuhn_tucker_residual, 1e-6);
  PathCheck back = check(reversed(pair_.geodesic(example, 301)));
  expect_same(found, back);
  for (std::size_t k = 0; k < 301; ++k) {
    EXPECT_NEAR(back.multipliers[300 - k], found.multipliers[k], 1e-9);
    EXPECT_NEAR(back.excess[300 - k], found.excess[k], 1e-9);
  }
  const auto exchanged = [&](double t) { return TwoSpherePath::between({}, example.geodesic(t), -1.0); };
  expect_same(found, check(testing::two_particle_path(pair_.layout, 301, centre, exchanged)));
  const auto rotated = [&](double t) { return testing::turned(example.geodesic(t)); };
  expect_same(found, check(testing::two_particle_path(pair_.layout, 301, centre, rotated)));
}

TEST_P(PathCheckOf, ThreadsChangeNothing) {
  const Polyline nodes = pair_.geodesic(examples[2], 301);
  const PathCheck one = check(nodes), three = check(nodes, {.threads = 3});
  EXPECT_EQ(one.length, three.length);
  EXPECT_EQ(one.kuhn_tucker_residual, three.kuhn_tucker_residual);
  EXPECT_EQ(one.largest_violation, three.largest_violation);
  EXPECT_EQ(one.multipliers, three.multipliers);
  EXPECT_EQ(one.excess, three.excess);
  EXPECT_EQ(one.segment_violation, three.segment_violation);
}

TEST_P(PathCheckOf, SeesASegmentThatCutsThroughBetweenTwoGoodNodes) {
  const auto through = [](double t) {
    return TwoSpherePath::between({2.0, 0.7, 0.0}, {-2.0, 0.7, 0.0}, t < 0.1 ? 0.0 : t > 0.9 ? 1.0 : 0.1);
  };
  const PathCheck found = check(testing::two_particle_path(pair_.layout, 3, centre, through));
  const double expected = GetParam() ? 0.3 : pair_.soft.derivatives(pair_.soft.numbers(0), 0.7).u - pair_.landscape_energy;
  EXPECT_NEAR(found.largest_violation, expected, 0.01 * expected);
  EXPECT_LT(found.segment_violation[0], 0.0);
  EXPECT_NEAR(found.segment_violation[1], expected, 0.01 * expected);
}

TEST_P(PathCheckOf, RefusesTooFewNodesAndNodesThatCoincideOrAreNotFinite) {
  Polyline nodes = pair_.geodesic(examples[0], 5);
  EXPECT_NE(testing::refusal([&] { check({nodes[0], nodes[1]}); }).find("at least 3"), std::string::npos);
  Polyline twice = nodes;
  twice[2] = twice[1];
  EXPECT_NE(testing::refusal([&] { check(twice); }).find("nodes 1 and 2"), std::string::npos);
  nodes[3][0] = std::nan("");
  EXPECT_NE(testing::refusal([&] { check(nodes); }).find("node 3"), std::string::npos);
  EXPECT_NE(testing::refusal([&] { check(pair_.geodesic(examples[0], 5), {.contact_tolerance = 0.0}); }).find("contact_tolerance"),
            std::string::npos);
}

}  // namespace
}  // namespace lanescape
