#include "run/slab_run.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "dispatch/isa.hpp"
#include "refusal.hpp"
#include "small_slab.hpp"
#include "stopping_monitor.hpp"

namespace lanescape {
namespace {

TEST(SlabRun, DoesNotDependOnTheNumberOfThreads) {
  SilentMonitor monitor;
  SlabOptions options = testing::small_slab(100, 100);
  options.equilibration_steps = options.sampling_steps = 20;  // few steps, because two threads on one busy core are slow
  const SlabRunResult one = run_slab(liquid_vapour(), options, choose_isa("auto"), {}, monitor);
  options.threads = 2;
  const SlabRunResult two = run_slab(liquid_vapour(), options, choose_isa("auto"), {}, monitor);
  EXPECT_EQ(one.last.positions, two.last.positions);
  EXPECT_EQ(one.profiles.probability, two.profiles.probability);
}

TEST(SlabRun, RefusesWhatDoesNotFit) {
  using testing::refusal;
  SilentMonitor monitor;
  const auto refused = [&](auto change) {
    SlabOptions options = testing::small_slab(100, 100);
    change(options);
    return refusal([&] { run_slab(liquid_vapour(), options, choose_isa("auto"), {}, monitor); });
  };
  EXPECT_NE(refused([](SlabOptions& o) { o.particles = 5000; }).find("do not fit"), std::string::npos);
  EXPECT_NE(refused([](SlabOptions& o) { o.particles = 0; }).find("particles"), std::string::npos);
  EXPECT_NE(refused([](SlabOptions& o) { o.interval = 0; }).find("interval"), std::string::npos);
  EXPECT_NE(refused([](SlabOptions& o) { o.temperature = -1.0; }).find("temperature"), std::string::npos);
}

TEST(SlabRun, EndsEarlyWithTheSamplesSoFarWhenAskedTo) {
  SlabOptions options = testing::small_slab(100, 100);
  options.sampling_steps = 200;
  for (const auto& [looks, samples] : {std::pair{1, 0U}, {2, 5U}}) {  // a query every hundred steps, a sample every twenty
    testing::StoppingMonitor monitor(looks);
    const SlabRunResult begun = run_slab(liquid_vapour(), options, choose_isa("auto"), {}, monitor);
    EXPECT_TRUE(begun.interrupted);
    EXPECT_EQ(begun.profiles.samples, samples);
  }
}

}  // namespace
}  // namespace lanescape
