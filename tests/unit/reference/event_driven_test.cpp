#include "reference/event_driven.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "hard_spheres.hpp"

namespace {

using namespace lanescape::reference;

struct Gas {
  Point positions;
  Point velocities;
  std::vector<double> radii;
  std::vector<double> masses;
  Vector box;
};

/// 32 spheres of diameter 1 on fcc sites; Maxwellian velocities, total momentum zero.
Gas gas(double packing_fraction, unsigned seed) {
  Gas result;
  const double edge = std::cbrt(32.0 * std::numbers::pi / 6.0 / packing_fraction);
  result.box = {edge, edge, edge};
  const std::array<Vector, 4> basis{{{0.0, 0.0, 0.0}, {0.0, 0.5, 0.5}, {0.5, 0.0, 0.5}, {0.5, 0.5, 0.0}}};
  for (int cell = 0; cell < 8; ++cell)
    for (const Vector& site : basis)
      for (std::size_t axis = 0; axis < 3; ++axis)
        result.positions.push_back(0.5 * edge * (site[axis] + static_cast<double>((cell >> axis) & 1)));
  result.radii.assign(32, 0.5);
  result.masses.assign(32, 1.0);
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  for (std::size_t k = 0; k < 96; ++k) result.velocities.push_back(normal(engine));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double mean = 0.0;
    for (std::size_t k = axis; k < 96; k += 3) mean += result.velocities[k] / 32.0;
    for (std::size_t k = axis; k < 96; k += 3) result.velocities[k] -= mean;
  }
  return result;
}

TEST(ReferenceEventDriven, EventDrivenDynamicsKeepsEnergyMomentumAndDistance) {
  Gas start = gas(0.3, 4);
  for (std::size_t j = 0; j < 32; j += 2) start.masses[j] = 3.0;
  EventDriven simulation(start.positions, start.velocities, start.radii, start.masses, start.box);
  const auto momentum = [&](std::size_t axis) {
    double sum = 0.0;
    for (std::size_t j = 0; j < 32; ++j) sum += start.masses[j] * simulation.velocities()[3 * j + axis];
    return sum;
  };
  const double energy = simulation.kinetic_energy();
  const Vector before{momentum(0), momentum(1), momentum(2)};
  for (int k = 0; k < 2000; ++k) {
    ASSERT_TRUE(simulation.step(1e3));
    ASSERT_GT(smallest_gap(simulation.positions(), start.radii, start.box), -1e-12);
  }
  EXPECT_EQ(simulation.collisions(), 2000);
  EXPECT_NEAR(simulation.kinetic_energy(), energy, 1e-11 * energy);
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(momentum(axis), before[axis], 1e-11);
}

TEST(ReferenceEventDriven, EventDrivenDynamicsStopsAtTheGivenTimeWithoutACollision) {
  EventDriven simulation(Point{0.0, 0.0, 0.0, 2.0, 0.0, 0.0}, Point{0.0, 0.0, 0.0, -1.0, 0.0, 0.0}, Point{0.5, 0.5},
                         Point{1.0, 1.0}, kBox);
  EXPECT_FALSE(simulation.step(0.5));
  EXPECT_EQ(simulation.time(), 0.5);
  EXPECT_EQ(simulation.positions()[3], 1.5);
  EXPECT_TRUE(simulation.step(2.0));
  EXPECT_EQ(simulation.time(), 1.0);
  EXPECT_EQ(simulation.velocities(), (Point{-1.0, 0.0, 0.0, 0.0, 0.0, 0.0}));
  EXPECT_FALSE(simulation.step(1.0));  // time does not go back, and no collision happens twice
  EXPECT_EQ(simulation.time(), 1.0);
}

TEST(ReferenceEventDriven, RunningTheVelocitiesBackwardsReturnsToTheStart) {
  const Gas start = gas(0.3, 5);
  EventDriven there(start.positions, start.velocities, start.radii, start.masses, start.box);
  const double duration = 0.4;  // about thirty collisions; rounding errors grow by e per collision of a particle
  while (there.step(duration)) {
  }
  ASSERT_GT(there.collisions(), 20);
  Point reversed = there.velocities();
  for (double& v : reversed) v = -v;
  EventDriven back(there.positions(), reversed, start.radii, start.masses, start.box);
  while (back.step(duration)) {
  }
  EXPECT_EQ(back.collisions(), there.collisions());
  const Point end = back.positions();
  for (std::size_t k = 0; k < end.size(); ++k) EXPECT_NEAR(end[k], start.positions[k], 1e-9);
}

