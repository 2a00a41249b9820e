#include "flow/simple_wave.hpp"

#include <gtest/gtest.h>

#include "flow/lennard_jones_fluid.hpp"
#include "ideal_gas.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

using namespace testing;

TEST(SimpleWave, AnIdealGasHasItsRiemannInvariants) {
  const FlowState still = ideal_flow(1.0, 0.2, 2.0);
  for (const double density : {0.7, 1.0, 1.001, 1.3}) {
    const FlowState wave = simple_wave(IdealGas(), still, density);
    EXPECT_EQ(wave.fluid.density, density);
    EXPECT_NEAR(wave.fluid.pressure, 2.0 * std::pow(density, 5.0 / 3.0), 1e-4);
    // u - 2c/(gamma - 1) is constant across the wave.
    EXPECT_NEAR(wave.velocity[0] - 3.0 * wave.fluid.sound_velocity(), 0.2 - 3.0 * still.fluid.sound_velocity(), 1e-4);
  }
}

TEST(SimpleWave, ASmallOneIsThatOfAcoustics) {
  const LennardJonesFluid liquid(3.0);
  const FlowState still{liquid.at_temperature(0.5, 2.5), {}};
  const FlowState wave = simple_wave(liquid, still, 0.5 * (1.0 + 1e-5));
  EXPECT_NEAR(wave.velocity[0] / (still.fluid.sound_velocity() * 1e-5), 1.0, 1e-4);
  EXPECT_NEAR((wave.fluid.pressure - still.fluid.pressure) / (wave.velocity[0] * 0.5 * still.fluid.sound_velocity()), 1.0, 1e-4);
}

TEST(SimpleWave, WavesBeyondTheFluidAreRefused) {
  const LennardJonesFluid liquid;
  const FlowState still{liquid.at_temperature(0.7, 1.1), {}};
  EXPECT_NE(refusal([&] { simple_wave(liquid, still, 0.4); }).find("unstable"), std::string::npos);
  EXPECT_NE(refusal([&] { simple_wave(liquid, still, -0.4); }), "");
  EXPECT_NE(refusal([&] { simple_wave(liquid, still, 2.0); }), "");
}

}  // namespace
}  // namespace lanescape
