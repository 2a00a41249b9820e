#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "path/path_check.hpp"
#include "path/shortening/curve_shortening.hpp"
#include "path/shortening/soft_curve.hpp"
#include "reference/curve_shortening.hpp"
#include "small_liquid.hpp"

namespace lanescape {
namespace {

using testing::SmallLiquid;

// The nodes of the shortened path, in the user's order.
std::vector<reference::Point> shortened(const SmallLiquid& liquid, const std::vector<reference::Point>& start) {
  const auto landscape = liquid.make();
  CurveShortening curve(landscape->algebra(),
                        std::make_unique<SoftCurve>([&] { return liquid.make(); }, liquid.landscape_energy, SoftCurveOptions{}),
                        {.coarse_spacing = 0.2});
  curve.begin(liquid.in_slots(start));
  while (!curve.finished()) curve.advance();
  EXPECT_EQ(curve.reason(), "");
  std::vector<reference::Point> nodes;
  for (const AlignedArray& node : curve.nodes()) nodes.push_back(liquid.layout.to_user(node));
  return nodes;
}

PathCheck check(const SmallLiquid& liquid, const std::vector<reference::Point>& nodes) {
  return check_path([&] { return liquid.make(); }, liquid.landscape_energy, liquid.in_slots(nodes));
}

TEST(ShortenedPath, IsAsLongAsThatOfTheReferenceFromTheSameStart) {
  for (const std::size_t particles : {8u, 12u, 16u, 20u}) {
    const SmallLiquid liquid(particles, particles, 4000);
    const auto greedy = liquid.greedy();
    const auto expected =
        reference::shorten_curve(greedy, reference::below_energy(liquid.energy(), liquid.gradient(), liquid.landscape_energy),
                                 {.fine = 65, .tolerance = 1e-5});
    ASSERT_TRUE(expected.stationary);
    const PathCheck before = check(liquid, greedy), found = check(liquid, shortened(liquid, greedy));
    std::printf("%zu: greedy %.6f curve %.6f reference %.6f sweeps %ld residual %.3g\n", particles, before.length, found.length,
                expected.length, expected.sweeps, found.kuhn_tucker_residual);
    EXPECT_LT(found.length, 0.995 * before.length) << "there is something to shorten";
    EXPECT_NEAR(found.length, expected.length, 1e-3 * expected.length);
    EXPECT_LE(found.kuhn_tucker_residual, 1e-2);
    EXPECT_LE(found.largest_violation, 1e-3);
  }
}

}  // namespace
}  // namespace lanescape
