#include "dynamics/event_driven.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "configuration/hard_sphere_model.hpp"
#include "configuration/lattice.hpp"
#include "core/error.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/hard_sphere_start.hpp"
#include "memory_archive.hpp"
#include "reference/event_driven.hpp"
#include "reference/hard_sphere.hpp"

namespace lanescape {
namespace {

Configuration fluid(const HardSphereModel& model, std::size_t particles, double packing_fraction) {
  SilentMonitor monitor;
  return *make_hard_sphere_start(model, particles, packing_fraction, StartMethod::growth, 1, available_isas().back(), monitor);
}

EventDriven moving(const Configuration& start, Isa isa = available_isas().back(), std::vector<double> masses = {}) {
  if (masses.empty()) masses.assign(start.size(), 1.0);
  EventDriven dynamics(start, std::move(masses), kernel_table(isa));
  dynamics.draw_velocities(3);
  return dynamics;
}

void collide(EventDriven& dynamics, std::uint64_t collisions) {
  for (std::uint64_t k = 0; k < collisions; ++k) dynamics.collide();
}

double smallest_gap(const EventDriven& dynamics) {
  const Configuration now = dynamics.configuration();
  return reference::smallest_gap(now.positions, now.radii, now.box.length);
}

std::vector<double> unequal_masses(std::size_t particles) {
  std::vector<double> masses;
  for (std::size_t i = 0; i < particles; ++i) masses.push_back(i % 3 == 0 ? 2.5 : 0.7);
  return masses;
}

// The contact value by Carnahan and Starling.
double contact_value(double phi) { return (1.0 - 0.5 * phi) / std::pow(1.0 - phi, 3); }

TEST(EventDriven, CollidesAsTheReferenceDoesWithUnequalMassesAndDiameters) {
  for (const double phi : {0.20, 0.45}) {
    const Configuration start = fluid(hard_sphere_binary(), 32, phi);
    const auto masses = unequal_masses(32);
    EventDriven dynamics = moving(start, available_isas().back(), masses);
    reference::EventDriven expected(dynamics.positions(), dynamics.velocities(), start.radii, masses, start.box.length);
    for (int k = 0; k < 150; ++k) {
      dynamics.collide();
      ASSERT_TRUE(expected.step(1e9));
      ASSERT_NEAR(dynamics.time(), expected.time(), 1e-9) << "collision " << k;
    }
    const auto positions = dynamics.positions();
    const auto there = expected.positions();
    for (std::size_t c = 0; c < positions.size(); ++c) {
      const double d = positions[c] - there[c], length = start.box.length[c % 3];
      EXPECT_NEAR(d - length * std::nearbyint(d / length), 0.0, 1e-7);
    }
    EXPECT_NEAR(dynamics.virial(), expected.virial(), 1e-7 * expected.virial());
  }
}

TEST(EventDriven, EveryInstructionSetMakesTheSameTrajectoryToTheBit) {
  const Configuration start = fluid(hard_sphere_binary(), 108, 0.50);
  EventDriven least = moving(start, available_isas().front());
  collide(least, 120'000);
  for (const Isa isa : available_isas()) {
    EventDriven dynamics = moving(start, isa);
    collide(dynamics, 120'000);
    EXPECT_EQ(dynamics.positions(), least.positions()) << to_string(isa);
    EXPECT_EQ(dynamics.velocities(), least.velocities()) << to_string(isa);
    EXPECT_EQ(dynamics.virial(), least.virial()) << to_string(isa);
  }
}

void expect_conserved(const Configuration& start, std::uint64_t collisions, std::vector<double> masses = {}) {
  EventDriven dynamics = moving(start, available_isas().back(), std::move(masses));
  const double energy = dynamics.kinetic_energy();
  double deepest = 0.0;
  for (std::uint64_t k = 0; k < collisions; k += 50'000) {
    collide(dynamics, 50'000);
    deepest = std::min(deepest, smallest_gap(dynamics));
  }
  EXPECT_GT(deepest, -1e-12);
  // Rounding errors accumulate like a random walk.
  EXPECT_NEAR(dynamics.kinetic_energy() / energy, 1.0, 1e-12 * std::max(1.0, std::sqrt(static_cast<double>(collisions) / 1e7)));
  for (const double p : dynamics.momentum()) EXPECT_NEAR(p, 0.0, 1e-10);
}

// 10^7 collisions in total: no overlap beyond rounding; energy and momentum are conserved.
TEST(EventDriven, TenMillionCollisionsLeaveNoOverlapAndConserveEnergyAndMomentum) {
  expect_conserved(fluid(hard_sphere(), 108, 0.49), 4'000'000);
  expect_conserved(fluid(hard_sphere_binary(), 108, 0.55), 4'000'000);
  expect_conserved(fluid(hard_sphere(), 32, 0.45), 1'000'000);
  expect_conserved(fluid(hard_sphere_binary(), 32, 0.05), 300'000, unequal_masses(32));
  expect_conserved(fluid(hard_sphere_binary(), 500, 0.58), 1'000'000);
}

// Runs under ctest's label long.
TEST(EventDriven, DISABLED_HundredMillionCollisionsLeaveNoOverlap) {
  expect_conserved(fluid(hard_sphere_binary(), 108, 0.55), 100'000'000);
}

TEST(EventDriven, TimeRunsBackwards) {
  const Configuration start = fluid(hard_sphere(), 64, 0.30);
  EventDriven dynamics = moving(start);
  const auto from = dynamics.positions();
  dynamics.advance_to(1.0);
  const auto collisions = dynamics.collisions();
  ASSERT_GT(collisions, 200U);
  auto velocities = dynamics.velocities();
  for (double& v : velocities) v = -v;
  dynamics.set_velocities(velocities);
  dynamics.advance_to(2.0);
  EXPECT_EQ(dynamics.collisions(), 2 * collisions);
  const auto back = dynamics.positions();
  // Ten collisions per particle amplify rounding by some powers of ten.
  for (std::size_t c = 0; c < back.size(); ++c) EXPECT_NEAR(back[c], from[c], 1e-6);
}

TEST(EventDriven, AStateReadAtAResynchronisationGoesOnWithTheSameBits) {
  const Configuration start = fluid(hard_sphere_binary(), 64, 0.45);
  EventDriven whole = moving(start), resumed = moving(start);
  collide(whole, whole.resync_interval());
  ASSERT_TRUE(whole.at_resync());
  testing::hand_on(whole, resumed);
  collide(whole, 30'000);
  collide(resumed, 30'000);
  EXPECT_EQ(resumed.positions(), whole.positions());
  EXPECT_EQ(resumed.velocities(), whole.velocities());
  EXPECT_EQ(resumed.collisions(), whole.collisions());
  EXPECT_EQ(resumed.virial(), whole.virial());
  EXPECT_EQ(resumed.time(), whole.time());
}

TEST(EventDriven, IsResynchronisedAtCountsThatSuitTheNumberOfParticles) {
  for (const auto& [particles, collisions] : {std::pair{100U, 25'600U}, {1'000U, 100'000U}, {30'000U, 120'000U}})
    EXPECT_EQ(EventDriven(hard_sphere_start(hard_sphere(), particles, 0.1, Arrangement::random, 1),
                          std::vector<double>(particles, 1.0), kernel_table(available_isas().back()))
                  .resync_interval(),
              collisions);
}

// A sphere that is outside the box by a rounding error belongs at the face. Wrapping twice gives the same result as wrapping once.
TEST(EventDriven, ResynchronisingTwiceIsOnce) {
  const Configuration start{Box{{4.0, 4.0, 4.0}}, {0, 0}, {-1e-17, 1.0, 4.0, 2.0, 2.0, 2.0}, {0.5, 0.5}};
  EventDriven once = moving(start);
  EventDriven twice = moving(start);
  twice.resynchronise();
  EXPECT_EQ(twice.positions(), once.positions());
  EXPECT_EQ(once.positions()[0], 0.0);
  collide(once, 1);
  collide(twice, 1);
  EXPECT_EQ(twice.positions(), once.positions());
}

struct Measured {
  double compressibility, error, rate;
};

// Measures in blocks; skips the first two.
Measured measure(const Configuration& start, std::uint64_t collisions_per_block, int blocks) {
  EventDriven dynamics = moving(start);
  collide(dynamics, 2 * collisions_per_block);
  double sum = 0.0, squares = 0.0;
  const double from = dynamics.time();
  for (int b = 0; b < blocks; ++b) {
    const double virial = dynamics.virial(), time = dynamics.time();
    collide(dynamics, collisions_per_block);
    const double z = dynamics.compressibility(virial, time);
    sum += z;
    squares += z * z;
  }
  const double n = static_cast<double>(dynamics.size()), mean = sum / blocks;
  const double temperature = n / (n - 1.0);  // for 3N - 3 degrees of freedom
  return {mean, std::sqrt((squares / blocks - mean * mean) / (blocks - 1)),
          2.0 * static_cast<double>(collisions_per_block) * blocks / n / (dynamics.time() - from) / std::sqrt(temperature)};
}

// Event-driven molecular dynamics of many more particles: github.com/macioosch/dynamo-hard-spheres-sim. Collision rates: 4 sqrt(pi)
// rho chi with Carnahan and Starling's contact value, which has an error of a few tenths of a per cent.
TEST(EventDriven, OneComponentHasThePublishedCompressibilityAndCollisionRate) {
  for (const auto& [phi, z] : {std::pair{0.30, 3.983994}, std::pair{0.45, 9.404065}, std::pair{0.47124, 10.76249}}) {
    const Measured m = measure(fluid(hard_sphere(), 2048, phi), 200'000, 12);
    EXPECT_LT(m.error, 1e-3 * z) << phi;
    EXPECT_NEAR(m.compressibility, z, 3.0 * m.error + 2e-4 * z) << phi;
    EXPECT_NEAR(m.rate, 4.0 * std::sqrt(std::numbers::pi) * 6.0 * phi / std::numbers::pi * contact_value(phi), 0.005 * m.rate)
        << phi;
  }
}

// The equation of state of Boublik, Mansoori, Carnahan, Starling and Leland at 0.50: 12.318.
TEST(EventDriven, TheBinaryMixtureHasTheCompressibilityOfItsEquationOfState) {
  const Measured m = measure(fluid(hard_sphere_binary(), 2048, 0.50), 200'000, 10);
  EXPECT_NEAR(m.compressibility, 12.318, 0.005 * 12.318);
}

TEST(EventDriven, RecordsBetweenEventsLieOnFreeFlight) {
  EventDriven dynamics = moving(fluid(hard_sphere(), 32, 0.20));
  collide(dynamics, 1000);
  const double now = dynamics.time(), next = dynamics.next_event_time();
  const auto velocities = dynamics.velocities();
  std::vector<double> begin, end;
  dynamics.positions(now, begin);
  dynamics.positions(next, end);
  for (std::size_t c = 0; c < begin.size(); ++c) EXPECT_NEAR(end[c] - begin[c], velocities[c] * (next - now), 1e-12);
}

TEST(EventDriven, BoxesInWhichASphereWouldMeetTwoImagesAreRefused) {
  Configuration start{Box{{2.0, 5.0, 5.0}}, {0, 0}, {0, 0, 0, 1, 2, 2}, {0.5, 0.5}};
  EXPECT_THROW(EventDriven(start, {1.0, 1.0}, kernel_table(available_isas().front())), Error);
}

}  // namespace
}  // namespace lanescape
