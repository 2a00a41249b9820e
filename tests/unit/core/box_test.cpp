#include "core/box.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "configuration/configuration.hpp"
#include "configuration/space_order.hpp"
#include "core/coordinate_checks.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

TEST(Box, IsPeriodicAlongAllAxesUnlessItIsSaid) {
  const Box box{{3.0, 4.0, 5.0}};
  EXPECT_FALSE(box.has_open_axis());
  EXPECT_EQ(box.shortest(), 3.0);
  EXPECT_EQ(box.nearest_image({2.0, -3.0, 2.5}), (Point{-1.0, 1.0, 2.5}));
  EXPECT_NO_THROW(check_periodic(box, "paths"));
  EXPECT_NE(box, (Box{{3.0, 4.0, 5.0}, {true, false, true}}));
}

TEST(Box, HasNoImagesAlongAnOpenAxis) {
  const Box box{{3.0, 4.0, 5.0}, {false, true, true}};
  EXPECT_TRUE(box.has_open_axis());
  EXPECT_EQ(box.shortest(), 4.0);
  EXPECT_EQ(box.volume(), 60.0);
  EXPECT_EQ(box.nearest_image({2.0, -3.0, 2.5}), (Point{2.0, 1.0, 2.5}));
  for (const double x : {-7.0, -0.0, 0.0, 3.0, 1e9}) EXPECT_EQ(box.wrapped(0, x), x);
  EXPECT_EQ(box.wrapped(1, -1.0), 3.0);
  EXPECT_EQ(box.in_unit(2.0), (Box{{1.5, 2.0, 2.5}, {false, true, true}}));
  EXPECT_EQ((Box{{1.0, 2.0, 3.0}, {false, false, false}}).shortest(), std::numeric_limits<double>::infinity());
}

TEST(Box, IsRefusedInOneLineThatNamesTheOpenAxis) {
  const Box box{{3.0, 4.0, 5.0}, {true, false, true}};
  EXPECT_EQ(testing::refusal([&] { check_periodic(box, "paths"); }),
            "paths are not allowed in a box that is open along y: it must be periodic along all axes");
}

TEST(Box, WrapsConfigurationsAlongPeriodicAxesAlone) {
  Configuration configuration{{{3.0, 4.0, 5.0}, {false, true, false}}, {0, 0}, {-1.0, -1.0, -1.0, 4.0, 5.0, 6.0}};
  configuration.wrap();
  EXPECT_EQ(configuration.positions, (std::vector<double>{-1.0, 3.0, -1.0, 4.0, 1.0, 6.0}));
}

TEST(Box, OrdersParticlesInSpaceOutsideItsFaces) {
  const Box box{{4.0, 4.0, 4.0}, {false, true, true}};
  const std::vector<double> positions = {9.0, 1.0, 1.0, -8.0, 1.0, 1.0, 1.0, 5.5, 1.0};
  EXPECT_EQ(order_in_space(positions, box), (std::vector<std::size_t>{1, 2, 0}));
}

}  // namespace
}  // namespace lanescape
