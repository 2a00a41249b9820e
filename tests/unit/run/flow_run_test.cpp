#include "run/flow_run.hpp"

#include <gtest/gtest.h>

#include <string>

#include "configuration/lattice.hpp"
#include "flow/continuum_outside.hpp"
#include "stopping_monitor.hpp"
#include "test_files.hpp"

namespace lanescape {
namespace {

using testing::refusal;

Configuration start() { return fcc_in_box(lennard_jones(), {{20.0, 7.0, 7.0}}, 0.5, 1); }

FlowOptions short_flow() {
  FlowOptions options;
  options.equilibration_steps = 500;
  options.resting_steps = 100;
  options.flow_steps = 300;
  options.sampling_steps = 200;
  options.row_steps = 100;
  options.impedance = 2.1;
  options.slab.isa = choose_isa("auto");
  options.slab.faces.insertion.tolerance = 0.1;
  return options;
}

FlowResult run(const FlowOptions& options, const CheckpointOptions& checkpoint = {}, RunMonitor&& monitor = SilentMonitor(),
               const Configuration& from = start()) {
  return run_flow(lennard_jones(), from, options, nullptr, checkpoint, monitor);
}

TEST(FlowRun, RestsAndFlowsInRows) {
  const FlowResult result = run(short_flow());
  EXPECT_EQ(result.outcome, FlowOutcome::followed);
  ASSERT_EQ(result.rows.size(), 4u);
  for (std::size_t row = 0; row < 4; ++row) EXPECT_NEAR(result.rows[row].time, 0.2 * static_cast<double>(row), 1e-12);
  EXPECT_EQ(result.rows[0].profile.x.size(), 10u);
  EXPECT_NEAR(result.pressure, 2.0, 0.4);
  EXPECT_NEAR(result.density.mean.value, 0.5, 0.05);
  // Each row has the balance since its own outside took over, at rest as in the flow.
  for (const FlowRow& row : result.rows) {
    const FlowBalance& balance = row.balance;
    EXPECT_NEAR(balance.now.momentum[0] - balance.start.momentum[0], balance.passed.momentum[0], 1e-9);
    EXPECT_EQ(balance.now.particles - balance.start.particles, balance.passed.particles);
  }
}

TEST(FlowRun, InterruptedAndResumedEndsWithTheSameBits) {
  const FlowResult whole = run(short_flow());
  for (const int looks : {1, 2, 4, 7}) {  // within the equilibration, at its end, at rest and in the flow
    const testing::TemporaryFolder folder;
    EXPECT_TRUE(run(short_flow(), {folder.path(), false}, testing::StoppingMonitor(looks)).interrupted);
    const FlowResult resumed = run(short_flow(), {folder.path(), true});
    EXPECT_FALSE(resumed.interrupted);
    EXPECT_EQ(resumed.last.configuration.positions, whole.last.configuration.positions);
    EXPECT_EQ(resumed.last.velocities, whole.last.velocities);
    ASSERT_EQ(resumed.rows.size(), whole.rows.size());
    for (std::size_t row = 0; row < whole.rows.size(); ++row) {
      EXPECT_EQ(resumed.rows[row].profile.density, whole.rows[row].profile.density);
      EXPECT_EQ(resumed.rows[row].profile.mass_flux, whole.rows[row].profile.mass_flux);
      EXPECT_EQ(resumed.rows[row].balance.passed.energy, whole.rows[row].balance.passed.energy);
      EXPECT_EQ(resumed.rows[row].pressure, whole.rows[row].pressure);
    }
    ASSERT_EQ(resumed.insertions[0].size(), whole.insertions[0].size());
    EXPECT_EQ(resumed.insertions[0].back().energy, whole.insertions[0].back().energy);
  }
}

TEST(FlowRun, ContinuaResumeWithTheSameBits) {
  ContinuumOptions outer;
  outer.cutoff = 2.5;
  outer.planes = {4.0, 16.0};
  outer.area = 49.0;
  outer.cells = 10;
  outer.cell_width = 2.0;
  outer.slice_distance = 1.0;
  const auto flow = [&](const CheckpointOptions& checkpoint, RunMonitor&& monitor) {
    ContinuumOutside outside(outer);
    return run_flow(lennard_jones(), start(), short_flow(), &outside, checkpoint, monitor);
  };
  const FlowResult whole = flow({}, SilentMonitor());
  EXPECT_EQ(whole.rows.back().outside.size(), 20u);
  for (const int looks : {4, 6}) {
    const testing::TemporaryFolder folder;
    EXPECT_TRUE(flow({folder.path(), false}, testing::StoppingMonitor(looks)).interrupted);
    const FlowResult resumed = flow({folder.path(), true}, SilentMonitor());
    EXPECT_EQ(resumed.last.configuration.positions, whole.last.configuration.positions);
    EXPECT_EQ(resumed.rows.back().outside[9].density, whole.rows.back().outside[9].density);
  }
}

TEST(FlowRun, ContinuesFromASlabWithOpenFaces) {
  FlowOptions options = short_flow();
  const FlowResult first = run(options);
  EXPECT_FALSE(first.last.configuration.box.periodic[0]);
  EXPECT_NE(refusal([&] { run(options, {}, SilentMonitor(), first.last.configuration); }).find("needs a pressure"),
            std::string::npos);
  options.pressure = first.pressure;
  EXPECT_NE(refusal([&] { run(options, {}, SilentMonitor(), first.last.configuration); }).find("needs an enthalpy"),
            std::string::npos);
  options.enthalpy_kind = FlowOptions::Enthalpy::free;
  EXPECT_EQ(run(options, {}, SilentMonitor(), first.last.configuration).rows.size(), 4u);
}

TEST(FlowRun, RefusesOptionsOutOfRange) {
  const auto refused = [](auto change) {
    FlowOptions options = short_flow();
    options.check(lennard_jones(), start());
    change(options);
    return refusal([&] { run(options); });
  };
  EXPECT_NE(refused([](FlowOptions& o) { o.temperature = -1.0; }).find("temperature -1"), std::string::npos);
  EXPECT_NE(refused([](FlowOptions& o) { o.velocity = -0.1; }).find("velocity -0.1"), std::string::npos);
  EXPECT_NE(refused([](FlowOptions& o) { o.mass_flux = -1.0; }).find("mass flux -1"), std::string::npos);
  EXPECT_NE(refused([](FlowOptions& o) { o.sampling_steps = 301; }).find("301 sampling steps"), std::string::npos);
  EXPECT_NE(refused([](FlowOptions& o) { o.slab.buffer = 30.0; }).find("buffer width 30"), std::string::npos);
  EXPECT_NE(refused([](FlowOptions& o) { o.pressure = 0.0; }).find("pressure 0"), std::string::npos);
}

}  // namespace
}  // namespace lanescape
