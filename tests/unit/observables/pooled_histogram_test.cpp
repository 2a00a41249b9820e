#include "observables/pooled_histogram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lanescape {
namespace {

TEST(PooledHistogram, SharesAreThoseOfAllStepsWithJackknifeErrorsOverPaths) {
  const ValueCounts first{{1.0, 1.0}, {2.0, 1.0}}, second{{2.0, 2.0}};
  const std::vector<Share> shares = pooled_shares(std::vector{&first, &second});
  ASSERT_EQ(shares.size(), 2U);
  EXPECT_EQ(shares[0].value, 1.0);
  EXPECT_DOUBLE_EQ(shares[0].probability, 0.25);
  EXPECT_DOUBLE_EQ(shares[1].probability, 0.75);
  // Without one of them the share of 1 is 0 or 0.5.
  EXPECT_DOUBLE_EQ(shares[0].error.value(), 0.25);
  EXPECT_DOUBLE_EQ(shares[1].error.value(), 0.25);
}

TEST(PooledHistogram, LongPathsCountForMore) {
  const ValueCounts few{{1.0, 1.0}}, many{{2.0, 9.0}};
  EXPECT_DOUBLE_EQ(pooled_shares(std::vector{&few, &many})[0].probability, 0.1);
}

TEST(PooledHistogram, OnePathHasNoErrorAndPathsWithoutStepsDoNotCount) {
  const ValueCounts only{{0.5, 3.0}}, none;
  const std::vector<Share> shares = pooled_shares(std::vector{&none, &only});
  ASSERT_EQ(shares.size(), 1U);
  EXPECT_EQ(shares[0].probability, 1.0);
  EXPECT_FALSE(shares[0].error.has_value());
  EXPECT_TRUE(pooled_shares(std::vector{&none}).empty());
}

TEST(PooledHistogram, TheMeanIsWeightedWithCounts) {
  EXPECT_DOUBLE_EQ(mean_of({{1.0, 1.0}, {4.0, 2.0}}), 3.0);
  EXPECT_TRUE(std::isnan(mean_of({})));
}

}  // namespace
}  // namespace lanescape
