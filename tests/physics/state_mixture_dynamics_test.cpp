#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "dispatch/isa.hpp"
#include "dynamics/langevin.hpp"
#include "dynamics/velocity_verlet.hpp"
#include "landscape/state_mixture_landscape.hpp"
#include "memory_archive.hpp"
#include "refusal.hpp"
#include "verification/state_mixture_cases.hpp"

namespace lanescape {
namespace {

using Filter = StateMixtureVariant::Filter;
using Potentials = StateMixtureVariant::Potentials;

Isa isa() { return choose_isa("auto"); }

struct System {
  StateMixtureModel model;
  Configuration configuration;
  ParticleLayout layout;
  StateMixtureLandscape landscape;

  System(const StateMixtureVariant& variant, std::size_t n, const StateMixture::Options& options = {})
      : model(state_mixture_model(variant)),
        configuration(state_mixture_fluid(n, variant.species)),
        layout(configuration.species, variant.species),
        landscape(model, configuration.box, layout, isa(), options) {}
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  AlignedArray start() const { return layout.to_slots(configuration.positions); }
};

// Drift of the total energy per particle over `time`, from a straight-line fit.
double drift(System& system, double temperature, double time_step, double time) {
  VelocityVerlet verlet(system.landscape, system.model, system.layout, system.start(), time_step);
  verlet.draw_velocities(temperature, 1);
  for (double t = 0.0; t < 2.0; t += time_step) verlet.step();
  verlet.rescale_to(temperature);
  std::vector<double> energy;
  for (double t = 0.0; t < time; t += time_step) {
    verlet.step();
    energy.push_back((verlet.kinetic_energy() + verlet.potential_energy()) / static_cast<double>(system.layout.size()));
  }
  const auto n = static_cast<double>(energy.size());
  double mean = 0.0, slope = 0.0;
  for (const double e : energy) mean += e / n;
  for (std::size_t k = 0; k < energy.size(); ++k) slope += (static_cast<double>(k) - 0.5 * (n - 1.0)) * (energy[k] - mean);
  return slope / (n * (n * n - 1.0) / 12.0) * n;
}

TEST(StateMixtureDynamics, ConservesEnergyWithForcesThatEndSmoothly) {
  for (const Filter filter : {Filter::every, Filter::asymmetric}) {
    System system({2, 2, filter, Potentials::tables, 0.6}, 216);
    EXPECT_LT(std::abs(drift(system, 1.0, 2e-3, 20.0)), 2e-5) << static_cast<int>(filter);
  }
}

TEST(StateMixtureDynamics, ConservesEnergyAsLennardJonesDoes) {
  for (const std::size_t states : {2U, 3U}) {
    System system({1, states, Filter::every, Potentials::lennard_jones, 0.6}, 216);
    // A random walk: Lennard-Jones forces jump at the cutoff.
    EXPECT_LT(std::abs(drift(system, 1.0, 2e-3, 20.0)), 1e-3) << states;
  }
}

TEST(StateMixtureDynamics, TrajectoriesDoNotDependOnWhenOutputIsWanted) {
  const auto run = [](int interval) {
    System system({1, 2, Filter::every, Potentials::lennard_jones, 0.6}, 125);
    VelocityVerlet verlet(system.landscape, system.model, system.layout, system.start(), 2e-3);
    verlet.draw_velocities(1.0, 1);
    for (int k = 1; k <= 300; ++k) {
      verlet.step();
      if (k % interval == 0) verlet.potential_energy();
    }
    return verlet.position();
  };
  const AlignedArray every = run(1);
  EXPECT_EQ(every, run(7));
  EXPECT_EQ(every, run(1000));
}

TEST(StateMixtureDynamics, TrajectoriesDoNotDependOnTheNumberOfThreads) {
  const auto run = [](int threads) {
    StateMixture::Options options;
    options.threads = threads;
    System system({2, 3, Filter::asymmetric, Potentials::both, 0.6}, 512, options);
    Langevin langevin(system.landscape, system.model, system.layout, system.start(), {1.0, 1.0, 2e-3, 3});
    for (int k = 0; k < 100; ++k) langevin.step();
    return langevin.position();
  };
  EXPECT_EQ(run(1), run(3));
}

TEST(StateMixtureDynamics, EnergyIsTheSameBitsWithAndWithoutGradient) {
  System system({1, 2, Filter::every, Potentials::both, 0.6}, 125);
  Langevin langevin(system.landscape, system.model, system.layout, system.start(), {1.0, 1.0, 2e-3, 1});
  AlignedArray gradient(system.layout.dimension());
  for (int k = 0; k < 100; ++k) {
    langevin.step();
    EXPECT_EQ(system.landscape.energy(langevin.position()), system.landscape.energy_and_gradient(langevin.position(), gradient));
  }
}

// Independent springs, k = 4 along every axis: V = 2 R^2.
class Springs final : public SoftLandscape {
 public:
  explicit Springs(const ParticleLayout& layout) : layout_(&layout), algebra_(kernel_table(isa()), 1) {}
  std::size_t dimension() const override { return layout_->dimension(); }
  std::size_t particles() const override { return layout_->size(); }
  const VectorAlgebra& algebra() const override { return algebra_; }
  double energy(const AlignedArray& r) override { return 2.0 * algebra_.dot(r, r); }
  double energy_and_gradient(const AlignedArray& r, AlignedArray& g) override {
    for (std::size_t k = 0; k < r.size(); ++k) g[k] = 4.0 * r[k];
    return energy(r);
  }

