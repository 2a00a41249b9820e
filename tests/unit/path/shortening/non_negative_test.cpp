#include "path/shortening/non_negative.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace lanescape {
namespace {

using Columns = std::vector<std::vector<double>>;

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

std::vector<double> rest(const Columns& columns, const std::vector<double>& x, std::vector<double> b) {
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (std::size_t k = 0; k < b.size(); ++k) b[k] -= x[c] * columns[c][k];
  return b;
}

std::vector<double> solved(const Columns& columns, const std::vector<double>& b) {
  std::vector<double> gram, projections;
  for (const auto& a : columns) {
    projections.push_back(product(a, b));
    for (const auto& other : columns) gram.push_back(product(a, other));
  }
  return non_negative_least_squares(gram, projections);
}

Columns random_columns(std::mt19937& engine, std::size_t columns, std::size_t rows) {
  std::normal_distribution<double> normal;
  Columns result(columns, std::vector<double>(rows));
  for (auto& column : result)
    for (double& value : column) value = normal(engine);
  return result;
}

// Steps along one multiplier at a time, shorter and shorter; no linear algebra. The function is convex.
double brute_force(const Columns& columns, const std::vector<double>& b) {
  std::vector<double> centre(columns.size(), 1.0);
  const auto first = rest(columns, centre, b);
  double width = 4.0, best = product(first, first);
  for (int round = 0; round < 400; ++round) {
    bool better = false;
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (const double change : {-width, width}) {
        std::vector<double> trial = centre;
        trial[c] = std::max(0.0, trial[c] + change);
        const auto left = rest(columns, trial, b);
        if (product(left, left) >= best) continue;
        best = product(left, left);
        centre = trial;
        better = true;
      }
    if (!better) width *= 0.7;
  }
  return best;
}

TEST(NonNegativeLeastSquares, FindsWhatBruteForceFinds) {
  std::mt19937 engine(5);
  for (int sample = 0; sample < 40; ++sample) {
    const Columns columns = random_columns(engine, 1 + static_cast<std::size_t>(sample) % 5, 6);
    const std::vector<double> b = random_columns(engine, 1, 6).front();
    const std::vector<double> x = solved(columns, b);
    for (const double value : x) EXPECT_GE(value, 0.0);
    const auto left = rest(columns, x, b);
    EXPECT_NEAR(product(left, left), brute_force(columns, b), 1e-7 * product(b, b));
  }
}

TEST(NonNegativeLeastSquares, MeetsTheKuhnTuckerConditionsWithManyColumns) {
  std::mt19937 engine(7);
  for (const std::size_t count : {20u, 80u, 200u}) {  // more columns than rows among them: many depend on others
    const Columns columns = random_columns(engine, count, 60);
    const std::vector<double> b = random_columns(engine, 1, 60).front();
    const std::vector<double> x = solved(columns, b);
    const auto left = rest(columns, x, b);
    for (std::size_t c = 0; c < count; ++c) {
      EXPECT_GE(x[c], 0.0);
      const double slope = product(columns[c], left);
      EXPECT_LE(slope, 1e-9);
      if (x[c] > 0.0) {
        EXPECT_NEAR(slope, 0.0, 1e-9);
      }
    }
  }
}

TEST(NonNegativeLeastSquares, RecoversAPositiveCombinationEvenOfRepeatedColumns) {
  std::mt19937 engine(9);
  Columns columns = random_columns(engine, 4, 10);
  columns.push_back(columns[1]);
  std::vector<double> b(10, 0.0);
  for (std::size_t k = 0; k < 10; ++k) b[k] = 2.0 * columns[1][k] + 0.5 * columns[3][k];
  const std::vector<double> x = solved(columns, b);
  EXPECT_NEAR(x[1] + x[4], 2.0, 1e-9);
  EXPECT_NEAR(x[3], 0.5, 1e-9);
  EXPECT_NEAR(x[0] + x[2], 0.0, 1e-9);
}

TEST(NonNegativeLeastSquares, LeavesEverythingAtZeroWhereAllColumnsPointAway) {
  EXPECT_EQ(solved({{-1.0, 0.0}, {-1.0, -1.0}}, {1.0, 1.0}), (std::vector<double>{0.0, 0.0}));
  EXPECT_TRUE(non_negative_least_squares({}, {}).empty());
}

}  // namespace
}  // namespace lanescape