/// Contact value of the pair distribution by Carnahan and Starling; Z = 1 + 4 phi g.
double contact_value(double phi) { return (1.0 - 0.5 * phi) / std::pow(1.0 - phi, 3); }

/// The same in a periodic box of n spheres: Lebowitz and Percus, g_n = g - S(0)/(2n) d^2(phi^2 g)/dphi^2. At low density the
/// factor is 1 - 1/n, because a sphere does not collide with itself.
double contact_value(double phi, double n) {
  const double h = 1e-3;
  const auto y = [](double x) { return x * x * contact_value(x); };
  const double curvature = (y(phi + h) - 2.0 * y(phi) + y(phi - h)) / (h * h);
  const double s0 = std::pow(1.0 - phi, 4) / (std::pow(1.0 + 2.0 * phi, 2) + std::pow(phi, 3) * (phi - 4.0));
  return contact_value(phi) - s0 / (2.0 * n) * curvature;
}

TEST(ReferenceEventDriven, PressureAndCollisionRateOfTheFluidAreThoseOfCarnahanAndStarling) {
  for (const double phi : {0.1, 0.2}) {
    const Gas start = gas(phi, 6);
    EventDriven simulation(start.positions, start.velocities, start.radii, start.masses, start.box);
    const double temperature = 2.0 * simulation.kinetic_energy() / 93.0;
    for (int k = 0; k < 2000; ++k) ASSERT_TRUE(simulation.step(1e6));  // 125 collisions of each particle melt the crystal

    const int blocks = 20;
    const double n = 32.0;
    double sum = 0.0, squares = 0.0, rates = 0.0, rate_squares = 0.0;
    for (int block = 0; block < blocks; ++block) {
      const double time = simulation.time();
      const double virial = simulation.virial();
      for (int k = 0; k < 2000; ++k) ASSERT_TRUE(simulation.step(1e6));
      const double duration = simulation.time() - time;
      const double excess = (simulation.virial() - virial) / (3.0 * n * temperature * duration);
      const double rate = 2000.0 / duration;
      sum += excess / blocks;
      squares += excess * excess / blocks;
      rates += rate / blocks;
      rate_squares += rate * rate / blocks;
    }
    const double error = std::sqrt((squares - sum * sum) / (blocks - 1));
    const double rate_error = std::sqrt((rate_squares - rates * rates) / (blocks - 1));
    // Z - 1 = 4 phi g; Enskog's rate is N/2 times 4 rho g sqrt(pi T). Errors are from blocks, about 0.5 %, so that
    // four of them are less than the 3 % between 3N and 3N - 3.
    const double expected = 4.0 * phi * contact_value(phi, n);
    const double rho = 6.0 * phi / std::numbers::pi;
    const double expected_rate = 2.0 * n * rho * contact_value(phi, n) * std::sqrt(std::numbers::pi * temperature);
    EXPECT_LT(error, 0.01 * expected);
    EXPECT_LT(rate_error, 0.01 * expected_rate);
    EXPECT_NEAR(sum, expected, 4.0 * error);
    EXPECT_NEAR(rates, expected_rate, 4.0 * rate_error);
    EXPECT_NEAR(simulation.compressibility(), 1.0 + expected, 0.03 * expected);  // with the time before melting
  }
}

TEST(ReferenceEventDriven, InputThatDoesNotFitIsRefused) {
  const Point two(6, 0.0), apart{0.0, 0.0, 0.0, 2.0, 0.0, 0.0};
  EXPECT_THROW(EventDriven(two, two, Point{0.5, 0.5}, Point{1.0, 1.0}, kBox), std::invalid_argument);  // both at one point
  EXPECT_THROW(EventDriven(apart, two, Point{0.5, 0.5}, Point{1.0}, kBox), std::invalid_argument);
}

}  // namespace
