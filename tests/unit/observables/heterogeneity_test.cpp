#include "observables/heterogeneity.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace lanescape {
namespace {

TEST(Heterogeneity, IsTheSpreadOfTheLogarithmWithinEachSpecies) {
  // Species 0: path lengths 10 and 1000 times the displacement; species 1: 100 times, twice; species 2 has no particles.
  const std::vector<double> lengths = {20.0, 100.0, 3000.0, 500.0}, straight = {2.0, 1.0, 3.0, 5.0};
  const std::vector<int> species = {0, 1, 0, 1};
  const auto widths = heterogeneity_widths(lengths, straight, species, 3);
  ASSERT_EQ(widths.size(), 3U);
  EXPECT_NEAR(widths[0], 1.0, 1e-14);
  EXPECT_NEAR(widths[1], 0.0, 1e-7);
  EXPECT_EQ(widths[2], 0.0);
}

TEST(Heterogeneity, ParticlesThatEndWhereTheyBeganAreLeftOut) {
  const auto widths = heterogeneity_widths(std::vector<double>{1.0, 10.0, 100.0, 0.0}, std::vector<double>{0.0, 1.0, 1.0, 0.0},
                                           std::vector<int>{0, 0, 0, 0}, 1);
  EXPECT_NEAR(widths[0], 0.5, 1e-14);
}

}  // namespace
}  // namespace lanescape
