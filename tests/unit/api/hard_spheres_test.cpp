#include <lanescape/hard_spheres.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "refusal.hpp"

namespace lanescape {
namespace {

using testing::refusal;
constexpr std::array<double, 3> cube{10.0, 10.0, 10.0};
const std::vector<double> radii = {0.5, 0.7, 0.5};

// The first two overlap across a face by 0.2, the third touches the first.
const std::vector<double> positions = {0.0, 1.0, 1.0, 9.0, 1.0, 1.0, 0.0, 2.0, 1.0};

TEST(HardSpheres, FindOverlapsAcrossFacesButNotContacts) {
  HardSpheres spheres(radii, cube);
  EXPECT_EQ(spheres.particles(), 3u);
  EXPECT_TRUE(spheres.any_overlap(positions));
  const auto overlaps = spheres.overlaps(positions);
  ASSERT_EQ(overlaps.size(), 1u);
  EXPECT_EQ(overlaps[0].first, 0);
  EXPECT_EQ(overlaps[0].second, 1);
  EXPECT_NEAR(overlaps[0].gap, -0.2, 1e-15);
  EXPECT_NEAR(spheres.smallest_gap(positions), -0.2, 1e-15);
  std::vector<double> free = positions;
  free[3] = 8.0;
  EXPECT_FALSE(spheres.any_overlap(free));
  EXPECT_TRUE(spheres.overlaps(free).empty());
  EXPECT_EQ(spheres.smallest_gap(free), 0.0);
}

TEST(HardSpheres, WithASkinFindTheSameInConfigurationsThatFollowEachOther) {
  HardSpheres afresh(radii, cube), followed(radii, cube, {.skin = 0.3});
  std::vector<double> moving = positions;
  int overlapping = 0;
  for (int k = 0; k < 400; ++k) {
    moving[3] = 8.0 + 0.01 * k;
    moving[7] = 2.0 + 0.5 * std::sin(0.1 * k);
    const bool expected = afresh.any_overlap(moving);
    EXPECT_EQ(followed.any_overlap(moving), expected);
    overlapping += expected;
  }
  EXPECT_GT(overlapping, 50);
  EXPECT_LT(overlapping, 350);
}

TEST(HardSpheres, OfOneHaveAnInfiniteGap) {
  HardSpheres one(std::vector<double>{0.5}, cube);
  EXPECT_EQ(one.smallest_gap(std::vector<double>{1.0, 1.0, 1.0}), std::numeric_limits<double>::infinity());
}

TEST(HardSpheres, RefuseWhatCannotBe) {
  EXPECT_EQ(refusal([] { HardSpheres({}, cube); }), "no spheres were given: at least one is needed");
  EXPECT_NE(refusal([] { HardSpheres(std::vector<double>{-1.0}, cube); }).find("radius -1 of particle 0"), std::string::npos);
  EXPECT_NE(refusal([] { HardSpheres(radii, {10.0, 2.0, 10.0}); }).find("box edge 2 along axis 2 is not allowed"),
            std::string::npos);
  EXPECT_EQ(refusal([] { HardSpheres(radii, cube, {.skin = -1.0}); }), "skin -1 is not allowed: it must be finite and above 0");
  HardSpheres spheres(radii, cube);
  EXPECT_EQ(refusal([&] { spheres.any_overlap(std::vector<double>(4)); }),
            "4 coordinates were given for 3 particles: 9 are needed");
  std::vector<double> bad = positions;
  bad[5] = std::nan("");
  EXPECT_EQ(refusal([&] { spheres.overlaps(bad); }), "z coordinate nan of particle 1 (from 0) is not allowed: it must be finite");
}

}  // namespace
}  // namespace lanescape
