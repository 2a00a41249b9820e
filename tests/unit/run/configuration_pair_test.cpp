#include "run/configuration_pair.hpp"

#include <gtest/gtest.h>

namespace lanescape {
namespace {

// One particle in a box of edges 4, 5 and 6 that moves along z.
ConfigurationPair moving(double from, double to) {
  ConfigurationPair pair;
  pair.start = {Box{{4.0, 5.0, 6.0}}, {0}, {1.0, 2.0, from}, {}, {}};
  pair.finish = {Box{{4.0, 5.0, 6.0}}, {0}, {1.0, 2.0, to}, {}, {}};
  return pair;
}

TEST(ConfigurationPair, EndsInOneBoxLookWrappedIfAParticleMovesByMoreThanHalfAnEdge) {
  EXPECT_TRUE(looks_wrapped(moving(0.5, 5.5)));
  EXPECT_TRUE(looks_wrapped(moving(5.5, 0.5)));
  EXPECT_TRUE(looks_wrapped(moving(0.0, 6.0)));
  EXPECT_FALSE(looks_wrapped(moving(1.0, 4.0)));
}

TEST(ConfigurationPair, EndsBeyondTheBoxDoNotLookWrapped) {
  EXPECT_FALSE(looks_wrapped(moving(-0.5, 5.5)));
  EXPECT_FALSE(looks_wrapped(moving(5.5, -0.5)));
  EXPECT_FALSE(looks_wrapped(moving(0.5, 6.5)));
  ConfigurationPair pair = moving(0.5, 5.5);
  pair.finish.positions[0] = 4.5;
  EXPECT_FALSE(looks_wrapped(pair));
}

}  // namespace
}  // namespace lanescape
