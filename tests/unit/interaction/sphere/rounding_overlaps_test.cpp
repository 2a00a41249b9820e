#include "interaction/sphere/rounding_overlaps.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

// Spheres in a row along x in a box of edge 10.
Configuration row(const std::vector<double>& x, const std::vector<double>& radii) {
  Configuration configuration{Box{{10.0, 10.0, 10.0}}, std::vector<int>(x.size(), 0), {}, radii};
  for (const double at : x) configuration.positions.insert(configuration.positions.end(), {at, 3.0, 3.0});
  return configuration;
}

std::string refusal(const Configuration& configuration, double tolerance) {
  return testing::refusal([&] { rounding_overlap_factor(configuration, tolerance); });
}

TEST(RoundingOverlaps, SpheresThatTouchAreLeftAlone) {
  Configuration configuration = row({0.0, 1.0, 2.5}, {0.5, 0.5, 1.0});
  EXPECT_EQ(remove_rounding_overlaps(configuration, 0.0), 1.0);
  EXPECT_EQ(configuration.radii, (std::vector<double>{0.5, 0.5, 1.0}));
}

TEST(RoundingOverlaps, OneFactorOfTheDeepestOverlapScalesAllRadii) {
  // Overlaps of 1e-8 and of 4e-8 s_ij, the deeper one across the face of the box.
  Configuration configuration = row({0.0, 1.0 - 1e-8, 5.0, -1.5 + 6e-8 + 20.0}, {0.5, 0.5, 0.25, 1.0});
  const double factor = remove_rounding_overlaps(configuration, 1e-7);
  EXPECT_NEAR(factor, 1.0 - 4e-8, 2e-12);
  EXPECT_EQ(configuration.radii, (std::vector<double>{0.5 * factor, 0.5 * factor, 0.25 * factor, 1.0 * factor}));
  EXPECT_EQ(remove_rounding_overlaps(configuration, 0.0), 1.0);
}

TEST(RoundingOverlaps, DeeperOnesAreRefusedWithPairGapAndTolerance) {
  const std::string message = refusal(row({0.0, 5.0, 6.5 - 3e-7}, {0.5, 0.5, 1.0}), 1e-7);
  EXPECT_EQ(message, "particles 1 and 2 overlap: their gap is -3e-07, at least -1.5e-07 is allowed (tolerance 1e-07 s_ij)");
  EXPECT_NE(refusal(row({4.0, 4.0}, {0.5, 0.5}), 0.5).find("gap is -1,"), std::string::npos);
}

TEST(RoundingOverlaps, BoxesBelowTwiceTheLargestDiameterAreRefused) {
  Configuration configuration = row({0.0, 5.0}, {0.5, 0.5});
  configuration.box.length[1] = 2.0;
  EXPECT_EQ(rounding_overlap_factor(configuration, 1e-7), 1.0);
  configuration.box.length[1] = 1.999;
  EXPECT_EQ(refusal(configuration, 1e-7), "box edge 1.999 is not allowed: at least twice the largest diameter of 1 is needed");
}

TEST(RoundingOverlaps, RadiiAndToleranceMustBeSound) {
  EXPECT_NE(refusal(row({0.0, 5.0}, {0.5}), 1e-7).find("1 radii were given for 2 particles"), std::string::npos);
  EXPECT_NE(refusal(row({}, {}), 1e-7).find("at least one particle"), std::string::npos);
  for (const double bad : {-1e-9, 1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(refusal(row({0.0}, {0.5}), bad).find("overlap tolerance"), std::string::npos);
}

}  // namespace
}  // namespace lanescape
