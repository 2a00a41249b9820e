#include "run/densification_run.hpp"

#include <gtest/gtest.h>

#include <string>

#include "stopping_monitor.hpp"
#include "test_files.hpp"

namespace lanescape {
namespace {

using testing::refusal;

FluidState start() { return fluid_on_lattice(lennard_jones(), 64, 0.4, 2.5, 1); }

DensificationOptions few_insertions() {
  DensificationOptions options;
  options.equilibration_steps = 200;
  options.final_density = 0.5;  // 16 insertions
  options.rate = 0.1;
  options.rows = 4;
  return options;
}

DensificationResult run(const DensificationOptions& options, const CheckpointOptions& checkpoint = {},
                        RunMonitor&& monitor = SilentMonitor()) {
  return run_densification(lennard_jones(), start(), options, choose_isa("auto"), checkpoint, monitor);
}

TEST(DensificationRun, InsertsUpToTheFinalDensityInEqualSteps) {
  const DensificationResult result = run(few_insertions());
  EXPECT_EQ(result.inserted, 16u);
  EXPECT_EQ(result.failures, 0u);
  EXPECT_EQ(result.final_state.configuration.size(), 80u);
  EXPECT_EQ(result.final_state.velocities.size(), 240u);
  ASSERT_EQ(result.rows.size(), 4u);
  for (std::size_t row = 1; row < 4; ++row) {
    EXPECT_GT(result.rows[row].density, result.rows[row - 1].density);
    EXPECT_GT(result.rows[row].time, result.rows[row - 1].time);
  }
  for (const DensificationRow& row : result.rows) EXPECT_NEAR(row.drift, 0.0, 0.05);
}

TEST(DensificationRun, InterruptedAndResumedEndsWithTheSameBits) {
  const DensificationResult whole = run(few_insertions());
  for (const int looks : {1, 3}) {
    const testing::TemporaryFolder folder;
    const DensificationResult begun = run(few_insertions(), {folder.path(), false}, testing::StoppingMonitor(looks));
    EXPECT_TRUE(begun.interrupted);
    EXPECT_EQ(begun.rows.size(), static_cast<std::size_t>(looks));
    const DensificationResult resumed = run(few_insertions(), {folder.path(), true});
    EXPECT_FALSE(resumed.interrupted);
    EXPECT_EQ(resumed.final_state.configuration.positions, whole.final_state.configuration.positions);
    EXPECT_EQ(resumed.final_state.velocities, whole.final_state.velocities);
    ASSERT_EQ(resumed.rows.size(), whole.rows.size());
    for (std::size_t row = 0; row < whole.rows.size(); ++row) {
      EXPECT_EQ(resumed.rows[row].energy, whole.rows[row].energy);
      EXPECT_EQ(resumed.rows[row].drift, whole.rows[row].drift);
      EXPECT_EQ(resumed.rows[row].evaluations, whole.rows[row].evaluations);
    }
  }
}

TEST(DensificationRun, RefusesOptionsOutOfRange) {
  const auto refused = [](auto change) {
    DensificationOptions options = few_insertions();
    options.check(start());
    change(options);
    return refusal([&] { run(options); });
  };
  EXPECT_EQ(refused([](DensificationOptions& o) { o.temperature = 0.0; }),
            "temperature 0 is not allowed: it must be finite and above 0");
  EXPECT_EQ(refused([](DensificationOptions& o) { o.time_step = 0.03; }),
            "time step 0.03 is not allowed: at most 0.02, or energy is not conserved");
  EXPECT_EQ(refused([](DensificationOptions& o) { o.final_density = 0.4; }).rfind("final density 0.4 is not allowed", 0), 0u);
  EXPECT_EQ(refused([](DensificationOptions& o) { o.rate = 0.2; }).rfind("rate of density 0.2 is not allowed", 0), 0u);
  EXPECT_EQ(refused([](DensificationOptions& o) { o.rows = 0; }), "number of rows must be at least 1");
}

}  // namespace
}  // namespace lanescape
