#include "run/configuration_pair.hpp"

#include <gtest/gtest.h>

#include "refusal.hpp"

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

TEST(ConfigurationPair, InBoxesWithOpenAxesIsRefused) {
  ConfigurationPair pair = moving(0.5, 5.5);
  check_end_points(pair, lennard_jones(), "pair 1");
  pair.start.box.periodic[0] = pair.finish.box.periodic[0] = false;
  EXPECT_EQ(testing::refusal([&] { check_end_points(pair, lennard_jones(), "pair 1"); }),
            "pair 1, first end: paths are not allowed in a box that is open along x: it must be periodic along all axes");
}

}  // namespace
}  // namespace lanescape
