#include "observables/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lanescape {
namespace {

// The mean of all values but one.
double mean_without(const std::vector<double>& values, std::size_t without) {
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (k != without) sum += values[k], ++count;
  return sum / count;
}

TEST(Statistics, TheJackknifeOfAMeanIsItsStandardError) {
  const std::vector<double> values{1.0, 4.0, -2.0, 0.5, 3.0};
  const Estimate direct = estimate_mean(values);
  const Estimate jack = jackknife(values.size(), [&](std::size_t k) { return mean_without(values, k); });
  EXPECT_NEAR(jack.value, direct.value, 1e-15);
  EXPECT_NEAR(jack.error.value(), direct.error.value(), 1e-14);
}

TEST(Statistics, TheJackknifeOfAFunctionIsItsSlopeTimesTheError) {
  std::vector<double> values;
  for (int k = 0; k < 200; ++k) values.push_back(3.0 + 0.1 * std::sin(1.0 + 7.0 * k));
  const Estimate direct = estimate_mean(values);
  const Estimate square = jackknife(values.size(), [&](std::size_t k) { return std::pow(mean_without(values, k), 2); });
  EXPECT_NEAR(square.error.value(), 2.0 * direct.value * direct.error.value(), 1e-3 * square.error.value());
}

TEST(Statistics, OneValueHasNoError) {
  const std::vector<double> values{2.0};
  const Estimate one = jackknife(1, [&](std::size_t k) { return k == 1 ? 2.0 : 0.0; });
  EXPECT_EQ(one.value, 2.0);
  EXPECT_FALSE(one.error.has_value());
  EXPECT_FALSE(estimate_mean(values).error.has_value());
}

}  // namespace
}  // namespace lanescape
