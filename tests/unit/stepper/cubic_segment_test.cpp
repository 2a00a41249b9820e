#include "stepper/cubic_segment.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lanescape {
namespace {

// The values and slopes of a cubic at the ends of 0 ... 1.
CubicSegment of(double a, double b, double c, double d) { return {a, a + b + c + d, b, b + 2.0 * c + 3.0 * d}; }

TEST(CubicSegment, IsExactForCubics) {
  const CubicSegment segment = of(1.0, -2.0, 3.0, 0.5);
  for (const double x : {0.0, 0.3, 0.5, 1.0}) EXPECT_NEAR(segment.at(x), 1.0 + x * (-2.0 + x * (3.0 + x * 0.5)), 1e-14);
}

TEST(CubicSegment, FindsItsMaximumInsideOrAtAnEnd) {
  // x (1 - x)^2 has its maximum 4/27 at 1/3; reversed it is at 2/3.
  EXPECT_NEAR(of(0.0, 1.0, -2.0, 1.0).maximum().x, 1.0 / 3.0, 1e-14);
  EXPECT_NEAR(of(0.0, 1.0, -2.0, 1.0).maximum().value, 4.0 / 27.0, 1e-14);
  EXPECT_NEAR(of(0.0, 0.0, 1.0, -1.0).maximum().x, 2.0 / 3.0, 1e-14);
  EXPECT_NEAR(of(0.0, 1.0, -1.0, 0.0).maximum().x, 0.5, 1e-14);  // a parabola
  EXPECT_EQ(of(2.0, -1.0, 0.0, 0.0).maximum().x, 0.0);
  EXPECT_EQ(of(2.0, 1.0, 0.0, 0.0).maximum().value, 3.0);
  EXPECT_EQ(of(1.0, 0.0, 0.0, 0.0).maximum().value, 1.0);
  EXPECT_EQ(of(0.0, -1.0, 1.0, 0.0).maximum().value, 0.0);  // a minimum between equal ends
}

TEST(CubicSegment, FindsWhereItCrossesALevel) {
  EXPECT_NEAR(of(0.0, 0.0, 0.0, 1.0).crossing(0.125), 0.5, 1e-6);
  EXPECT_NEAR(of(1.0, -1.0, 0.0, 0.0).crossing(0.75), 0.25, 1e-6);
}

}  // namespace
}  // namespace lanescape
