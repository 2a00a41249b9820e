#include "observables/heterogeneity.hpp"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(Heterogeneity, SumsOfSeveralPathsAddUpToTheWidthOverAllTheirParticles) {
  DetourSums one, other;
  for (const double length : {10.0, 1000.0}) one.add(log_detour(length, 1.0).value());
  for (const double length : {100.0, 10000.0}) other.add(log_detour(length, 1.0).value());
  EXPECT_NEAR(one.width(), 1.0, 1e-14);
  one += other;
  EXPECT_NEAR(one.width(), std::sqrt(1.25), 1e-14);
  EXPECT_EQ(DetourSums{}.width(), 0.0);
  EXPECT_FALSE(log_detour(1.0, 0.0));
}

}  // namespace
}  // namespace lanescape
