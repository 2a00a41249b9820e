#include "interaction/state/cubic_spline.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "interaction/state/local_density.hpp"

namespace lanescape {
namespace {

double cubic(double x) { return 0.3 * x * x * x - 1.1 * x * x + 0.4 * x + 2.0; }
double cubic_slope(double x) { return 0.9 * x * x - 2.2 * x + 0.4; }

UniformSpline sampled(double (*f)(double), double first, double spacing, int count, std::optional<double> start,
                      std::optional<double> end) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(f(first + k * spacing));
  return {first, spacing, values, start, end};
}

TEST(CubicSpline, IsACubicWhereItIsGivenOne) {
  const UniformSpline spline = sampled(cubic, 0.5, 0.25, 9, cubic_slope(0.5), cubic_slope(2.5));
  for (double x = 0.5; x <= 2.5; x += 0.0625) {
    EXPECT_NEAR(spline.value(x), cubic(x), 1e-14) << x;
    EXPECT_NEAR(spline.slope(x), cubic_slope(x), 1e-14) << x;
  }
}

TEST(CubicSpline, HasContinuousSecondDerivativesAndNoneAtAFreeEnd) {
  const UniformSpline spline = sampled([](double x) { return std::exp(-x) * std::cos(3.0 * x); }, 0.0, 0.3, 8, std::nullopt, 0.0);
  for (std::size_t k = 1; k < spline.intervals(); ++k) {
    const auto &before = spline.piece(k - 1), &after = spline.piece(k);
    EXPECT_NEAR(before[3] + before[0] + before[1] + before[2], after[3], 1e-15);
    EXPECT_NEAR(before[0] + 2.0 * before[1] + 3.0 * before[2], after[0], 1e-15);
    EXPECT_NEAR(before[1] + 3.0 * before[2], after[1], 1e-15);
  }
  EXPECT_NEAR(spline.piece(0)[1], 0.0, 1e-15);
  const auto& last = spline.piece(spline.intervals() - 1);
  EXPECT_NEAR(last[0] + 2.0 * last[1] + 3.0 * last[2], 0.0, 1e-15);
}

TEST(CubicSpline, GoesOnAlongAStraightLine) {
  UniformSpline spline = sampled(cubic, 0.5, 0.25, 9, std::nullopt, std::nullopt);
  const double value = spline.value(0.5), slope = spline.slope(0.5);
  spline.extend_down_to(0.0);
  EXPECT_LE(spline.first_knot(), 0.0);
  EXPECT_DOUBLE_EQ(spline.first_knot() + static_cast<double>(spline.intervals()) * spline.spacing(), 2.5);
  for (const double x : {0.0, 0.1, 0.3, 0.5}) {
    EXPECT_NEAR(spline.value(x), value + slope * (x - 0.5), 1e-14);
    EXPECT_NEAR(spline.slope(x), slope, 1e-14);
  }
  EXPECT_NEAR(spline.value(1.7), sampled(cubic, 0.5, 0.25, 9, std::nullopt, std::nullopt).value(1.7), 1e-14);
}

TEST(SwitchingFunction, IsWithinItsStatedErrorOfTanh) {
  double worst = 0.0;
  const SwitchingFunction w = SwitchingFunction::tapered_tanh(1.5, 0.15, 2.5);
  for (double r = 0.5; r < 2.5; r += 1.37e-4) {
    const double s = std::max(0.0, (r - 2.0) / 0.5);
    const double exact = 0.5 * (1.0 - std::tanh((r - 1.5) / 0.15)) * (1.0 - s * s * s * (10.0 - 15.0 * s + 6.0 * s * s));
    worst = std::max(worst, std::abs(w.value(r) - exact));
  }
  EXPECT_LT(worst, 2e-9);
  EXPECT_GT(worst, 1e-11);  // the spline is not exact
  EXPECT_EQ(w.value(2.5), 0.0);
}

TEST(SwitchingFunction, HasTheSlopeOfItsValues) {
  const SwitchingFunction w = SwitchingFunction::tapered_tanh(1.5, 0.15, 2.5);
  for (const double r : {0.9, 1.2, 1.51, 1.8, 2.2, 2.45}) {
    const double h = 1e-4;
    const double difference = (w.value(r + h) - w.value(r - h)) / (2.0 * h);
    EXPECT_NEAR(w.slope(r), difference, 2e-5 * std::abs(w.slope(r)) + 1e-9) << r;
  }
}

}  // namespace
}  // namespace lanescape
