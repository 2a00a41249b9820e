#include "flow/lennard_jones_fluid.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "refusal.hpp"

namespace lanescape {
namespace {

using namespace testing;

// Central difference of fourth order.
template <class Function>
double slope(Function f, double x, double h) {
  return (8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * h);
}

const double every_temperature[] = {0.8, 1.35, 2.5, 5.0}, every_density[] = {0.01, 0.3, 0.6, 0.9};

TEST(LennardJonesFluid, ThePublishedTestValuesAreFound) {
  // doi 10.1063/1.4945000, table of test values: T, density, pressure, residual energy and heat capacity, as printed
  const double table[][5] = {
      {0.8, 0.005, 0.0038430053, -0.054597389, 0.055672903}, {0.8, 0.8, 0.015894013, -5.7174120, 0.95995160},
      {1.0, 0.02, 0.017886470, -0.18772644, 0.13016045},     {1.0, 0.71, 0.075247483, -4.9564222, 0.68903536},
      {2.0, 0.5, 1.0751638, -3.1525021, 0.31068090},         {5.0, 0.6, 6.9432008, -2.6956781, 0.31772707},
      {7.0, 1.0, 41.531352, -0.62393078, 0.73348579}};
  for (const auto& [temperature, density, pressure, energy, heat_capacity] : table) {
    const ThermodynamicState state = LennardJonesFluid().at_temperature(density, temperature);
    EXPECT_NEAR(state.pressure, pressure, 6e-8 * std::max(0.1, pressure));
    EXPECT_NEAR(state.excess_energy(), energy, 6e-8);
    EXPECT_NEAR(state.heat_capacity - 1.5, heat_capacity, 6e-9);
  }
}

TEST(LennardJonesFluid, DerivativesAreDifferences) {
  for (const LennardJonesFluid& fluid : {LennardJonesFluid(), LennardJonesFluid(2.5)})
    for (const double t : every_temperature)
      for (const double rho : every_density) {
        const ThermodynamicState state = fluid.at_temperature(rho, t);
        const double by_density = slope([&](double x) { return fluid.at_temperature(x, t).pressure; }, rho, 2e-4 * rho);
        const double by_temperature = slope([&](double x) { return fluid.at_temperature(rho, x).pressure; }, t, 2e-4 * t);
        const double heat_capacity = slope([&](double x) { return fluid.at_temperature(rho, x).energy; }, t, 2e-4 * t);
        const double p =
            rho * t + rho * rho * slope([&](double x) { return fluid.residual_helmholtz_energy(x, t); }, rho, 2e-4 * rho);
        const double e = slope([&](double b) { return b * fluid.residual_helmholtz_energy(rho, 1.0 / b); }, 1.0 / t, 2e-4 / t);
        EXPECT_NEAR(state.pressure_by_density, by_density, 3e-8 * std::max(1.0, std::abs(by_density)));
        EXPECT_NEAR(state.pressure_by_temperature, by_temperature, 3e-8 * std::max(1.0, by_temperature));
        EXPECT_NEAR(state.heat_capacity, heat_capacity, 3e-8);
        EXPECT_NEAR(state.pressure, p, 3e-8 * std::max(1.0, std::abs(p)));
        EXPECT_NEAR(state.excess_energy(), e, 3e-8 * std::max(1.0, std::abs(e)));
      }
}

TEST(LennardJonesFluid, TheSoundVelocityIsTheSlopeOfPressureAlongAnIsentrope) {
  const LennardJonesFluid fluid;
  const ThermodynamicState start = fluid.at_temperature(0.6, 2.0);
  // Along an isentrope de = p/rho^2 d rho.
  const auto pressure = [&](double rho) {
    double energy = start.energy, density = start.density;
    const double step = (rho - density) / 64.0;
    for (int k = 0; k < 64; ++k, density += step) {
      const double first = energy + 0.5 * step * fluid.at_energy(density, energy, 2.0)->pressure / (density * density);
      const double middle = density + 0.5 * step;
      energy += step * fluid.at_energy(middle, first, 2.0)->pressure / (middle * middle);
    }
    return fluid.at_energy(rho, energy, 2.0)->pressure;
  };
  EXPECT_NEAR(std::sqrt(slope(pressure, 0.6, 1e-3)), start.sound_velocity(), 1e-7);
  EXPECT_NEAR(LennardJonesFluid(3.0).at_temperature(0.5, 2.5).sound_velocity(), 4.1221, 5e-5);
  EXPECT_NEAR(LennardJonesFluid(3.0).at_temperature(0.7, 2.5).sound_velocity(), 6.2924, 5e-5);
}

TEST(LennardJonesFluid, TheCutoffTakesItsMeanFieldFromEnergyAndPressure) {
  for (const auto& [cutoff, lost] : {std::pair(3.0, -0.6200), std::pair(2.5, -1.0694)}) {
    const ThermodynamicState whole = LennardJonesFluid().at_temperature(0.5, 2.5);
    const ThermodynamicState cut = LennardJonesFluid(cutoff).at_temperature(0.5, 2.5);
    EXPECT_NEAR(cut.energy, whole.energy - 0.5 * lost, 5e-5);
    EXPECT_NEAR(cut.pressure, whole.pressure - 0.25 * lost, 5e-5);
    EXPECT_EQ(cut.heat_capacity, whole.heat_capacity);
  }
  EXPECT_NEAR(LennardJonesFluid(1e6).at_temperature(0.5, 2.5).pressure, LennardJonesFluid().at_temperature(0.5, 2.5).pressure,
              1e-14);
}

TEST(LennardJonesFluid, TheEnergyGivesTheTemperatureBackFromAnyStart) {
  for (const LennardJonesFluid& fluid : {LennardJonesFluid(), LennardJonesFluid(3.0)})
    for (const double t : {0.9, 1.35, 2.5, 9.0, 19.0})
      for (const double rho : {1e-6, 0.02, 0.7, 0.9}) {
        const ThermodynamicState state = fluid.at_temperature(rho, t);
        for (const double near : {t, 1.01 * t, 0.6, 20.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
          const auto found = fluid.at_energy(rho, state.energy, near);
          ASSERT_TRUE(found.has_value()) << rho << ' ' << t << ' ' << near;
          EXPECT_NEAR(found->temperature, t, 1e-12 * t);
          EXPECT_NEAR(found->pressure, state.pressure, 1e-11 * std::max(1.0, state.pressure));
        }
      }
}

TEST(LennardJonesFluid, EnergiesWithoutATemperatureHaveNoState) {
  const LennardJonesFluid fluid;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [density, energy] : {std::pair(0.5, -20.0), std::pair(0.5, 40.0), std::pair(0.0, 1.0), std::pair(-0.1, 1.0),
                                        std::pair(1.6, 1.0), std::pair(nan, 1.0), std::pair(0.5, nan)})
    EXPECT_FALSE(fluid.at_energy(density, energy, 2.5).has_value()) << density << ' ' << energy;
}

TEST(LennardJonesFluid, InsideTheSpinodalAFluidIsUnstable) {
  EXPECT_FALSE(LennardJonesFluid().at_temperature(0.3, 1.0).stable());
  EXPECT_TRUE(LennardJonesFluid().at_temperature(0.3, 1.4).stable());
  EXPECT_TRUE(LennardJonesFluid().at_temperature(0.8, 1.0).stable());
}

TEST(LennardJonesFluid, StatesOutsideItsRangeAreRefused) {
  const LennardJonesFluid fluid;
  for (const double density : {0.0, -0.5, 1.6, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(refusal([&] { fluid.at_temperature(density, 2.5); }).find("density"), std::string::npos);
  for (const double temperature : {0.0, 0.59, 21.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(refusal([&] { fluid.at_temperature(0.5, temperature); }).find("temperature"), std::string::npos);
  for (const double cutoff : {0.0, 1.9, -3.0, 1e7})
    EXPECT_NE(refusal([&] { LennardJonesFluid{cutoff}; }).find("cutoff"), std::string::npos);
}

}  // namespace
}  // namespace lanescape
