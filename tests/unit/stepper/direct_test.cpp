#include "stepper/direct.hpp"

#include <gtest/gtest.h>

#include "one_particle.hpp"

namespace lanescape {
namespace {

TEST(DirectTrial, IsOneStepLengthStraightTowardsTheGoal) {
  const testing::Plateau landscape;
  const testing::Way way(landscape, {1.0, 2.0, 3.0}, {4.0, 6.0, 15.0});  // 13 away
  AlignedArray trial(landscape.dimension(), 7.0);
  direct_trial(landscape.algebra(), way.at(), 0.26, trial);
  const Point there = landscape.point(trial);
  EXPECT_NEAR(there[0], 1.06, 1e-15);
  EXPECT_NEAR(there[1], 2.08, 1e-15);
  EXPECT_NEAR(there[2], 3.24, 1e-15);
  EXPECT_EQ(trial, landscape.array(there));  // padding is zero
}

}  // namespace
}  // namespace lanescape
