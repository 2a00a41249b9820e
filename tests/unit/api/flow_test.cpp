#include <lanescape/flow.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "open_slab.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

using testing::refusal;

// A host's reservoir: pressure and flow of its own, and a ledger of what passed.
class Reservoir : public FlowOutside {
 public:
  explicit Reservoir(double velocity) {
    demand_.pressure = testing::slab_pressure;
    demand_.temperature = testing::slab_temperature;
    demand_.velocity = {velocity, 0.0, 0.0};
    demand_.mass_flux = testing::slab_density * velocity;
  }
  Demands begin(const Reports& initial) override {
    EXPECT_NEAR(initial[0].density, testing::slab_density, 0.1);
    EXPECT_EQ(initial[0].particles, 0.0);
    return {demand_, demand_};
  }
  Demands advance(const Reports& passed, double time) override {
    time_ += time;
    gained_ += passed[0].particles - passed[1].particles;
    pushed_ += passed[0].impulse[0];
    return {demand_, demand_};
  }

  FlowDemand demand_;
  double time_ = 0.0, gained_ = 0.0, pushed_ = 0.0;
};

struct Fluid {
  Model model = Model::named("lennard-jones");
  FluidState state = testing::slab_fluid(lennard_jones());
  const std::vector<double>& positions() const { return state.configuration.positions; }
  std::array<double, 3> box() const { return state.configuration.box.length; }
};

TEST(OpenFlow, CouplesAHostToParticles) {
  const Fluid fluid;
  Reservoir outside(0.3);
  OpenFlow flow(fluid.model, fluid.positions(), fluid.state.velocities, fluid.box(), outside);
  const std::size_t before = flow.particles();
  for (int k = 0; k < 10; ++k) flow.advance();
  EXPECT_EQ(flow.steps(), 500u);
  EXPECT_NEAR(outside.time_, flow.time(), 1e-12);
  EXPECT_EQ(static_cast<double>(flow.particles()) - static_cast<double>(before), outside.gained_);
  EXPECT_NEAR(outside.pushed_, testing::slab_pressure * 64.0 * flow.time(), 1e-9);
  EXPECT_EQ(flow.positions().size(), 3 * flow.particles());
  EXPECT_EQ(flow.velocities().size(), 3 * flow.particles());
  EXPECT_NEAR(flow.energy_error(), 0.0, 1e-3);
  const FlowProfiles means = flow.profiles();
  EXPECT_EQ(means.x.size(), 12u);
  EXPECT_EQ(means.velocity.size(), 36u);
  EXPECT_NEAR(means.density[6], testing::slab_density, 0.15);
  EXPECT_NE(refusal([&] { flow.profiles(); }).find("advance() first"), std::string::npos);
}

TEST(OpenFlow, SaysWhatItCannotUseOrFollow) {
  const Fluid fluid;
  Reservoir outside(0.3), flood(3000.0), broken(0.0);
  broken.demand_.pressure = std::numeric_limits<double>::quiet_NaN();
  const auto flow = [&](FlowOutside& beyond, const OpenFlow::Options& options = {}) {
    return OpenFlow(fluid.model, fluid.positions(), fluid.state.velocities, fluid.box(), beyond, options);
  };
  EXPECT_NE(refusal([&] { flow(outside, {.buffer = 20.0}); }).find("buffer width 20"), std::string::npos);
  EXPECT_NE(refusal([&] { flow(outside, {.threads = 0}); }).find("threads"), std::string::npos);
  EXPECT_NE(refusal([&] { flow(broken).advance(); }).find("nan"), std::string::npos);
  const std::vector<double> few(6, 0.0);
  EXPECT_FALSE(refusal([&] { OpenFlow(fluid.model, fluid.positions(), few, fluid.box(), outside); }).empty());
  const Model mixture = Model::named("kob-andersen");
  EXPECT_NE(
      refusal([&] { OpenFlow(mixture, fluid.positions(), fluid.state.velocities, fluid.box(), outside); }).find("one species"),
      std::string::npos);
  OpenFlow fast = flow(flood);
  const std::string why = refusal(
      [&] {
        for (int k = 0; k < 100; ++k) fast.advance();
      },
      ErrorCode::goal_not_reached);
  EXPECT_NE(why.find("rate too high"), std::string::npos);
}

}  // namespace
}  // namespace lanescape
