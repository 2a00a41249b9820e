#include "neighbour/cell_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/random.hpp"

namespace lanescape {
namespace {

using Point = std::array<double, 3>;

std::vector<Point> random_points(std::size_t n, const Box& box, std::uint64_t which) {
  const CounterRandom random(1, RandomStream::displacements);
  std::vector<Point> points(n);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t axis = 0; axis < 3; ++axis) points[i][axis] = box.length[axis] * random.uniform(which, i, axis);
  return points;
}

std::vector<std::int32_t> near(const CellGrid& grid, const Point& at) {
  std::vector<std::int32_t> found;
  grid.for_each_near(at, [&](std::int32_t j) { found.push_back(j); });
  std::sort(found.begin(), found.end());
  return found;
}

double distance(const Box& box, const Point& a, const Point& b) {
  double squared = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double d = std::remainder(b[axis] - a[axis], box.length[axis]);
    squared += d * d;
  }
  return std::sqrt(squared);
}

// Checks that every particle closer than `edge` is found, each once. Returns the mean number of particles found.
double expect_no_neighbour_missed(const Box& box, double edge, const CellGrid& grid, const std::vector<Point>& points) {
  double met = 0.0;
  for (const Point& at : points) {
    const auto found = near(grid, at);
    EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
    met += static_cast<double>(found.size()) / static_cast<double>(points.size());
    for (std::size_t j = 0; j < points.size(); ++j)
      EXPECT_TRUE(distance(box, at, points[j]) >= edge ||
                  std::binary_search(found.begin(), found.end(), static_cast<std::int32_t>(j)))
          << j;
  }
  return met;
}

CellGrid filled(const Box& box, double edge, const std::vector<Point>& points) {
  CellGrid grid(box, edge, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) grid.insert(static_cast<std::int32_t>(i), points[i]);
  return grid;
}

TEST(CellGrid, FindsEveryPairNearerThanTheEdge) {
  for (const Box& box : {Box{{9.0, 9.0, 9.0}}, Box{{3.0, 12.5, 7.1}}, Box{{3.3, 3.0, 40.0}}})
    for (const double edge : {1.0, 0.7}) {
      const auto points = random_points(400, box, 1);
      const double met = expect_no_neighbour_missed(box, edge, filled(box, edge, points), points);
      EXPECT_LT(met, 400.0);  // otherwise the grid is useless
    }
}

TEST(CellGrid, MeetsNoMoreThanTwentySevenCellsWorthOfParticles) {
  const Box box{{10.0, 10.0, 10.0}};
  const auto points = random_points(1000, box, 2);
  const double met = expect_no_neighbour_missed(box, 1.0, filled(box, 1.0, points), points);
  EXPECT_NEAR(met, 28.0, 2.0);  // 27 by chance, and the particle itself
}

TEST(CellGrid, HasOneCellAlongAnAxisWithRoomForFewerThanThree) {
  const auto mean_met = [](const Box& box) {
    const auto points = random_points(50, box, 3);
    return expect_no_neighbour_missed(box, 1.0, filled(box, 1.0, points), points);
  };
  EXPECT_EQ(mean_met({{2.9, 2.9, 2.9}}), 50.0);
  for (const Box& box : {Box{{2.9, 30.0, 30.0}}, Box{{30.0, 2.0, 30.0}}, Box{{30.0, 30.0, 0.5}}, Box{{2.9, 30.0, 2.9}}})
    EXPECT_LT(mean_met(box), 40.0);
}

TEST(CellGrid, MeetsAsFewParticlesInALongBoxAsInACube) {
  for (const Box& box : {Box{{220.0, 2.2, 2.2}}, Box{{2.2, 220.0, 2.2}}, Box{{2.2, 2.2, 220.0}}}) {
    const auto points = random_points(610, box, 5);
    EXPECT_LT(expect_no_neighbour_missed(box, 1.1, filled(box, 1.1, points), points), 12.0);
  }
}

TEST(CellGrid, FindsParticlesAgainAfterTheyMoved) {
  const Box box{{8.0, 9.0, 10.0}};
  auto points = random_points(300, box, 4);
  CellGrid grid = filled(box, 1.0, points);
  for (std::uint64_t round = 5; round < 10; ++round) {
    const auto next = random_points(300, box, round);
    for (std::size_t i = round % 3; i < points.size(); i += 3) {
      points[i] = next[i];
      grid.move(static_cast<std::int32_t>(i), points[i]);
    }
    expect_no_neighbour_missed(box, 1.0, grid, points);
  }
}

TEST(CellGrid, PutsUnwrappedPositionsIntoTheirImagesCell) {
  const Box box{{6.0, 6.0, 6.0}};
  CellGrid grid(box, 1.0, 100);  // a grid for few particles would have few cells
  grid.insert(0, {0.5, 0.5, 0.5});
  EXPECT_EQ(near(grid, {0.5 - 18.0, 0.5 + 6.0, 5.9}), std::vector<std::int32_t>{0});
  EXPECT_TRUE(near(grid, {3.0, 0.5, 0.5}).empty());
  grid.insert(1, {-0.1, 12.2, 6.0});  // exactly on the face
  EXPECT_EQ(near(grid, {0.5, 0.5, 0.5}), (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(near(grid, {-1e-20, -1e-20, -1e-20}), (std::vector<std::int32_t>{0, 1}));
}

}  // namespace
}  // namespace lanescape
