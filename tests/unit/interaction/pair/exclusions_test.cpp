#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

#include "configuration/lattice.hpp"
#include "core/error.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "neighbour/neighbour_list.hpp"
#include "verification/cases.hpp"
#include "verification/reference_bridge.hpp"

// Pairs that do not interact.
namespace lanescape {
namespace {

using Pairs = std::vector<std::array<std::size_t, 2>>;

const kernels::KernelTable& best_table() { return kernel_table(available_isas().back()); }

struct Result {
  PairInteraction::Evaluation sums;
  double energy = 0.0, sum_of_energies = 0.0;
  std::vector<double> gradient;
};

Result evaluate(const PairModel& model, const Configuration& configuration, const Pairs& excluded,
                const PairSearchOptions& options = {}) {
  const ParticleLayout layout = ParticleLayout::in_users_order(configuration, model.species.size());
  PairInteraction interaction(model, configuration.box, layout, best_table(), options);
  interaction.set_exclusions(excluded);
  const AlignedArray positions = layout.to_slots(configuration.positions);
  AlignedArray gradient(layout.dimension()), stress(layout.dimension()), energies(layout.slots());
  Result result;
  interaction.gradient(positions, gradient);
  const double with_gradient = interaction.energy_and_gradient(positions, stress).energy;
  EXPECT_EQ(stress, gradient);
  result.sums = interaction.energy_and_stress(positions, stress);
  EXPECT_TRUE(options.precision == Precision::mixed || stress == gradient);
  result.energy = interaction.energy(positions);
  EXPECT_EQ(with_gradient, result.energy);
  interaction.energies(positions, energies);
  result.sum_of_energies = std::accumulate(energies.begin(), energies.end(), 0.0);
  result.gradient = layout.to_user(gradient);
  return result;
}

// Bonds along chains of three, angles left in.
Pairs bonds(std::size_t particles) {
  Pairs pairs;
  for (std::size_t i = 0; i + 1 < particles; ++i)
    if (i % 3 != 2) pairs.push_back({i + i % 2, i + 1 - i % 2});
  return pairs;
}

Configuration two_of(const Configuration& all, std::size_t i, std::size_t j) {
  Configuration two{all.box, {all.species[i], all.species[j]}, {}};
  for (const std::size_t k : {i, j})
    for (const double x : all.position(k)) two.positions.push_back(x);
  if (!all.diameters.empty()) two.diameters = {all.diameters[i], all.diameters[j]};
  return two;
}

void expect_reference(const PairCase& one, const PairSearchOptions& options) {
  const Pairs pairs = bonds(one.configuration.size());
  auto expected = evaluate_reference(one.model, one.configuration);
  PairModel alone = one.model;
  alone.images = ImageRule::minimum;
  if (alone.truncation == Truncation::tail) alone.truncation = Truncation::plain;
  for (const auto& [i, j] : pairs) {
    const auto pair = evaluate_reference(alone, two_of(one.configuration, i, j));
    expected.energy -= pair.energy;
    expected.virial -= pair.virial;
    for (std::size_t k = 0; k < 6; ++k) expected.virial_tensor[k] -= pair.virial_tensor[k];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      expected.gradient[3 * i + axis] -= pair.gradient[axis];
      expected.gradient[3 * j + axis] -= pair.gradient[3 + axis];
    }
  }
  const Result result = evaluate(one.model, one.configuration, pairs, options);
  const double tolerance = 1e-12;
  EXPECT_NEAR(result.energy, expected.energy, tolerance * expected.magnitude) << one.name;
  EXPECT_NEAR(result.sum_of_energies, expected.energy, tolerance * expected.magnitude) << one.name;
  EXPECT_NEAR(result.sums.energy, expected.energy, tolerance * expected.magnitude) << one.name;
  EXPECT_NEAR(result.sums.virial, expected.virial, tolerance * expected.virial_magnitude) << one.name;
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(result.sums.virial_tensor[k], expected.virial_tensor[k], tolerance * expected.virial_magnitude) << one.name;
  for (std::size_t k = 0; k < result.gradient.size(); ++k)
    EXPECT_NEAR(result.gradient[k], expected.gradient[k], tolerance * expected.gradient_magnitude[k]) << one.name << ", " << k;
}

TEST(Exclusions, LeaveOutTheNearestImageOfTheirPairs) {
  for (const PairCase& one : pair_cases()) {
    if (one.configuration.size() > 300) continue;
    expect_reference(one, {});
    expect_reference(one, {.search = PairSearch::all_pairs});
  }
}

TEST(Exclusions, HoldForEveryForm) {
  for (const PairForm& form : pair_forms())
    for (const PairCase& one : form_cases(form)) expect_reference(one, {});
}

// E of all with one pair left out = E without one + E without the other - E without both.
TEST(Exclusions, MayLieAtOnePlace) {
  const PairModel model = kob_andersen();
  Configuration all = fcc_start(model, 500, 1.2, 1);
  const auto without = [&](const std::vector<std::size_t>& left_out) {
    Configuration rest{all.box, {}, {}};
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (std::find(left_out.begin(), left_out.end(), i) != left_out.end()) continue;
      rest.species.push_back(all.species[i]);
      for (const double x : all.position(i)) rest.positions.push_back(x);
    }
    return evaluate_reference(model, rest);
  };
  for (const double distance : {0.0, 1e-9, 0.1, 0.5}) {
    for (std::size_t axis = 0; axis < 3; ++axis) all.positions[3 * 7 + axis] = all.positions[axis] + distance * (axis == 1);
    for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
      const auto neither = without({0, 7});
      const double expected = without({0}).energy + without({7}).energy - neither.energy;
      const double tolerance = (precision == Precision::mixed ? 2e-6 : 1e-13) * (without({0}).magnitude + without({7}).magnitude);
      const Result result = evaluate(model, all, {{7, 0}}, {.precision = precision});
      EXPECT_NEAR(result.energy, expected, tolerance) << distance;
      EXPECT_NEAR(result.sum_of_energies, expected, tolerance) << distance;
    }
  }
}

