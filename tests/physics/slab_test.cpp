#include "run/slab_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dispatch/isa.hpp"
#include "small_slab.hpp"

namespace lanescape {
namespace {

TEST(Slab, LiquidIsInTheDenseStateAndVapourInTheOther) {
  SilentMonitor monitor;
  const SlabRunResult run = run_slab(liquid_vapour(), testing::small_slab(3000, 2000), choose_isa("auto"), {}, monitor);
  const SlabProfiles& profiles = run.profiles;
  EXPECT_EQ(profiles.samples, 100U);
  EXPECT_NEAR(run.temperature, 0.8, 0.04);
  double sites = 0.0, vapour_sites = 0.0, vapour_density = 0.0;
  for (std::size_t bin = 0; bin < 24; ++bin) {
    sites += profiles.sites[bin];
    const double off = std::abs(profiles.z[bin]);
    if (profiles.sites[bin] > 0.0) {
      EXPECT_NEAR(profiles.probability[0][bin] + profiles.probability[1][bin], 1.0, 1e-12);
    }
    if (off < 3.0) {
      EXPECT_GT(profiles.density[bin], 0.6);
      EXPECT_LT(profiles.density[bin], 0.9);
      EXPECT_GT(profiles.probability[0][bin], 0.9);
      EXPECT_GT(profiles.local_density[bin], 7.0);
    }
    if (off > 9.0) {
      vapour_sites += profiles.sites[bin];
      vapour_density += profiles.sites[bin] * profiles.probability[0][bin];
      EXPECT_LT(profiles.density[bin], 0.1);
    }
  }
  EXPECT_EQ(sites, 512.0 * 100.0);
  EXPECT_LT(vapour_density, 0.3 * vapour_sites + 1.0);
}

}  // namespace
}  // namespace lanescape
