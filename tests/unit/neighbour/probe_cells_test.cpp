#include "neighbour/probe_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.hpp"

namespace lanescape {
namespace {

using Point = ProbeCells::Point;

std::vector<Point> random_points(std::size_t n, const Box& box, std::uint64_t which) {
  const CounterRandom random(1, RandomStream::displacements);
  std::vector<Point> points(n);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t axis = 0; axis < 3; ++axis) points[i][axis] = box.length[axis] * random.uniform(which, i, axis);
  return points;
}

// All points in the grid, cell by cell; each must be inside its cell.
std::vector<Point> points_in(const ProbeCells& cells) {
  const kernels::ProbeSpecies view = cells.view();
  std::vector<Point> points;
  for (std::size_t column = 0; column < view.cells[0] * view.cells[1]; ++column)
    for (std::size_t cell = 0; cell < view.cells[2]; ++cell) {
      const std::uint32_t* first = view.first + column * (view.cells[2] + 1) + cell;
      for (std::uint32_t k = first[0]; k < first[1]; ++k) {
        points.push_back({view.x[k], view.y[k], view.z[k]});
        const std::size_t at[3] = {column / view.cells[1], column % view.cells[1], cell};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double low = view.low[axis] + static_cast<double>(at[axis]) * view.edge[axis];
          EXPECT_GE(points.back()[axis], low - 1e-12);
          EXPECT_LE(points.back()[axis], low + view.edge[axis] + 1e-12);
        }
      }
    }
  std::sort(points.begin(), points.end());
  return points;
}

// Brute force over every shift.
std::vector<Point> images_of(const std::vector<Point>& points, const Box& box, double reach) {
  std::vector<Point> images;
  for (const Point& p : points)
    for (int a = -9; a <= 9; ++a)
      for (int b = -9; b <= 9; ++b)
        for (int c = -9; c <= 9; ++c) {
          const Point q = {p[0] + a * box.length[0], p[1] + b * box.length[1], p[2] + c * box.length[2]};
          bool inside = true;
          for (std::size_t axis = 0; axis < 3; ++axis) inside = inside && q[axis] >= -reach && q[axis] <= box.length[axis] + reach;
          if (inside) images.push_back(q);
        }
  std::sort(images.begin(), images.end());
  return images;
}

const std::vector<Box> boxes = {{{7.0, 8.0, 9.0}}, {{0.7, 0.9, 1.1}}, {{12.0, 1.5, 4.0}}};

TEST(ProbeCells, HoldEveryPointAndImageWithinReachOnceInItsCell) {
  for (const Box& box : boxes)
    for (const std::size_t n : {0U, 1U, 5U, 60U}) {
      const std::vector<Point> points = random_points(n, box, n);
      ProbeCells cells(box, 2.5, n);
      cells.assign(points);
      EXPECT_EQ(cells.size(), n);
      EXPECT_EQ(points_in(cells), images_of(points, box, 2.5));
    }
}

TEST(ProbeCells, PutInAndTakenOutOneByOneHoldTheSameAsAssigned) {
  for (const Box& box : boxes) {
    const std::vector<Point> points = random_points(150, box, 7);
    // The grid is sized for one point, so columns overflow.
    ProbeCells cells(box, 2.5, 1);
    for (const Point& p : points) cells.insert(p);
    EXPECT_EQ(cells.size(), points.size());
    EXPECT_EQ(points_in(cells), images_of(points, box, 2.5));
    for (std::size_t k = 0; k < 100; ++k) EXPECT_TRUE(cells.remove(points[k]));
    EXPECT_EQ(cells.size(), 50U);
    EXPECT_EQ(points_in(cells), images_of({points.begin() + 100, points.end()}, box, 2.5));
    EXPECT_FALSE(cells.remove(points[0]));
    EXPECT_EQ(cells.size(), 50U);
  }
}

TEST(ProbeCells, UnwrappedPointsAreBroughtIntoTheBox) {
  const Box box{{7.0, 8.0, 9.0}};
  ProbeCells wrapped(box, 2.5, 1), unwrapped(box, 2.5, 1);
  wrapped.assign({{1.0, 2.0, 3.0}});
  unwrapped.assign({{1.0 - 14.0, 2.0 + 8.0, 3.0 + 45.0}});
  EXPECT_EQ(points_in(wrapped), points_in(unwrapped));
}

}  // namespace
}  // namespace lanescape
