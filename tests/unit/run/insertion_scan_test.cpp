#include "run/insertion_scan.hpp"

#include <gtest/gtest.h>

#include <string>

#include "stopping_monitor.hpp"
#include "test_files.hpp"

namespace lanescape {
namespace {

using testing::refusal;

InsertionScanOptions small_scan() {
  InsertionScanOptions options;
  options.states = {{0.3, 2.0}, {0.5, 2.5}};
  options.methods = {InsertionMethod::usher, InsertionMethod::screened};
  options.tolerances = {0.1, 0.01};
  options.largest_steps = {std::nullopt};
  options.particles = 64;
  options.configurations = 2;
  options.count = 5;
  options.equilibration_steps = 200;
  options.between_steps = 100;
  options.widom_probes = 50;
  return options;
}

InsertionScanResult run(const InsertionScanOptions& options, const CheckpointOptions& checkpoint = {},
                        RunMonitor&& monitor = SilentMonitor()) {
  return run_insertion_scan(lennard_jones(), options, choose_isa("auto"), checkpoint, monitor);
}

TEST(InsertionScan, HasARowForEachStateAndForEachCombination) {
  const InsertionScanResult result = run(small_scan());
  ASSERT_EQ(result.states.size(), 2u);
  EXPECT_EQ(result.states[1].density, 0.5);
  EXPECT_EQ(result.states[1].temperature, 2.5);
  EXPECT_NEAR(result.states[1].measured_temperature, 2.5, 0.5);
  ASSERT_EQ(result.costs.size(), 8u);
  for (std::size_t k = 0; k < 8; ++k) {
    const ScanCostRow& row = result.costs[k];
    EXPECT_EQ(row.density, k < 4 ? 0.3 : 0.5);
    EXPECT_EQ(row.method, k / 2 % 2 == 0 ? InsertionMethod::usher : InsertionMethod::screened);
    EXPECT_EQ(row.tolerance, k % 2 == 0 ? 0.1 : 0.01);
    EXPECT_EQ(row.target, result.costs[k < 4 ? 0 : 4].target);  // from the same configurations
    EXPECT_GE(row.evaluations, 1.0);
    EXPECT_EQ(row.failures, 0.0);
  }
  EXPECT_GT(result.costs[1].evaluations, result.costs[0].evaluations);  // the smaller tolerance takes more
}

TEST(InsertionScan, InterruptedAndResumedEndsWithTheSameBits) {
  const InsertionScanResult whole = run(small_scan());
  // During the first state, of which nothing is stored, and during the second.
  for (const int looks : {1, 3}) {
    const testing::TemporaryFolder folder;
    const InsertionScanResult begun = run(small_scan(), {folder.path(), false}, testing::StoppingMonitor(looks));
    EXPECT_TRUE(begun.interrupted);
    EXPECT_EQ(begun.states.size(), looks == 1 ? 0u : 1u);
    const InsertionScanResult resumed = run(small_scan(), {folder.path(), true});
    EXPECT_FALSE(resumed.interrupted);
    ASSERT_EQ(resumed.costs.size(), whole.costs.size());
    for (std::size_t k = 0; k < whole.costs.size(); ++k) {
      EXPECT_EQ(resumed.costs[k].evaluations, whole.costs[k].evaluations);
      EXPECT_EQ(resumed.costs[k].target, whole.costs[k].target);
      EXPECT_EQ(resumed.costs[k].distance, whole.costs[k].distance);
    }
    for (std::size_t k = 0; k < whole.states.size(); ++k) {
      EXPECT_EQ(resumed.states[k].pressure, whole.states[k].pressure);
      EXPECT_EQ(resumed.states[k].chemical_potential, whole.states[k].chemical_potential);
    }
  }
}

TEST(InsertionScan, RefusesOptionsOutOfRange) {
  const auto refused = [](auto change) {
    InsertionScanOptions options = small_scan();
    change(options);
    return refusal([&] { run(options); });
  };
  EXPECT_EQ(refused([](InsertionScanOptions& o) { o.states.clear(); }), "number of states must be at least 1");
  EXPECT_EQ(refused([](InsertionScanOptions& o) { o.configurations = 0; }), "number of configurations must be at least 1");
  EXPECT_EQ(refused([](InsertionScanOptions& o) { o.count = 0; }), "number of places must be at least 1");
  EXPECT_EQ(refused([](InsertionScanOptions& o) { o.time_step = 0.03; }),
            "time step 0.03 is not allowed: above 0 and at most 0.02, or energy is not conserved");
  EXPECT_EQ(refused([](InsertionScanOptions& o) { o.states[1].temperature = -1.0; }),
            "temperature -1 is not allowed: it must be finite and above 0");
  EXPECT_EQ(refused([](InsertionScanOptions& o) { o.target = ScanTarget::chemical_potential, o.widom_probes = 0; }),
            "a target of the chemical potential needs Widom probes: their number must be at least 1");
}

}  // namespace
}  // namespace lanescape
