#include "neighbour/sorted_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/random.hpp"

namespace lanescape {
namespace {

using Point = std::array<double, 3>;

// Points in the box or, if `boxes` is above 0, up to that many boxes away.
Configuration random_points(std::size_t n, const Box& box, std::uint64_t which, double boxes = 0.0) {
  const CounterRandom random(1, RandomStream::displacements);
  Configuration points{box, std::vector<int>(n, 0), {}};
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const double image = std::nearbyint(boxes * (2.0 * random.uniform(which, i, 3 + axis) - 1.0));
      points.positions.push_back(box.length[axis] * (random.uniform(which, i, axis) + image));
    }
  return points;
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Pairs pairs_of(const SortedCells& cells) {
  Pairs found;
  cells.for_each_pair([&](std::uint32_t i, std::uint32_t j, double) { found.emplace_back(std::min(i, j), std::max(i, j)); });
  std::sort(found.begin(), found.end());
  return found;
}

double distance(const Box& box, const Point& a, const Point& b) {
  double squared = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double d = box.periodic[axis] ? std::remainder(b[axis] - a[axis], box.length[axis]) : b[axis] - a[axis];
    squared += d * d;
  }
  return std::sqrt(squared);
}

Pairs pairs_within(const Configuration& points, double reach) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    for (std::uint32_t j = i + 1; j < points.size(); ++j)
      if (distance(points.box, points.position(i), points.position(j)) < reach) pairs.emplace_back(i, j);
  return pairs;
}

void expect_those_within_reach(const Configuration& points, double reach) {
  EXPECT_EQ(pairs_of(SortedCells(points, reach)), pairs_within(points, reach)) << points.size() << ", reach " << reach;
}

TEST(SortedCells, FindsEachPairWithinReachOnceAndNoOther) {
  for (const Box& box : {Box{{9.0, 9.0, 9.0}}, Box{{3.0, 12.5, 7.1}}, Box{{3.3, 3.0, 40.0}}, Box{{1.5, 30.0, 30.0}},
                         Box{{30.0, 1.5, 30.0}}, Box{{30.0, 30.0, 1.5}}, Box{{1.5, 1.5, 90.0}}, Box{{90.0, 1.5, 1.5}}})
    for (const double reach : {0.05, 0.7, 1.0, 1.4}) expect_those_within_reach(random_points(400, box, 1), reach);
}

TEST(SortedCells, ReachesOverTheWholeBoxWhereItIsSmall) {
  for (const Box& box : {Box{{2.9, 2.9, 2.9}}, Box{{2.0, 30.0, 2.0}}})
    for (const double reach : {1.0, 1.45, 40.0}) expect_those_within_reach(random_points(60, box, 2), reach);
}

TEST(SortedCells, TakesUnwrappedPositions) { expect_those_within_reach(random_points(400, {{8.0, 6.0, 7.0}}, 3, 5.0), 1.0); }

TEST(SortedCells, TakesOpenAxesAndPointsOutsideTheirFaces) {
  for (const Box& box : {Box{{8.0, 6.0, 7.0}, {false, true, true}}, Box{{8.0, 6.0, 7.0}, {true, false, false}},
                         Box{{2.0, 6.0, 30.0}, {false, false, false}}, Box{{9.0, 1e9, 9.0}, {false, true, false}}})
    for (const double boxes : {0.0, 1.0, 40.0}) {
      Configuration points = random_points(400, box, 8, boxes);
      for (std::size_t k = 0; k < 30; ++k) points.positions[k] = k % 2 == 0 ? 0.01 * static_cast<double>(k) : box.length[k % 3];
      for (const double reach : {0.5, 1.0}) expect_those_within_reach(points, reach);
    }
}

TEST(SortedCells, MissesNothingAMillionBoxesAway) {
  const Configuration points = random_points(400, {{8.0, 6.0, 7.0}}, 4, 1e6);
  const Pairs found = pairs_of(SortedCells(points, 1.0)), wanted = pairs_within(points, 1.0);
  EXPECT_GT(wanted.size(), 500U);
  EXPECT_TRUE(std::includes(found.begin(), found.end(), wanted.begin(), wanted.end()));
}

TEST(SortedCells, SaysHowFarApartAPairIsToWithinItsMargin) {
  const Configuration points = random_points(400, {{8.0, 6.0, 7.0}}, 5, 1e6);
  const SortedCells cells(points, 1.0);
  EXPECT_LT(cells.margin(), 1e-7);
  cells.for_each_pair([&](std::uint32_t i, std::uint32_t j, double squared) {
    EXPECT_NEAR(std::sqrt(squared), distance(points.box, points.position(i), points.position(j)), 0.5 * cells.margin());
  });
}

TEST(SortedCells, TakesFewPointsAndPointsInOnePlace) {
  for (const std::size_t n : {0U, 1U, 2U, 3U}) expect_those_within_reach(random_points(n, {{5.0, 6.0, 7.0}}, 6), 1.0);
  const Configuration points{{{5.0, 6.0, 7.0}}, {0, 0, 0}, {5.0, 6.0, 7.0, 0.0, 0.0, 0.0, -5.0, 12.0, -1e-20}};
  EXPECT_EQ(pairs_of(SortedCells(points, 0.1)), (Pairs{{0, 1}, {0, 2}, {1, 2}}));
}

TEST(SortedCells, FindsOtherPairsAllTheSameWhereSomePointsAreNotNumbers) {
  const Configuration points = random_points(300, {{5.0, 6.0, 7.0}}, 7);
  Configuration broken = points;
  broken.positions[4] = std::numeric_limits<double>::quiet_NaN();
  broken.positions[9] = std::numeric_limits<double>::infinity();
  Pairs wanted = pairs_of(SortedCells(points, 1.0)), found = pairs_of(SortedCells(broken, 1.0));
  const auto broken_one = [](const auto& pair) {
    return pair.first == 1 || pair.second == 1 || pair.first == 3 || pair.second == 3;
  };
  for (Pairs* pairs : {&wanted, &found}) std::erase_if(*pairs, broken_one);
  EXPECT_EQ(found, wanted);
}

TEST(SortedCells, RefusesPointsOfASparseBoxThatAreNotNumbers) {
  Configuration broken = random_points(10, {{5.0, 6.0, 7.0}}, 7);
  broken.positions[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SortedCells(broken, 1.0), Error);
}

TEST(SortedCells, GivesTheNumbersItWasGiven) {
  const SortedCells cells({{5.0, 5.0, 5.0}}, 1.0, {{{1.0, 1.0, 1.0}, 70}, {{1.5, 1.0, 1.0}, 3}, {{3.0, 3.0, 3.0}, 4}});
  EXPECT_EQ(pairs_of(cells), (Pairs{{3, 70}}));
}

TEST(SortedCells, ComparesWithTheOthersInTwentySevenCellsOfAboutOnePointOrOfTheReach) {
  EXPECT_NEAR(SortedCells::mean_candidates({{30.0, 30.0, 30.0}}, 0.3, 27'000), 27.0, 4.0);
  EXPECT_NEAR(SortedCells::mean_candidates({{30.0, 30.0, 30.0}}, 2.0, 27'000), 27.0 * 8.0, 100.0);
  EXPECT_EQ(SortedCells::mean_candidates({{5.0, 5.0, 5.0}}, 2.0, 108), 108.0);
}

}  // namespace
}  // namespace lanescape
