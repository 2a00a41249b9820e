#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "run/end_point_run.hpp"
#include "run/path_run.hpp"
#include "systems.hpp"

namespace lanescape {
namespace {

std::vector<ConfigurationPair> quick_pairs(std::size_t count) {
  EndPointOptions options;
  options.temperature = 2.0;
  options.distance = 10.0;
  options.pairs = count;
  options.melt_steps = 1000;
  options.cooling_steps = 4000;
  options.check_steps = 4000;
  options.check_tolerance = 0.1;
  options.settle_steps = 2000;
  options.between_steps = 3000;
  SilentMonitor monitor;
  return run_end_points(kob_andersen(), testing::molten_kob_andersen(), options, testing::active_isa(), {}, monitor).pairs;
}

// [C] figures 6 and 8: the two methods find paths of the same length and participation.
TEST(ContourAndEscape, AgreeOnKobAndersenPairs) {
  const auto pairs = quick_pairs(2);
  ASSERT_EQ(pairs.size(), 2u);
  const auto paths = [&](const char* method) {
    PathRunOptions options;
    options.method = &path_method(method);
    SilentMonitor monitor;
    return run_paths(kob_andersen(), pairs, options, testing::active_isa(), {}, monitor);
  };
  const auto contour = paths("contour"), escape = paths("escape");
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    SCOPED_TRACE(k);
    ASSERT_EQ(contour[k].outcome, Outcome::reached) << contour[k].reason;
    ASSERT_EQ(escape[k].outcome, Outcome::reached) << escape[k].reason;
    // The paths are not two straight lines, which would agree trivially.
    EXPECT_GT(contour[k].detour_steps, 3000u);
    EXPECT_GT(escape[k].detour_steps, 1000u);
    EXPECT_LT(contour[k].ratio_squared(), 0.9);
    EXPECT_NEAR(contour[k].ratio_squared() / escape[k].ratio_squared(), 1.0, 0.03);
    EXPECT_NEAR(contour[k].participation_number / escape[k].participation_number, 1.0, 0.05);
    EXPECT_LE(contour[k].largest_violation, 0.0);
    EXPECT_LE(escape[k].largest_violation, 1e-4 * (1.0 + 1e-9));
  }
}

}  // namespace
}  // namespace lanescape