 private:
  const ParticleLayout* layout_;
  VectorAlgebra algebra_;
};

TEST(Langevin, SpringsAreExtendedAsTheTemperatureSaysAtAnyTimeStep) {
  const ParticleLayout layout(std::vector<int>(400, 0), 1);
  Mixture one;
  one.species = {{"Ar", 2.0, 1.0}};
  const double temperature = 0.7;
  for (const double time_step : {0.1, 0.02}) {  // omega dt = 0.14
    Springs springs(layout);
    Langevin langevin(springs, one, layout, AlignedArray(layout.dimension(), 0.0), {temperature, 2.0, time_step, 5});
    double squares = 0.0, kinetic = 0.0;
    const int settle = static_cast<int>(10.0 / time_step), steps = 4000;
    for (int k = 0; k < settle + steps; ++k) {
      langevin.step();
      if (k < settle) continue;
      squares += springs.algebra().dot(langevin.position(), langevin.position()) / (1200.0 * steps);
      kinetic += langevin.temperature() / steps;
    }
    // <x^2> = T/k: 1200 springs over at least about 100 correlation times, so the error is below half a per cent.
    EXPECT_NEAR(squares, temperature / 4.0, 0.01 * temperature / 4.0) << time_step;
    EXPECT_NEAR(kinetic, temperature, 0.015 * temperature) << time_step;
  }
}

TEST(Langevin, KeepsALiquidAtItsTemperature) {
  System system({1, 2, Filter::every, Potentials::lennard_jones, 0.6}, 512);
  Langevin langevin(system.landscape, system.model, system.layout, system.start(), {1.2, 1.0, 4e-3, 1});
  double mean = 0.0;
  for (int k = 0; k < 3000; ++k) {
    langevin.step();
    if (k >= 1000) mean += langevin.temperature() / 2000.0;
  }
  EXPECT_NEAR(mean, 1.2, 0.024);
}

TEST(Langevin, ResumedEndsWithTheBitsOfAnUninterruptedRun) {
  const StateMixtureVariant variant{2, 2, Filter::asymmetric, Potentials::both, 0.6};
  const LangevinOptions options{1.0, 1.0, 4e-3, 2};
  System whole(variant, 216), half(variant, 216), rest(variant, 216);
  Langevin uninterrupted(whole.landscape, whole.model, whole.layout, whole.start(), options);
  for (int k = 0; k < 200; ++k) uninterrupted.step();
  Langevin before(half.landscape, half.model, half.layout, half.start(), options);
  for (int k = 0; k < 93; ++k) before.step();
  Langevin after(rest.landscape, rest.model, rest.layout, rest.start(), options);
  testing::hand_on(before, after);
  while (after.steps() < 200) after.step();
  EXPECT_EQ(after.position(), uninterrupted.position());
  EXPECT_EQ(after.velocity(), uninterrupted.velocity());
}

TEST(Langevin, SeedsDecideTheNoise) {
  const auto run = [](std::uint64_t seed) {
    System system({1, 2}, 64);
    Langevin langevin(system.landscape, system.model, system.layout, system.start(), {1.0, 1.0, 2e-3, seed});
    for (int k = 0; k < 20; ++k) langevin.step();
    return langevin.position();
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

TEST(Langevin, RefusesWhatMakesNoSense) {
  EXPECT_NE(testing::refusal([] { LangevinOptions{0.0, 1.0, 1e-3, 1}.check(); }).find("temperature"), std::string::npos);
  EXPECT_NE(testing::refusal([] { LangevinOptions{1.0, -1.0, 1e-3, 1}.check(); }).find("friction"), std::string::npos);
  EXPECT_NE(testing::refusal([] { LangevinOptions{1.0, 1.0, 0.5, 1}.check(); }).find("time step"), std::string::npos);
}

}  // namespace
}  // namespace lanescape
