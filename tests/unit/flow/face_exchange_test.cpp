#include "flow/face_exchange.hpp"

#include <gtest/gtest.h>

#include "open_slab.hpp"

namespace lanescape {
namespace {

// Kinetic and potential energy, and momentum.
FlowBalance::Content content(const PairModel& model, const FluidState& fluid) {
  const ParticleLayout layout = ParticleLayout::in_users_order(fluid.configuration, 1);
  PairLandscape pairs(model, fluid.configuration.box, layout, choose_isa("auto"));
  FlowBalance::Content sum{
      static_cast<double>(fluid.configuration.size()), pairs.energy(layout.to_slots(fluid.configuration.positions)), {}};
  for (std::size_t k = 0; k < fluid.velocities.size(); ++k) {
    sum.energy += 0.5 * fluid.velocities[k] * fluid.velocities[k];
    sum.momentum[k % 3] += fluid.velocities[k];
  }
  return sum;
}

class FaceExchangeTest : public ::testing::TestWithParam<std::size_t> {
 protected:
  PairModel model = lennard_jones();
  FluidState fluid = testing::slab_fluid(model, 200);
  SlabGeometry geometry{fluid.configuration.box, 4.0, 2.0};

  FaceExchange face(const FaceExchangeOptions& options = testing::slab_options().faces) {
    return {model, geometry, GetParam(), options, choose_isa("auto"), 1};
  }
  double into_slab() const { return GetParam() == 0 ? 1.0 : -1.0; }
  // What the report says is what the slab has gained.
  void expect_balanced(const FlowBalance::Content& before, const FaceReport& report) {
    const FlowBalance::Content after = content(model, fluid);
    EXPECT_EQ(after.particles - before.particles, into_slab() * report.particles);
    EXPECT_NEAR(after.energy - before.energy, into_slab() * report.energy, 1e-9);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(after.momentum[axis] - before.momentum[axis], into_slab() * report.momentum[axis], 1e-10);
  }
};

TEST_P(FaceExchangeTest, PutsInAndTakesOutWhatTheMassFluxAsksForAndAccountsForIt) {
  FaceExchange exchange = face();
  for (const double particles : {3.4, 0.4, -4.2, -0.5}) {
    const FlowBalance::Content before = content(model, fluid);
    FaceDemand demand = testing::slab_demands(0.0)[0];
    demand.velocity = {0.4, 0.0, 0.0};
    demand.mass_flux = into_slab() * particles / geometry.area;
    FaceReport report;
    EXPECT_EQ(exchange.pass(fluid, demand, 0.0, 1.0, -2.5, report), FlowOutcome::followed);
    expect_balanced(before, report);
  }
  // 3.4 + 0.4 in, then 4.7 out: rounded down after each exchange.
  EXPECT_EQ(exchange.counts().put_in, 3u);
  EXPECT_EQ(exchange.counts().taken_out, 4u);
  EXPECT_EQ(exchange.counts().left, 0u);
  for (const FlowInsertion& one : exchange.insertions()) {
    EXPECT_NEAR(one.energy, -2.5, 0.25);
    EXPECT_GE(one.evaluations, 1u);
  }
  EXPECT_EQ(exchange.insertions().size(), 3u);
  exchange.forget_insertions();
  EXPECT_TRUE(exchange.insertions().empty());
}

TEST_P(FaceExchangeTest, TakesOutWhatHasLeftAndReplacesIt) {
  const double beyond = GetParam() == 0 ? -0.3 : geometry.length + 0.3;
  fluid.configuration.positions[0] = beyond;
  const Point first = fluid.configuration.position(0);
  const FlowBalance::Content before = content(model, fluid);
  FaceExchange exchange = face();
  FaceReport report;
  EXPECT_EQ(exchange.pass(fluid, testing::slab_demands(0.0)[0], 0.0, 1.0, -2.5, report), FlowOutcome::followed);
  expect_balanced(before, report);
  EXPECT_EQ(exchange.counts().left, 1u);
  EXPECT_EQ(exchange.counts().put_in, 1u);
  EXPECT_EQ(report.particles, 0.0);
  EXPECT_NE(fluid.configuration.position(0), first);
  for (std::size_t i = 0; i < fluid.configuration.size(); ++i) {
    EXPECT_GE(fluid.configuration.positions[3 * i], 0.0);
    EXPECT_LE(fluid.configuration.positions[3 * i], geometry.length);
  }
}

TEST_P(FaceExchangeTest, HeatsAndThermostatsChangeEnergyAndNotMomentum) {
  FaceExchangeOptions options = testing::slab_options().faces;
  for (const double rate : {0.0, 2.0}) {
    options.thermostat_rate = rate;
    FaceExchange exchange = face(options);
    const FlowBalance::Content before = content(model, fluid);
    FaceDemand demand = testing::slab_demands(0.0)[0];
    demand.heat_flux = 0.5;
    FaceReport report;
    EXPECT_EQ(exchange.pass(fluid, demand, 0.0, 0.1, -2.5, report), FlowOutcome::followed);
    expect_balanced(before, report);
    EXPECT_EQ(report.energy, report.heat);
    const double missing = std::abs(report.heat - 0.5 * 64.0 * 0.1);  // from what the demand asks for
    EXPECT_TRUE(rate == 0.0 ? missing < 1e-9 : missing > 1e-3) << missing;
  }
}

TEST_P(FaceExchangeTest, SaysWhyItCannotFollow) {
  FaceDemand demand = testing::slab_demands(0.0)[0];
  demand.mass_flux = into_slab() * 1e4;
  FaceReport report;
  EXPECT_EQ(face().pass(fluid, demand, 0.0, 1.0, -2.5, report), FlowOutcome::rate_too_high);
  FaceExchangeOptions options = testing::slab_options().faces;
  options.insertion.most_trials = 1;
  options.insertion.tolerance = 1e-9;
  options.insertion.most_iterations = 2;
  demand.mass_flux = into_slab() * 2.0 / geometry.area;
  const FlowBalance::Content before = content(model, fluid);
  report = {};
  EXPECT_EQ(face(options).pass(fluid, demand, 0.0, 1.0, -2.5, report), FlowOutcome::no_place);
  expect_balanced(before, report);
}

INSTANTIATE_TEST_SUITE_P(BothFaces, FaceExchangeTest, ::testing::Values(0, 1));

}  // namespace
}  // namespace lanescape