TEST(Exclusions, OverAllPairsCostTheDigitsOfTheirOwnEnergy) {
  const PairModel model = lennard_jones();
  Configuration all = fcc_start(model, 108, 0.8, 1);
  for (const double distance : {0.1, 0.2, 0.5, 0.97}) {
    for (std::size_t axis = 0; axis < 3; ++axis) all.positions[3 * 7 + axis] = all.positions[axis] + distance * (axis == 1);
    const double lost = std::fabs(evaluate(model, all, {{0, 7}}, {.search = PairSearch::all_pairs}).energy -
                                  evaluate(model, all, {{0, 7}}, {.search = PairSearch::list}).energy);
    const double own = 4.0 * std::pow(distance, -12);
    EXPECT_LT(lost, 1e-14 * own + 1e-10) << distance;
  }
}

TEST(Exclusions, ReplaceThoseBefore) {
  const PairModel model = lennard_jones();
  const Configuration all = fcc_start(model, 108, 0.8, 1);
  const ParticleLayout layout = ParticleLayout::in_users_order(all, 1);
  PairInteraction interaction(model, all.box, layout, best_table());
  const AlignedArray positions = layout.to_slots(all.positions);
  const double none = interaction.energy(positions);
  interaction.set_exclusions(bonds(108));
  EXPECT_GT(std::fabs(interaction.energy(positions) - none), 1.0);
  EXPECT_NE(interaction.list(), nullptr);
  interaction.set_exclusions({});
  EXPECT_EQ(interaction.energy(positions), none);
  EXPECT_EQ(interaction.list(), nullptr);
}

TEST(Exclusions, StayWithABoxThatChanges) {
  const PairModel model = lennard_jones();
  Configuration all = fcc_start(model, 108, 0.8, 1);
  const ParticleLayout layout = ParticleLayout::in_users_order(all, 1);
  for (const PairSearch search : {PairSearch::automatic, PairSearch::all_pairs}) {
    PairInteraction interaction(model, all.box, layout, best_table(), {.search = search});
    interaction.set_exclusions(bonds(108));
    for (const double factor : {1.02, 1.5, 0.97}) {
      Configuration scaled = all;
      for (double& length : scaled.box.length) length *= factor;
      for (double& x : scaled.positions) x *= factor;
      interaction.set_box(scaled.box);
      const double expected = evaluate(model, scaled, bonds(108), {.search = search}).energy;
      EXPECT_NEAR(interaction.energy(layout.to_slots(scaled.positions)), expected, 1e-12 * std::fabs(expected)) << factor;
    }
  }
}

TEST(Exclusions, AreRefusedWhereTheyMakeNoSenseAndThenChangeNothing) {
  const PairModel model = lennard_jones();
  const Configuration all = fcc_start(model, 108, 0.8, 1);
  const ParticleLayout layout = ParticleLayout::in_users_order(all, 1);
  PairInteraction interaction(model, all.box, layout, best_table());
  const AlignedArray positions = layout.to_slots(all.positions);
  interaction.set_exclusions(bonds(108));
  const double before = interaction.energy(positions);
  const std::vector<Pairs> refused = {{{3, 3}}, {{3, 108}}, {{1, 2}, {5, 6}, {1, 2}}, {{1, 2}, {2, 1}}, {{std::size_t(-1), 0}}};
  for (const Pairs& pairs : refused) EXPECT_THROW(interaction.set_exclusions(pairs), Error);
  EXPECT_EQ(interaction.energy(positions), before);
}

}  // namespace
}  // namespace lanescape
