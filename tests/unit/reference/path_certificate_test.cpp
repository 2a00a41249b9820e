#include "reference/path_certificate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "shortening_systems.hpp"

namespace {

using namespace lanescape::reference;

class ReferenceCertificate : public ::testing::TestWithParam<bool> {
 protected:
  PathCertificate certificate(const std::vector<Point>& nodes) const {
    return GetParam() ? hard_certificate(nodes, kTwo, kBox) : soft_certificate(nodes, kNearness, kSlope, -1.0);
  }
};
INSTANTIATE_TEST_SUITE_P(Kind, ReferenceCertificate, ::testing::Bool(),
                         [](const auto& tested) { return tested.param ? "hard" : "soft"; });

TEST_P(ReferenceCertificate, TheGeodesicOfTwoSpheresIsStationaryWithTheCurvatureOfTheArcAsMultiplier) {
  for (const Around& around : kAround)
    for (const std::size_t count : {101u, 401u}) {
      const PathCertificate found = certificate(Around::nodes(count, [&](double t) { return around.geodesic(t); }));
      const double spacing = around.shortest() / static_cast<double>(count - 1);  // the relative path is longer by sqrt(2)
      EXPECT_NEAR(found.length, around.shortest(), spacing * spacing);
      EXPECT_LT(found.residual, 1.5 * spacing);
      EXPECT_NEAR(found.largest_violation, spacing * spacing / 4.0, 0.01 * spacing * spacing);
      double sum = 0.0;
      for (const double lambda : found.multipliers) sum += lambda;
      const double arc = around.angle - std::acos(1.0 / around.a) - std::acos(1.0 / around.b);
      EXPECT_NEAR(sum, arc, 2e-3 * arc) << "the path turns by this angle";
    }
}

TEST_P(ReferenceCertificate, AStraightLineHasNeitherResidualNorMultipliers) {
  const Point from{1.0, 2.0, 0.0, 4.0, 1.0, 0.0}, way{0.3, 1.1, -0.4, -0.2, 0.7, 0.9};
  const PathCertificate found = certificate(Around::nodes(33, [&](double t) { return combine(from, t, way); }));
  EXPECT_EQ(found.residual, 0.0);
  EXPECT_EQ(found.largest_violation, 0.0);
  EXPECT_NEAR(found.length, std::sqrt(dot(way, way)), 1e-14);
}

TEST_P(ReferenceCertificate, ABendInTheOpenAndABendAwayFromTheBoundaryAreNotStationary) {
  const Around& around = kAround.front();
  EXPECT_NEAR(certificate(Around::nodes(65, [&](double t) { return around.wide(t); })).residual, 1.0, 1e-12);
  // Over the top of a tent that stands on the sphere's far side: the string is not taut there.
  const std::vector<Point> tent{two_spheres(1.5, 0.0), two_spheres(1.0, 0.1), two_spheres(1.5, 0.2)};
  const PathCertificate found = certificate(tent);
  EXPECT_GT(found.residual, 0.9);
}

TEST(ReferenceCertificates, RefusePathsWithoutDirections) {
  const Point a = two_spheres(2.0, 0.0), b = two_spheres(2.0, 1.0);
  EXPECT_THROW(hard_certificate({a, b}, kTwo, kBox), std::invalid_argument);
  EXPECT_THROW(hard_certificate({a, b, b}, kTwo, kBox), std::invalid_argument);
  EXPECT_THROW(soft_certificate({a, b, {1.0}}, kNearness, kSlope, -1.0), std::invalid_argument);
}

TEST(ReferenceFit, IsNonNegativeAndLeavesARestThatNoColumnCanReduce) {
  const std::vector<Point> columns{{1.0, 0.0, 0.0}, {0.8, 0.6, 0.0}, {-1.0, 1.0, 0.0}, {0.0, 0.0, -1.0}};
  const Point target{1.0, 0.2, 1.0};
  const std::vector<double> x = non_negative_fit(columns, target);
  Point rest = target;
  for (std::size_t c = 0; c < 4; ++c) rest = combine(rest, -x[c], columns[c]);
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_GE(x[c], 0.0);
    EXPECT_LE(dot(columns[c], rest), 1e-12);
    EXPECT_NEAR(x[c] * dot(columns[c], rest), 0.0, 1e-12);
  }
  EXPECT_EQ(x[3], 0.0);
  EXPECT_NEAR(rest[2], 1.0, 0.0);
  EXPECT_NEAR(rest[0], 0.0, 1e-12);
  EXPECT_NEAR(rest[1], 0.0, 1e-12);
}

}  // namespace
