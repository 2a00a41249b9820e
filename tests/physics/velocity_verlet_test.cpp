#include "dynamics/velocity_verlet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "systems.hpp"

namespace lanescape {
namespace {

using testing::System;

struct Conservation {
  double drift = 0.0;        // of the total energy per particle, from a straight-line fit [epsilon]
  double fluctuation = 0.0;  // standard deviation about that line, per particle [epsilon]
};

// Runs at constant energy for `steps` steps and records the energy after each.
Conservation conservation(System& system, VelocityVerlet verlet, int steps) {
  std::vector<double> energy;
  for (int k = 0; k < steps; ++k) {
    verlet.step();
    energy.push_back((verlet.kinetic_energy() + verlet.potential_energy()) / static_cast<double>(system.layout.size()));
  }
  const double n = static_cast<double>(steps), middle = 0.5 * (n - 1.0), variance = (n * n - 1.0) / 12.0;
  double mean = 0.0, slope = 0.0, squares = 0.0;
  for (const double e : energy) mean += e / n;
  for (int k = 0; k < steps; ++k) slope += (k - middle) * (energy[static_cast<std::size_t>(k)] - mean) / (n * variance);
  for (int k = 0; k < steps; ++k) {
    const double off = energy[static_cast<std::size_t>(k)] - mean - slope * (k - middle);
    squares += off * off / n;
  }
  return {slope * n, std::sqrt(squares)};
}

// Total momentum along each axis.
std::array<double, 3> momentum(const System& system, const VelocityVerlet& verlet) {
  std::array<double, 3> sum{};
  const auto velocities = system.layout.to_user(verlet.velocity());
  for (std::size_t i = 0; i < system.layout.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum[axis] += system.model.species[static_cast<std::size_t>(system.configuration.species[i])].mass * velocities[3 * i + axis];
  return sum;
}

// Kinetic and potential energy must first equilibrate after a start.
VelocityVerlet settled(System& system, double temperature, double time_step) {
  VelocityVerlet verlet = system.moving(temperature, time_step);
  for (double t = 0.0; t < 2.0; t += time_step) verlet.step();
  verlet.rescale_to(temperature);
  return verlet;
}

TEST(VelocityVerlet, ConservesTheEnergyOfAKobAndersenLiquidOverTwentyThousandSteps) {
  System system(kob_andersen(), testing::molten_kob_andersen());
  const auto found = conservation(system, settled(system, 1.0, 1e-3), 20'000);
  EXPECT_LT(std::fabs(found.drift), 5e-4);  // a random walk: forces jump at the cutoff
  EXPECT_LT(found.fluctuation, 2e-4);
  EXPECT_GT(found.fluctuation, 1e-7);  // the particles do move
}

TEST(VelocityVerlet, FluctuationsOfTheEnergyFallWithTheSquareOfTheTimeStep) {
  // Both runs start from one state and are too short for the trajectories to diverge.
  System system(kob_andersen(), testing::molten_kob_andersen());
  const auto fluctuation = [&](double time_step, int steps) {
    return conservation(system, system.moving(1.0, time_step), steps).fluctuation;
  };
  EXPECT_NEAR(fluctuation(2e-3, 1000) / fluctuation(1e-3, 2000), 4.0, 0.8);
  EXPECT_NEAR(fluctuation(1e-3, 2000) / fluctuation(5e-4, 4000), 4.0, 0.8);
}

TEST(VelocityVerlet, TotalMomentumStaysZeroToRounding) {
  for (const double second : {1.0, 3.0}) {
    System system(testing::with_masses(kob_andersen(), 1.0, second), testing::molten_kob_andersen());
    VelocityVerlet verlet = system.moving(2.0);
    for (const double p : momentum(system, verlet)) EXPECT_NEAR(p, 0.0, 1e-12);
    for (int k = 0; k < 5000; ++k) verlet.step();
    for (const double p : momentum(system, verlet)) EXPECT_NEAR(p, 0.0, 1e-10);
  }
}

TEST(VelocityVerlet, ReversedVelocitiesLeadBackToTheStart) {
  System system(kob_andersen(), testing::molten_kob_andersen());
  VelocityVerlet verlet = system.moving(1.0);
  const AlignedArray start = verlet.position();
  for (int k = 0; k < 1000; ++k) verlet.step();
  EXPECT_GT(system.landscape.algebra().distance(verlet.position(), start), 1.0);
  verlet.reverse_velocities();
  for (int k = 0; k < 1000; ++k) verlet.step();
  EXPECT_LT(system.landscape.algebra().distance(verlet.position(), start), 1e-8);
}

TEST(VelocityVerlet, UnequalMassesConserveEnergy) {
  System system(testing::with_masses(kob_andersen(), 1.0, 3.0), testing::molten_kob_andersen());
  const auto found = conservation(system, settled(system, 1.0, 1e-3), 10'000);
  EXPECT_LT(std::fabs(found.drift), 5e-4);  // a random walk: forces jump at the cutoff
  EXPECT_LT(found.fluctuation, 2e-4);
}

TEST(VelocityVerlet, HeavyParticlesAreAcceleratedByForceOverMass) {
  System system(testing::with_masses(kob_andersen(), 1.0, 3.0), testing::molten_kob_andersen());
  VelocityVerlet verlet(system.landscape, system.model, system.layout, system.start(), 1e-3);
  AlignedArray gradient(system.layout.dimension());
  system.landscape.energy_and_gradient(system.start(), gradient);
  const auto g = system.layout.to_user(gradient);
  verlet.step();
  const auto moved = system.layout.to_user(verlet.position());
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const double mass = system.configuration.species[k / 3] == 0 ? 1.0 : 3.0;
    EXPECT_NEAR(moved[k] - system.configuration.positions[k], -0.5e-6 * g[k] / mass, 1e-14);
  }
}

TEST(VelocityVerlet, ScalingReachesTheTemperatureExactlyInTheConventionOfThreeN) {
  System system(testing::with_masses(kob_andersen(), 1.0, 3.0), testing::molten_kob_andersen());
  VelocityVerlet verlet = system.moving(1.0);
  for (const double temperature : {5.0, 1.0, 0.466}) {
    for (int k = 0; k < 100; ++k) verlet.step();
    EXPECT_GT(std::fabs(verlet.temperature() - temperature), 1e-4);
    verlet.rescale_to(temperature);
    EXPECT_NEAR(verlet.temperature(), temperature, 1e-13 * temperature);
    double twice = 0.0;
    const auto velocities = system.layout.to_user(verlet.velocity());
    for (std::size_t k = 0; k < velocities.size(); ++k)
      twice += (system.configuration.species[k / 3] == 0 ? 1.0 : 3.0) * velocities[k] * velocities[k];
    EXPECT_NEAR(twice / (3.0 * 108.0), temperature, 1e-12 * temperature);
  }
}

TEST(VelocityVerlet, DrawnVelocitiesFollowMaxwellForEachSpecies) {
  System system(testing::with_masses(kob_andersen(), 1.0, 3.0), testing::molten_kob_andersen());
  double mean_square[2] = {}, fourth[2] = {}, count[2] = {};
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto velocities = system.layout.to_user(system.moving(1.5, 1e-3, seed).velocity());
    for (std::size_t k = 0; k < velocities.size(); ++k) {
      const auto s = static_cast<std::size_t>(system.configuration.species[k / 3]);
      const double v2 = velocities[k] * velocities[k];
      mean_square[s] += v2, fourth[s] += v2 * v2, count[s] += 1.0;
    }
  }
  for (std::size_t s = 0; s < 2; ++s) {
    const double mass = system.model.species[s].mass;
    EXPECT_NEAR(mass * mean_square[s] / count[s], 1.5, 0.06);
    EXPECT_NEAR(fourth[s] * count[s] / (mean_square[s] * mean_square[s]), 3.0, 0.15);
  }
}

TEST(VelocityVerlet, PaddingStaysAtZero) {
  System system(testing::with_masses(kob_andersen(), 1.0, 3.0), testing::molten_kob_andersen());
  VelocityVerlet verlet = system.moving(1.0);
  for (int k = 0; k < 100; ++k) verlet.step();
  double all = 0.0, particles = 0.0;
  for (const double x : verlet.position()) all += std::fabs(x);
  for (const double x : system.layout.to_user(verlet.position())) particles += std::fabs(x);
  EXPECT_GT(system.layout.slots(), system.layout.size());
  EXPECT_NEAR(all, particles, 1e-9);
}

}  // namespace
}  // namespace lanescape
