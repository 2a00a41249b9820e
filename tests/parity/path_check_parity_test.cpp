#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "configuration/hard_sphere_model.hpp"
#include "landscape/kinematic_landscape.hpp"
#include "path/path_check.hpp"
#include "reference/curve_shortening.hpp"
#include "reference/hard_geodesic.hpp"
#include "reference/path_certificate.hpp"
#include "small_liquid.hpp"
#include "small_spheres.hpp"

namespace lanescape {
namespace {

void expect_same(const PathCheck& check, const reference::PathCertificate& expected, double tolerance,
                 double multiplier_tolerance) {
  EXPECT_NEAR(check.length, expected.length, 1e-12 * expected.length);
  EXPECT_NEAR(check.largest_violation, expected.largest_violation, tolerance);
  EXPECT_NEAR(check.kuhn_tucker_residual, expected.residual, 1e-5);  // bends of 4e-8 are rounding there
  ASSERT_EQ(check.excess.size(), expected.excess.size());
  for (std::size_t k = 0; k < check.excess.size(); ++k) {
    EXPECT_NEAR(check.excess[k], expected.excess[k], 1e-10) << "node " << k;
    EXPECT_NEAR(check.multipliers[k], expected.multipliers[k], multiplier_tolerance) << "node " << k;
  }
  ASSERT_EQ(check.segment_violation.size(), expected.segment_violation.size());
  for (std::size_t k = 0; k < check.segment_violation.size(); ++k)
    EXPECT_NEAR(check.segment_violation[k], expected.segment_violation[k], tolerance) << "segment " << k;
}

long bends_with_multipliers(const reference::PathCertificate& certificate) {
  return std::count_if(certificate.multipliers.begin(), certificate.multipliers.end(), [](double x) { return x > 0.0; });
}

TEST(PathCheckParity, SmallLiquidsHaveTheCertificateOfTheReference) {
  for (const std::size_t particles : {8u, 13u, 20u}) {
    const testing::SmallLiquid liquid(particles, particles, 2000);
    const auto nodes = liquid.greedy();
    const auto expected =
        reference::soft_certificate(nodes, liquid.energy(), liquid.gradient(), liquid.landscape_energy, {.samples = 40});
    EXPECT_GT(bends_with_multipliers(expected), 3) << "the path has a boundary";
    EXPECT_GT(expected.residual, 0.01);
    EXPECT_GT(expected.largest_violation, 0.0);
    const auto landscape = liquid.make();
    const PathCheck check = check_path(*landscape, liquid.landscape_energy, liquid.in_slots(nodes), {.samples = 40});
    expect_same(check, expected, 2e-5, 1e-7);  // a parabola through samples
  }
}

TEST(PathCheckParity, SmallSystemsOfHardSpheresHaveTheCertificateOfTheReference) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const testing::SmallSpheres spheres(seed);
    const auto greedy = spheres.greedy();
    const auto shortened =
        reference::shorten_curve(greedy, reference::without_overlaps(spheres.pair.radii, spheres.pair.box), {.fine = 65});
    const std::pair<std::vector<reference::Point>, double> paths[] = {{greedy, 1e-2}, {shortened.nodes, 1e-4}};
    for (const auto& [nodes, tolerance] : paths) {
      const auto expected =
          reference::hard_certificate(nodes, spheres.pair.radii, spheres.pair.box, {.contact_tolerance = tolerance});
      EXPECT_GT(bends_with_multipliers(expected), 3) << "the path has contacts";
      // A pair that touches on both segments of a node counts twice there, in nearly the same direction: the reference is slow to
      // share its multiplier out.
      expect_same(check_path(spheres.path(), spheres.in_slots(nodes), {.contact_tolerance = tolerance}), expected, 1e-11, 1e-4);
    }
  }
}

}  // namespace
}  // namespace lanescape
