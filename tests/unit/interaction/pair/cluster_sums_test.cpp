#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <tuple>

#include "configuration/lattice.hpp"
#include "core/error.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "memory_archive.hpp"

// Mixed precision over clusters, against double precision over a list of neighbours.
namespace lanescape {
namespace {

constexpr PairSearchOptions in_clusters(int threads = 1) {
  return {.search = PairSearch::clusters, .threads = threads, .precision = Precision::mixed};
}

struct Liquid {
  PairModel model = kob_andersen();
  Configuration configuration = rattled(fcc_start(model, 1372, 1.2, 1));
  ParticleLayout layout{configuration.species, 2};

  static Configuration rattled(Configuration configuration) {
    std::mt19937_64 engine(3);
    std::uniform_real_distribution<double> move(-0.08, 0.08);
    for (double& x : configuration.positions) x += move(engine);
    return configuration;
  }
  PairInteraction interaction(const PairSearchOptions& options) const {
    return {model, configuration.box, layout, kernel_table(available_isas().back()), options};
  }
  AlignedArray positions() const { return layout.to_slots(configuration.positions); }
};

struct Result {
  double energy, virial;
  AlignedArray gradient;
};

Result evaluate(PairInteraction& interaction, const AlignedArray& positions) {
  Result result{0.0, 0.0, AlignedArray(positions.size(), 0.0)};
  const auto sums = interaction.energy_and_gradient(positions, result.gradient);
  return {sums.energy, sums.virial, result.gradient};
}

void expect_near(const Result& found, const Result& expected) {
  // A few epsilon per particle, of both signs.
  EXPECT_NEAR(found.energy, expected.energy, 1e-6 * static_cast<double>(expected.gradient.size()));
  double largest = 0.0, error = 0.0;
  for (std::size_t k = 0; k < expected.gradient.size(); ++k) {
    largest = std::max(largest, std::fabs(expected.gradient[k]));
    error = std::max(error, std::fabs(found.gradient[k] - expected.gradient[k]));
  }
  EXPECT_LT(error, 3e-6 * largest);
}

void expect_same(const Result& a, const Result& b) {
  EXPECT_EQ(a.energy, b.energy);
  EXPECT_EQ(a.virial, b.virial);
  EXPECT_EQ(a.gradient, b.gradient);
}

// Moves each particle by up to `length` along each axis.
void walk(AlignedArray& positions, const ParticleLayout& layout, double length, std::mt19937_64& engine) {
  std::uniform_real_distribution<double> move(-length, length);
  for (std::size_t i = 0; i < layout.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) positions[axis * layout.slots() + layout.slot_of(i)] += move(engine);
}

TEST(ClusterSums, FollowMovingParticlesAsANeighbourListDoes) {
  const Liquid liquid;
  PairInteraction clusters = liquid.interaction(in_clusters()), list = liquid.interaction({.search = PairSearch::list});
  const AlignedArray start = liquid.positions();
  const std::size_t slots = liquid.layout.slots();
  for (int step = 0; step < 60; ++step) {
    // A flow along x that shears neighbours past each other slowly.
    AlignedArray positions = start;
    for (std::size_t i = 0; i < liquid.layout.size(); ++i) {
      const std::size_t slot = liquid.layout.slot_of(i);
      positions[slot] += 0.02 * step * std::sin(2.0 * std::numbers::pi * start[slots + slot] / liquid.configuration.box.length[1]);
    }
    expect_near(evaluate(clusters, positions), evaluate(list, positions));
  }
  EXPECT_LT(clusters.rebuilds(), list.rebuilds());
  EXPECT_GT(clusters.rebuilds(), 1U);
}

TEST(ClusterSums, HaveTheSameBitsOnAnyNumberOfThreadsAndAfterPruningAtAnyTime) {
  const Liquid liquid;
  PairInteraction one = liquid.interaction(in_clusters(1)), three = liquid.interaction(in_clusters(3)),
                  often = liquid.interaction(in_clusters(2));
  AlignedArray positions = liquid.positions();
  std::mt19937_64 engine(6);
  for (int step = 0; step < 12; ++step) {
    const Result result = evaluate(one, positions);
    expect_same(result, evaluate(three, positions));
    EXPECT_EQ(one.energy(positions), result.energy);
    if (step % 4 == 0) expect_same(result, evaluate(often, positions));
    AlignedArray gradient(positions.size(), 0.0);
    one.gradient(positions, gradient);
    EXPECT_EQ(gradient, result.gradient);
    walk(positions, liquid.layout, 0.01, engine);
  }
  EXPECT_EQ(one.rebuilds(), 1U);
}

TEST(ClusterSums, ResumeWithTheSameBits) {
  const Liquid liquid;
  PairInteraction whole = liquid.interaction(in_clusters()), resumed = liquid.interaction(in_clusters(2));
  AlignedArray positions = liquid.positions();
  std::mt19937_64 engine(7);
  const auto on = [&](PairInteraction& interaction, int steps) {
    for (int step = 0; step < steps; ++step) {
      walk(positions, liquid.layout, 0.02, engine);
      evaluate(interaction, positions);
    }
  };
  on(whole, 17);
  testing::hand_on(whole, resumed);
  for (int step = 0; step < 10; ++step) {
    expect_same(evaluate(whole, positions), evaluate(resumed, positions));
    walk(positions, liquid.layout, 0.05, engine);
  }
}

TEST(ClusterSums, StandWholeBoxesAndChangesOfTheBox) {
  const Liquid liquid;
  PairInteraction clusters = liquid.interaction(in_clusters()), list = liquid.interaction({.search = PairSearch::list});
  AlignedArray positions = liquid.positions();
  const double edge = liquid.configuration.box.length[0];
  for (std::size_t i = 0; i < liquid.layout.size(); i += 7) {
    evaluate(clusters, positions);
    positions[liquid.layout.slot_of(i)] += i % 2 == 0 ? edge : -2.0 * edge;
    if (i % 21 == 0) expect_near(evaluate(clusters, positions), evaluate(list, positions));
  }
  EXPECT_EQ(clusters.rebuilds(), 1U);
  for (const double factor : {1.001, 0.998, 1.35}) {
    Box box = liquid.configuration.box;
    for (double& length : box.length) length *= factor;
    AlignedArray stretched = positions;
    for (double& x : stretched) x *= factor;
    clusters.set_box(box);
    list.set_box(box);
    expect_near(evaluate(clusters, stretched), evaluate(list, stretched));
  }
  EXPECT_GT(clusters.rebuilds(), 1U);
}

TEST(ClusterSums, GiveStressesInDoublePrecisionAndEnergiesOfParticles) {
  const Liquid liquid;
  PairInteraction clusters = liquid.interaction(in_clusters()), list = liquid.interaction({.search = PairSearch::list});
  const AlignedArray positions = liquid.positions();
  AlignedArray gradient(positions.size(), 0.0), expected = gradient, energies(liquid.layout.slots(), 0.0);
  const auto found = clusters.energy_and_stress(positions, gradient), wanted = list.energy_and_stress(positions, expected);
  EXPECT_EQ(found.virial_tensor, wanted.virial_tensor);
  EXPECT_EQ(gradient, expected);
  clusters.energies(positions, energies);
  double sum = 0.0;
  for (const double energy : energies) sum += energy;
  EXPECT_NEAR(sum, wanted.energy, 1e-6 * std::fabs(wanted.energy));
}

TEST(ClusterSums, AreRefusedWhereTheyCannotBe) {
  const Liquid liquid;
  EXPECT_THROW(liquid.interaction({.search = PairSearch::clusters}), Error);
  PairModel wide = liquid.model;
  wide.cutoff = 5.0;
  const auto& [model, configuration, layout] = liquid;
  EXPECT_THROW(PairInteraction(wide, configuration.box, layout, kernel_table(available_isas().back()), in_clusters()), Error);
}

TEST(ClusterSums, AreTakenInLargeSystemsWithoutExclusions) {
  for (const auto& [large, few, many] : {std::tuple{kob_andersen(), 4000u, 6912u}, std::tuple{lennard_jones(), 2048u, 4000u}}) {
    const auto automatic = [&model = large](std::size_t particles) {
      const Configuration start = fcc_start(model, particles, 1.2, 1);
      return PairInteraction(model, start.box, ParticleLayout(start.species, model.species.size()),
                             kernel_table(available_isas().back()), {.precision = Precision::mixed});
    };
    EXPECT_NE(automatic(few).list(), nullptr);
    PairInteraction over_clusters = automatic(many);
    EXPECT_EQ(over_clusters.list(), nullptr);
    EXPECT_TRUE(over_clusters.has_list());
    over_clusters.set_exclusions(std::vector<std::array<std::size_t, 2>>{{0, 1}});
    EXPECT_NE(over_clusters.list(), nullptr);
  }
}

TEST(ClusterSums, RefuseCoordinatesThatAreNotFinite) {
  const Liquid liquid;
  PairInteraction clusters = liquid.interaction(in_clusters());
  AlignedArray positions = liquid.positions();
  evaluate(clusters, positions);
  positions[5] = std::nan("");
  EXPECT_THROW(evaluate(clusters, positions), Error);
}

}  // namespace
}  // namespace lanescape
