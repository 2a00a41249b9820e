#include "flow/constant_outside.hpp"

#include <gtest/gtest.h>

namespace lanescape {
namespace {

ConstantOutsideOptions options() {
  ConstantOutsideOptions options;
  FaceDemand demand;
  demand.pressure = 2.0;
  demand.mass_flux = 0.1;
  demand.velocity = {0.2, 0.0, 0.0};
  options.demands = {demand, demand};
  options.area = 10.0;
  options.counts_recoil = false;
  return options;
}

Outside::Reports reports(double velocity, double density = 0.5, double energy = 1.0) {
  FaceReport report;
  report.velocity = {velocity, 0.0, 0.0};
  report.density = density;
  report.energy_per_particle = energy;
  report.filling = 0.7;
  return {report, report};
}

TEST(ConstantOutside, AsksForTheSameWhateverHappens) {
  ConstantOutside outside(options());
  EXPECT_EQ(outside.begin(reports(0.0))[0].pressure, 2.0);
  EXPECT_EQ(outside.advance(reports(5.0), 1.0)[1].pressure, 2.0);
  EXPECT_EQ(outside.advance(reports(5.0), 1.0)[1].mass_flux, 0.1);
}

TEST(ConstantOutside, AnImpedanceTakesUpSoundFromEitherSide) {
  ConstantOutsideOptions with = options();
  with.impedance = 2.0;
  ConstantOutside outside(with);
  // Too slow a fluid is pushed at x = 0 and sucked at x = L.
  Outside::Demands demands = outside.begin(reports(0.1));
  EXPECT_NEAR(demands[0].pressure, 2.2, 1e-15);
  EXPECT_NEAR(demands[1].pressure, 1.8, 1e-15);
  for (int k = 0; k < 100; ++k) demands = outside.advance(reports(0.3), 0.1);
  EXPECT_NEAR(demands[0].pressure, 1.8, 1e-6);
  EXPECT_NEAR(demands[1].pressure, 2.2, 1e-6);
}

TEST(ConstantOutside, CountsWhatLeavingParticlesCarryAsPressure) {
  ConstantOutsideOptions with = options();
  with.counts_recoil = true;
  ConstantOutside outside(with);
  outside.begin(reports(0.2));
  Outside::Reports passed = reports(0.2);
  // 0.5 per area and time beyond what the mean flow carries, which is 0.1 * 0.2.
  for (FaceReport& report : passed) {
    report.impulse[0] = 2.0 * 10.0;
    report.momentum[0] = report.impulse[0] + 0.52 * 10.0;
  }
  Outside::Demands demands{};
  for (int k = 0; k < 100; ++k) demands = outside.advance(passed, 1.0);
  EXPECT_NEAR(demands[0].pressure, 1.5, 1e-9);
  EXPECT_NEAR(demands[1].pressure, 1.5, 1e-9);
  for (FaceReport& report : passed) report.filling = 0.9;
  for (int k = 0; k < 100; ++k) demands = outside.advance(passed, 1.0);
  EXPECT_NEAR(demands[0].pressure, 1.7, 1e-9);
}

TEST(ConstantOutside, HeatMakesUpForTheEnthalpyThatIsNotCarried) {
  ConstantOutsideOptions with = options();
  with.enthalpy = 6.0;
  ConstantOutside outside(with);
  outside.begin(reports(0.2));
  Outside::Reports passed = reports(0.2);
  for (FaceReport& report : passed) {
    report.particles = 2.0;
    report.energy = 9.0;
  }
  const Outside::Demands demands = outside.advance(passed, 1.0);
  // What enters at x = 0 should have brought 6 each; what left at x = L took what it has there, 1 + 2.0/0.5.
  EXPECT_NEAR(demands[0].heat_flux * 10.0, 12.0 - 9.0, 1e-12);
  EXPECT_NEAR(demands[1].heat_flux * 10.0, 10.0 - 9.0, 1e-12);
}

TEST(ConstantOutside, FillsTheSlabToADensity) {
  ConstantOutsideOptions with = options();
  with.density = 0.6;
  ConstantOutside outside(with);
  const Outside::Demands demands = outside.begin(reports(0.2));
  EXPECT_GT(demands[0].mass_flux, 0.1);
  EXPECT_LT(demands[1].mass_flux, 0.1);
}

}  // namespace
}  // namespace lanescape
