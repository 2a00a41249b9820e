#include "observables/fits/line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/error.hpp"

namespace lanescape {
namespace {

TEST(Line, HasTheLeastSumOfSquares) {
  const std::vector<double> x{0.0, 1.0, 2.0, 3.0}, y{1.0, 3.0, 4.0, 8.0};
  const Line line = fit_line(x, y);
  // Sums by hand: xx 5, xy 11; residuals 0.7, 0.5, -0.7, ... about y = 2.2 x + 0.7.
  EXPECT_NEAR(line.slope.value, 2.2, 1e-14);
  EXPECT_NEAR(line.intercept.value, 0.7, 1e-14);
  EXPECT_NEAR(line.squares, 0.09 + 0.01 + 1.21 + 0.49, 1e-13);
  EXPECT_NEAR(line.slope.error.value(), std::sqrt(0.9 / 5.0), 1e-13);
  EXPECT_NEAR(line.intercept.error.value(), std::sqrt(0.9 * (0.25 + 2.25 / 5.0)), 1e-13);
}

TEST(Line, AnUncertainPointCountsForLess) {
  const std::vector<double> x{0.0, 1.0, 2.0}, y{0.0, 1.0, 5.0}, errors{0.1, 0.1, 1e6};
  const Line line = fit_line(x, y, errors);
  EXPECT_NEAR(line.slope.value, 1.0, 1e-9);
  EXPECT_NEAR(line.slope.error.value(), 0.1 * std::sqrt(2.0), 1e-9);
}

TEST(Line, TwoPointsHaveNoErrorAndOneStateNoLine) {
  EXPECT_FALSE(fit_line(std::vector{0.0, 1.0}, std::vector{1.0, 3.0}).slope.error);
  EXPECT_THROW(fit_line(std::vector{1.0, 1.0}, std::vector{1.0, 3.0}), Error);
  EXPECT_THROW(fit_line(std::vector{1.0}, std::vector{1.0}), Error);
}

}  // namespace
}  // namespace lanescape
