#include "neighbour/closed_gaps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.hpp"

namespace lanescape {
namespace {

std::vector<double> narrowed(const std::vector<double>& x, const ClosedGaps& closed) {
  std::vector<double> moved;
  for (std::size_t i = 0; i < x.size(); ++i) moved.push_back(x[i] + closed.shifts[i]);
  return moved;
}

double separation(double a, double b, double length) { return std::abs(std::remainder(b - a, length)); }

// Pairs nearer than `least` keep their separation and no others come as near.
void expect_near_pairs_unchanged(const std::vector<double>& x, double length, double least) {
  const ClosedGaps closed = close_gaps(x, length, least);
  const std::vector<double> moved = narrowed(x, closed);
  const double rounding = 1e-14 * length;
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_GE(moved[i], -rounding);
    EXPECT_LE(moved[i], closed.length + rounding);
    for (std::size_t j = 0; j < i; ++j) {
      const double before = separation(x[i], x[j], length), after = separation(moved[i], moved[j], closed.length);
      if (before < 0.5 * least)
        EXPECT_NEAR(after, before, rounding) << x[i] << " and " << x[j];
      else
        EXPECT_GE(after, 0.5 * least - rounding) << x[i] << " and " << x[j];
    }
  }
}

TEST(ClosedGaps, NarrowsAHugeBoxToADroplet) {
  for (const double length : {1e3, 1e9, 1e30, 1e90}) {
    const ClosedGaps closed = close_gaps({0.0, 1.0, 2.5, 4.0}, length, 2.0);
    EXPECT_EQ(closed.length, 6.0) << length;
    EXPECT_EQ(narrowed({0.0, 1.0, 2.5, 4.0}, closed), (std::vector<double>{0.0, 1.0, 2.5, 4.0})) << length;
  }
}

TEST(ClosedGaps, LeavesCoordinatesWithoutWideGapsAsTheyAre) {
  std::vector<double> x;
  for (int i = 0; i < 50; ++i) x.push_back(i + 0.25);
  const ClosedGaps closed = close_gaps(x, 50.0, 2.0);
  EXPECT_EQ(closed.length, 50.0);
  const double shift = closed.shifts.front();
  EXPECT_TRUE(std::all_of(closed.shifts.begin(), closed.shifts.end(), [&](double s) { return s == shift; }));
}

TEST(ClosedGaps, KeepsNegativeCoordinatesInAHugeBox) {
  const std::vector<double> x = {-1.5, 0.25, 1.0};
  const ClosedGaps closed = close_gaps(x, 1e30, 4.0);
  const std::vector<double> moved = narrowed(x, closed);
  EXPECT_EQ(moved[1] - moved[0], 1.75);
  EXPECT_EQ(moved[2] - moved[1], 0.75);
  EXPECT_EQ(closed.boxes, (std::vector<double>{0.0, 0.0, 0.0}));
}

TEST(ClosedGaps, CountsTheBoxesOfUnwrappedCoordinates) {
  const ClosedGaps closed = close_gaps({1.0, 101.5, -198.0}, 100.0, 4.0);
  EXPECT_EQ(closed.boxes, (std::vector<double>{0.0, -1.0, 2.0}));
  EXPECT_EQ(narrowed({1.0, 101.5, -198.0}, closed), (std::vector<double>{0.0, 0.5, 1.0}));
}

TEST(ClosedGaps, KeepsNearPairsOfClustersApart) {
  const CounterRandom random(1, RandomStream::displacements);
  for (std::uint64_t which = 0; which < 60; ++which) {
    const double length = std::pow(10.0, 1.0 + 5.0 * random.uniform(which, 0, 0));
    std::vector<double> x;
    const std::uint32_t clusters = 1 + static_cast<std::uint32_t>(which % 5);
    for (std::uint32_t c = 1; c <= clusters; ++c) {
      const double centre = length * random.uniform(which, c, 1);  // some clusters straddle a face, some are boxes away
      for (std::uint32_t k = 0; k < 12; ++k)
        x.push_back(centre + 6.0 * random.uniform(which, 100 * c + k, 2) +
                    length * static_cast<double>(k % 3) * static_cast<double>(which % 2));
    }
    expect_near_pairs_unchanged(x, length, 2.0);
  }
}

TEST(ClosedGaps, KeepsStretchesOfAnOpenAxisWhereverTheyAre) {
  for (const double origin : {-1e9, -3.0, 0.0, 5e8}) {
    const std::vector<double> x = {origin + 4.0, origin, origin + 1.5, origin + 1e3, origin + 1e3 + 0.5};
    const ClosedGaps closed = close_open_gaps(x, 2.5);
    EXPECT_EQ(narrowed(x, closed), (std::vector<double>{4.0, 0.0, 1.5, 6.5, 7.0})) << origin;
    EXPECT_EQ(closed.boxes, std::vector<double>(5, 0.0));
    EXPECT_EQ(closed.length, 9.5);
  }
  EXPECT_EQ(close_open_gaps({}, 2.5).shifts.size(), 0U);
  EXPECT_EQ(close_open_gaps({7.0}, 2.5).shifts, (std::vector<double>{-7.0}));
}

TEST(ClosedGaps, NarrowsToWhatTheClustersNeed) {
  std::vector<double> x;
  for (const double centre : {3e3, 4e6, 4.0001e6, 9e8})
    for (int k = 0; k < 10; ++k) x.push_back(centre + k);
  EXPECT_LT(close_gaps(x, 1e9, 3.0).length, 4.0 * (9.0 + 3.0) + 1e-6);
}

}  // namespace
}  // namespace lanescape
