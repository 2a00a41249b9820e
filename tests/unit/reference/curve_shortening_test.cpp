#include "reference/curve_shortening.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "reference/hard_sphere.hpp"
#include "reference/path_certificate.hpp"
#include "shortening_systems.hpp"

namespace {

using namespace lanescape::reference;

class ReferenceCurve : public ::testing::TestWithParam<bool> {
 protected:
  Projection projection() const { return GetParam() ? without_overlaps(kTwo, kBox) : below_energy(kNearness, kSlope, -1.0); }
  PathCertificate certificate(const std::vector<Point>& nodes) const {
    const CertificateOptions coarse{.boundary_tolerance = 1e-2, .contact_tolerance = 1e-6};
    return GetParam() ? hard_certificate(nodes, kTwo, kBox, coarse) : soft_certificate(nodes, kNearness, kSlope, -1.0, coarse);
  }
};
INSTANTIATE_TEST_SUITE_P(Kind, ReferenceCurve, ::testing::Bool(),
                         [](const auto& tested) { return tested.param ? "hard" : "soft"; });

TEST_P(ReferenceCurve, FindsTheGeodesicOfTwoSpheresFromAWideWayRound) {
  for (const Around& around : kAround) {
    const std::vector<Point> wide = Around::nodes(50, [&](double t) { return around.wide(t); });
    const ShortenedCurve found = shorten_curve(wide, projection());
    EXPECT_TRUE(found.stationary);
    EXPECT_EQ(found.nodes.front(), wide.front());
    EXPECT_EQ(found.nodes.back(), wide.back());
    EXPECT_EQ(found.nodes.size(), 129u);
    // Chords are shorter than their arcs.
    EXPECT_NEAR(found.length, around.shortest(), 1e-4 * around.shortest());
    EXPECT_LE(found.length, around.shortest());
    EXPECT_LT(certificate(found.nodes).residual, 0.02);
    for (const Point& node : found.nodes) EXPECT_LE(kNearness(node), -1.0 + 1e-11);
  }
}

TEST_P(ReferenceCurve, StraightensAPathWhereNothingIsInTheWay) {
  const Point from{1.0, 2.0, 0.0, 4.0, 1.0, 0.0}, way{0.3, 1.1, -0.4, -0.2, 0.7, 0.9}, side{0.0, 0.5, 0.5, 0.0, -0.5, 0.0};
  const auto bent = [&](double t) { return combine(combine(from, t, way), std::sin(3.0 * t) * (1.0 - t), side); };
  const ShortenedCurve found = shorten_curve(Around::nodes(40, bent), projection());
  EXPECT_TRUE(found.stationary);
  EXPECT_NEAR(found.length, std::sqrt(dot(way, way)), 1e-8);
}

TEST_P(ReferenceCurve, SaysWhereItIsNotStationary) {
  const CurveOptions few{.max_sweeps = 3};
  const Around& around = kAround.front();
  const ShortenedCurve found = shorten_curve(Around::nodes(50, [&](double t) { return around.wide(t); }), projection(), few);
  EXPECT_FALSE(found.stationary);
  EXPECT_GT(found.length, 1.01 * around.shortest());
  EXPECT_THROW(shorten_curve({around.start(), around.finish()}, projection()), std::invalid_argument);
}

TEST(ReferenceCurves, NodesAreEquallySpacedAlongAPathAndKeepItsEnds) {
  const std::vector<Point> nodes{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 2.0, 0.0}, {1.0, 2.0, 1.0}};
  const std::vector<Point> found = spaced_equally(nodes, 9);
  ASSERT_EQ(found.size(), 9u);
  EXPECT_EQ(found.front(), nodes.front());
  EXPECT_EQ(found.back(), nodes.back());
  EXPECT_NEAR(found[1][0], 0.5, 1e-15);
  EXPECT_NEAR(found[4][1], 1.0, 1e-15);
  EXPECT_NEAR(found[7][2], 0.5, 1e-15);
}

TEST(ReferenceCurves, ThreeSpheresInARowArePushedApartPairByPair) {
  Point row{0.0, 0.0, 0.0, 0.9, 0.0, 0.0, 1.8, 0.0, 0.0};
  const std::vector<double> radii(3, 0.5);
  ASSERT_TRUE(without_overlaps(radii, kBox)(row));
  EXPECT_NEAR(smallest_gap(row, radii, kBox), 0.0, 1e-12);
  EXPECT_NEAR(row[0], -0.1, 1e-9);  // the centre of mass rests
  EXPECT_NEAR(row[3], 0.9, 1e-9);
  EXPECT_NEAR(row[6], 1.9, 1e-9);
}

}  // namespace
