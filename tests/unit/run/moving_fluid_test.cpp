#include "run/moving_fluid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "memory_archive.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

FluidState start() { return fluid_on_lattice(kob_andersen(), 50, 0.6, 1.5, 1); }

MovingFluid moving(const FluidState& state) { return {kob_andersen(), state, 0.002, choose_isa("auto"), 1}; }

double squared_sum(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return sum;
}

TEST(FluidOnLattice, HasVelocitiesOfItsTemperature) {
  const FluidState state = fluid_on_lattice(kob_andersen(), 4000, 0.6, 1.5, 1);
  EXPECT_NEAR(static_cast<double>(state.configuration.size()) / state.configuration.box.volume(), 0.6, 1e-12);
  // A mean of 12000 squares: its relative standard error is sqrt(2/12000) = 0.013.
  EXPECT_NEAR(squared_sum(state.velocities) / 12'000.0, 1.5, 4.0 * 0.013 * 1.5);
}

TEST(MovingFluid, HasEnergyTemperatureAndPressureOfItsState) {
  const FluidState state = start();
  MovingFluid fluid = moving(state);
  const reference::Evaluation expected = evaluate_reference(kob_andersen(), state.configuration);
  const double kinetic = 0.5 * squared_sum(state.velocities);
  EXPECT_NEAR(fluid.potential().energy, expected.energy, 1e-11 * std::fabs(expected.energy));
  EXPECT_NEAR(fluid.kinetic_energy(), kinetic, 1e-12 * kinetic);
  EXPECT_NEAR(fluid.temperature(), 2.0 * kinetic / 150.0, 1e-12);
  const double pressure = (2.0 * kinetic + expected.virial) / (3.0 * state.configuration.box.volume());
  EXPECT_NEAR(fluid.potential().pressure, pressure, 1e-10);
}

TEST(MovingFluid, ConservesEnergyAndMoves) {
  MovingFluid fluid = moving(start());
  const double before = fluid.potential().energy + fluid.kinetic_energy();
  fluid.run(300);
  EXPECT_NEAR(fluid.potential().energy + fluid.kinetic_energy(), before, 0.01 * 50.0);
  const FluidState state = fluid.state();
  EXPECT_NE(state.configuration.positions, start().configuration.positions);
  for (std::size_t k = 0; k < state.configuration.positions.size(); ++k) {
    EXPECT_GE(state.configuration.positions[k], 0.0);
    EXPECT_LT(state.configuration.positions[k], state.configuration.box.length[k % 3]);
  }
}

TEST(MovingFluid, EquilibratesToTheTemperature) {
  MovingFluid fluid = moving(start());
  equilibrate(fluid, 3.0, 400);
  EXPECT_NEAR(fluid.temperature(), 3.0, 0.5);
  fluid.rescale_to(1.0);
  EXPECT_NEAR(fluid.temperature(), 1.0, 1e-12);
}

TEST(FluidState, HandedOnItGoesOnWithTheSameBits) {
  MovingFluid fluid = moving(start());
  fluid.run(20);
  FluidState whole = fluid.state(), copy;
  testing::hand_on(whole, copy);
  EXPECT_EQ(copy.configuration.box, whole.configuration.box);
  EXPECT_EQ(copy.configuration.species, whole.configuration.species);
  MovingFluid one = moving(whole), other = moving(copy);
  one.run(20);
  other.run(20);
  EXPECT_EQ(other.state().configuration.positions, one.state().configuration.positions);
  EXPECT_EQ(other.state().velocities, one.state().velocities);
}

TEST(FluidState, GrowsByAParticleAtItsEnd) {
  FluidState state = start();
  state.add(1, {0.25, 0.5, 0.75}, {1.0, 2.0, 3.0});
  ASSERT_EQ(state.configuration.size(), 51u);
  EXPECT_EQ(state.configuration.species.back(), 1);
  EXPECT_EQ(state.configuration.position(50), (Point{0.25, 0.5, 0.75}));
  EXPECT_EQ(point_at(state.velocities.data(), 50), (Point{1.0, 2.0, 3.0}));
}

}  // namespace
}  // namespace lanescape
