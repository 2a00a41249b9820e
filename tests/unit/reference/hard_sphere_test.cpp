#include "reference/hard_sphere.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "hard_spheres.hpp"

namespace {

using namespace lanescape::reference;

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(ReferenceHardSphere, TouchingSpheresDoNotOverlap) {
  const std::vector<double> radii{0.5, 0.75};
  EXPECT_FALSE(any_overlap(Point{0.0, 0.0, 0.0, 1.25, 0.0, 0.0}, radii, kBox));
  EXPECT_EQ(smallest_gap(Point{0.0, 0.0, 0.0, 1.25, 0.0, 0.0}, radii, kBox), 0.0);
  EXPECT_TRUE(any_overlap(Point{0.0, 0.0, 0.0, std::nextafter(1.25, 0.0), 0.0, 0.0}, radii, kBox));
}

TEST(ReferenceHardSphere, SpheresOverlapAcrossTheBoundary) {
  const std::vector<double> radii{0.5, 0.75};
  const auto found = overlaps(Point{0.25, 3.0, 13.75, 9.5, 3.0, 0.25}, radii, kBox);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].separation, (Vector{-0.75, 0.0, 0.5}));
  EXPECT_DOUBLE_EQ(found[0].gap, std::sqrt(0.8125) - 1.25);
}

TEST(ReferenceHardSphere, UnwrappedPositionsOverlapLikeWrappedOnes) {
  const std::vector<double> radii{0.5, 0.75};
  EXPECT_TRUE(any_overlap(Point{30.0, -24.0, 0.0, 1.0, 0.0, 42.0}, radii, kBox));
  EXPECT_FALSE(any_overlap(Point{30.0, -24.0, 0.0, 1.25, 0.0, 42.0}, radii, kBox));
}

TEST(ReferenceHardSphere, OverlapsAreListedInTheOrderOfTheirParticlesAndPointFromFirstToSecond) {
  const std::vector<double> radii(4, 0.5);
  const auto found = overlaps(Point{0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 0.75, 0.0}, radii, kBox);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(Pairs({{found[0].i, found[0].j}, {found[1].i, found[1].j}, {found[2].i, found[2].j}}), Pairs({{0, 1}, {0, 3}, {1, 3}}));
  EXPECT_EQ(found[0].separation, (Vector{0.5, 0.0, 0.0}));
  EXPECT_EQ(found[0].gap, -0.5);
  EXPECT_EQ(found[1].gap, -0.25);
  EXPECT_EQ(found[2].separation, (Vector{-0.5, 0.75, 0.0}));
}

TEST(ReferenceHardSphere, OverlapsAreThePairsThatTouchSomeImage) {
  const Crowd system = crowd(60, 1);
  Pairs expected;
  double smallest = kInfinity;
  for (std::size_t i = 0; i < 60; ++i)
    for (std::size_t j = i + 1; j < 60; ++j) {
      double nearest = kInfinity;
      for (int x = -5; x <= 5; ++x)
        for (int y = -5; y <= 5; ++y)
          for (int z = -5; z <= 5; ++z)
            nearest = std::min(nearest, std::hypot(system.positions[3 * j] - system.positions[3 * i] + x * kBox[0],
                                                   system.positions[3 * j + 1] - system.positions[3 * i + 1] + y * kBox[1],
                                                   system.positions[3 * j + 2] - system.positions[3 * i + 2] + z * kBox[2]));
      smallest = std::min(smallest, nearest - system.radii[i] - system.radii[j]);
      if (nearest < system.radii[i] + system.radii[j]) expected.emplace_back(i, j);
    }
  Pairs found;
  for (const Overlap& pair : overlaps(system.positions, system.radii, kBox)) found.emplace_back(pair.i, pair.j);
  ASSERT_GT(expected.size(), 3u);
  EXPECT_EQ(found, expected);
  EXPECT_NEAR(smallest_gap(system.positions, system.radii, kBox), smallest, 1e-13);
}

TEST(ReferenceHardSphere, FewerThanTwoSpheresHaveNoGapAndNoOverlap) {
  EXPECT_EQ(smallest_gap(Point{}, Point{}, kBox), kInfinity);
  EXPECT_EQ(smallest_gap(Point{1.0, 2.0, 3.0}, Point{0.5}, kBox), kInfinity);
  EXPECT_FALSE(any_overlap(Point{1.0, 2.0, 3.0}, Point{0.5}, kBox));
}

TEST(ReferenceHardSphere, PairsWithinNoReachAreTheOverlapsAndWithinReachTheGapsBelowIt) {
  const Crowd system = crowd(40, 2);
  Pairs touching;
  for (const Overlap& pair : overlaps(system.positions, system.radii, kBox)) touching.emplace_back(pair.i, pair.j);
  EXPECT_EQ(pairs_within(system.positions, system.radii, kBox, 0.0), touching);
  EXPECT_GT(pairs_within(system.positions, system.radii, kBox, 0.5).size(), touching.size());
  const Point apart{0.0, 0.0, 0.0, 1.5, 0.0, 0.0};
  EXPECT_TRUE(pairs_within(apart, Point{0.5, 0.5}, kBox, 0.5).empty());
  EXPECT_EQ(pairs_within(apart, Point{0.5, 0.5}, kBox, 0.5 + 1e-15), (Pairs{{0, 1}}));
}

TEST(ReferenceHardSphere, InputThatDoesNotFitIsRefused) {
  const Point two(6, 0.0);
  EXPECT_THROW(overlaps(two, Point{0.5}, kBox), std::invalid_argument);
  EXPECT_THROW(overlaps(two, Point{0.5, -0.5}, kBox), std::invalid_argument);
  EXPECT_THROW(overlaps(two, Point{0.5, 0.5}, Vector{1.0, 0.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(pairs_within(two, Point{0.5, 0.5}, kBox, -0.1), std::invalid_argument);
}

}  // namespace
