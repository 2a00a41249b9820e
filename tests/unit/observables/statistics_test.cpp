#include "observables/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.hpp"

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

// Normal numbers around 5, of width 2.
std::vector<double> normal_values(std::size_t count, std::uint64_t seed) {
  const CounterRandom random(seed, RandomStream::monte_carlo);
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k) values.push_back(5.0 + 2.0 * random.normal(k, 0));
  return values;
}

SampleFunctions mean_and_largest(const std::vector<double>& values) {
  return [&](std::span<const std::uint32_t> rows, std::span<double> results) {
    double sum = 0.0, largest = values[rows[0]];
    for (const std::uint32_t row : rows) sum += values[row], largest = std::max(largest, values[row]);
    results[0] = sum / static_cast<double>(rows.size());
    results[1] = largest;
  };
}

TEST(Statistics, TheBootstrapIntervalOfAMeanIsTwoStandardErrorsToEachSide) {
  const std::vector<double> values = normal_values(400, 1);
  const Estimate mean = estimate_mean(values);
  const auto intervals = bootstrap_intervals(values.size(), 2, mean_and_largest(values), {});
  EXPECT_NEAR(intervals[0]->low, mean.value - 1.96 * *mean.error, 0.1 * *mean.error);
  EXPECT_NEAR(intervals[0]->high, mean.value + 1.96 * *mean.error, 0.1 * *mean.error);
  EXPECT_EQ(intervals[1]->high, *std::max_element(values.begin(), values.end()));
}

TEST(Statistics, NineteenOfTwentyBootstrapIntervalsHoldTheTrueMean) {
  int holds = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const std::vector<double> values = normal_values(40, seed);
    const auto interval = bootstrap_intervals(40, 2, mean_and_largest(values), {.resamples = 400})[0];
    holds += interval->low < 5.0 && 5.0 < interval->high;
  }
  EXPECT_NEAR(holds / 400.0, 0.94, 0.03);  // percentile intervals of 40 values are a little too narrow
}

TEST(Statistics, BootstrapIntervalsAreTheSameOnAnyNumberOfThreads) {
  const std::vector<double> values = normal_values(30, 2);
  const auto one = bootstrap_intervals(30, 2, mean_and_largest(values), {.threads = 1});
  const auto three = bootstrap_intervals(30, 2, mean_and_largest(values), {.threads = 3});
  const auto other = bootstrap_intervals(30, 2, mean_and_largest(values), {.seed = 2});
  for (std::size_t f = 0; f < 2; ++f) {
    EXPECT_EQ(one[f]->low, three[f]->low);
    EXPECT_EQ(one[f]->high, three[f]->high);
  }
  EXPECT_NE(one[0]->low, other[0]->low);
}

TEST(Statistics, NoIntervalFollowsFromOneRowOrFromNoValue) {
  const auto nothing = [](std::span<const std::uint32_t>, std::span<double>) {};
  EXPECT_FALSE(bootstrap_intervals(1, 1, [](auto, auto results) { results[0] = 1.0; }, {})[0]);
  EXPECT_FALSE(bootstrap_intervals(5, 1, nothing, {})[0]);
}

TEST(Statistics, AWeightedMeanTakesItsErrorFromThoseOfTheValuesIfAllHaveOne) {
  const std::vector<WeightedValue> values{{1.0, 0.3, 1.0}, {2.0, 0.1, 3.0}};
  const Estimate mean = weighted_mean(values);
  EXPECT_DOUBLE_EQ(mean.value, 1.75);
  EXPECT_DOUBLE_EQ(mean.error.value(), std::sqrt(0.09 + 0.09) / 4.0);
  const std::vector<WeightedValue> one{{1.5, 0.2, 7.0}};
  EXPECT_EQ(weighted_mean(one).error, 0.2);
}

TEST(Statistics, AWeightedMeanOfValuesWithoutErrorsTakesItFromTheirScatter) {
  const std::vector<WeightedValue> values{{1.0, std::nullopt, 2.0}, {4.0, 0.1, 2.0}, {1.0, std::nullopt, 2.0}};
  const Estimate mean = weighted_mean(values);
  EXPECT_DOUBLE_EQ(mean.value, 2.0);
  EXPECT_DOUBLE_EQ(mean.error.value(), estimate_mean(std::vector<double>{1.0, 4.0, 1.0}).error.value());
  EXPECT_FALSE(weighted_mean(std::vector<WeightedValue>{{1.0, std::nullopt, 2.0}}).error);
}

}  // namespace
}  // namespace lanescape
