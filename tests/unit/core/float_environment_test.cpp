#include "core/float_environment.hpp"

#include <gtest/gtest.h>
#include <cfenv>

namespace lanescape {
namespace {

// At run time, with the rounding mode of the moment.
double third() {
  volatile double one = 1.0, three = 3.0;
  return one / three;
}

TEST(FloatEnvironment, RoundsToNearestAndGivesTheHostItsOwnBack) {
  const double nearest = third();
  std::fesetround(FE_UPWARD);
  const double upward = third();
  double inside = 0.0;
  {
    const FloatEnvironment environment;
    inside = third();
  }
  const double after = third();
  std::fesetround(FE_TONEAREST);
  EXPECT_GT(upward, nearest);
  EXPECT_EQ(inside, nearest);
  EXPECT_EQ(after, upward);
}

TEST(FloatEnvironment, TakesTrapsAwayAndGivesThemBack) {
  feenableexcept(FE_DIVBYZERO);
  double inside = 0.0;
  {
    const FloatEnvironment environment;
    volatile double zero = 0.0;
    inside = 1.0 / zero;
  }
  const int traps = fegetexcept();
  fedisableexcept(FE_ALL_EXCEPT);
  EXPECT_GT(inside, 1e308);
  EXPECT_EQ(traps, FE_DIVBYZERO);
}

}  // namespace
}  // namespace lanescape
