#include "observables/time_correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace lanescape {
namespace {

struct Shape {
  std::size_t records, lags;
};

TEST(TimeCorrelation, IsTheDoubleSumOverOriginsWithAFullWindow) {
  const std::size_t row = 7, first = 2, count = 4;
  std::mt19937_64 random(1);
  std::normal_distribution<float> normal;
  for (const auto [records, lags] :
       {Shape{1, 0}, Shape{2, 1}, Shape{30, 7}, Shape{97, 96}, Shape{120, 60}, Shape{251, 13}, Shape{1024, 300}}) {
    std::vector<float> values(records * row);
    for (float& value : values) value = 0.25f + normal(random);  // a nonzero mean makes circular sums visible
    const std::vector<double> correlation = full_window_correlation({values.data(), records, row, first, count}, lags);
    ASSERT_EQ(correlation.size(), lags + 1);
    for (std::size_t k = 0; k <= lags; ++k) {
      double sum = 0.0;
      for (std::size_t t = 0; t < records - lags; ++t)
        for (std::size_t c = first; c < first + count; ++c)
          sum += static_cast<double>(values[t * row + c]) * values[(t + k) * row + c];
      EXPECT_NEAR(correlation[k], sum, 1e-13 * (1.0 + correlation[0])) << "records " << records << ", lag " << k;
    }
  }
}

TEST(TimeCorrelation, NoSeriesGiveZero) {
  const std::vector<float> values(20, 1.0f);
  for (const double c : full_window_correlation({values.data(), 10, 2, 2, 0}, 4)) EXPECT_EQ(c, 0.0);
}

TEST(TimeCorrelation, SimpsonIsExactForCubicsFromTheSecondIntervalOn) {
  const double h = 0.3;
  const auto f = [](double x) { return 2.0 - x + 0.7 * x * x - 0.4 * x * x * x; };
  const auto primitive = [](double x) { return 2.0 * x - x * x / 2.0 + 0.7 * x * x * x / 3.0 - 0.1 * x * x * x * x; };
  for (const std::size_t size : {3, 4, 5, 6, 11, 12}) {
    std::vector<double> values;
    for (std::size_t k = 0; k < size; ++k) values.push_back(f(h * static_cast<double>(k)));
    const std::vector<double> integral = running_simpson(values, h);
    ASSERT_EQ(integral.size(), size);
    EXPECT_EQ(integral[0], 0.0);
    for (std::size_t k = 2; k < size; ++k)
      EXPECT_NEAR(integral[k], primitive(h * static_cast<double>(k)), 1e-14) << size << " values, " << k;
  }
}

TEST(TimeCorrelation, SimpsonsFirstIntervalIsExactForQuadratics) {
  const std::vector<double> squares{1.0, 4.0, 9.0, 16.0};  // (1 + x)^2
  EXPECT_NEAR(running_simpson(squares, 1.0)[1], 7.0 / 3.0, 1e-15);
  EXPECT_NEAR(running_simpson(std::vector<double>{1.0, 4.0}, 2.0)[1], 5.0, 1e-15);
  EXPECT_EQ(running_simpson(std::vector<double>{3.0}, 1.0), std::vector<double>{0.0});
}

TEST(TimeCorrelation, SimpsonsErrorFallsWithTheFourthPowerOfTheSpacing) {
  const auto error = [](std::size_t intervals) {
    const double h = 2.0 / static_cast<double>(intervals);
    std::vector<double> values;
    for (std::size_t k = 0; k <= intervals; ++k) values.push_back(std::exp(-h * static_cast<double>(k)));
    return std::abs(running_simpson(values, h).back() - (1.0 - std::exp(-2.0)));
  };
  EXPECT_NEAR(error(20) / error(40), 16.0, 0.5);
  EXPECT_NEAR(error(21) / error(43), std::pow(43.0 / 21.0, 4), 1.5);
}

}  // namespace
}  // namespace lanescape
