#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "configuration/lattice.hpp"
#include "core/error.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/state/state_mixture.hpp"
#include "memory_archive.hpp"
#include "neighbour/neighbour_list.hpp"
#include "verification/cases.hpp"
#include "verification/reference_bridge.hpp"
#include "verification/state_mixture_cases.hpp"

// Boxes that change between evaluations, and particles that are shifted by whole boxes.
namespace lanescape {
namespace {

const kernels::KernelTable& best_table() { return kernel_table(available_isas().back()); }

Configuration scaled(Configuration configuration, const Point& factors) {
  for (std::size_t axis = 0; axis < 3; ++axis) configuration.box.length[axis] *= factors[axis];
  for (std::size_t k = 0; k < configuration.positions.size(); ++k) configuration.positions[k] *= factors[k % 3];
  return configuration;
}

PairInteraction interaction_of(const PairModel& model, const Configuration& configuration, const PairSearchOptions& options = {}) {
  return {model, configuration.box, ParticleLayout::in_users_order(configuration, model.species.size()), best_table(), options};
}

struct Result {
  PairInteraction::Evaluation sums;
  AlignedArray gradient;
};

Result evaluate(PairInteraction& interaction, const PairModel& model, const Configuration& configuration) {
  const ParticleLayout layout = ParticleLayout::in_users_order(configuration, model.species.size());
  Result result{{}, AlignedArray(layout.dimension(), 0.0)};
  result.sums = interaction.energy_and_stress(layout.to_slots(configuration.positions), result.gradient);
  return result;
}

void expect_equal(const Result& a, const Result& b, double tolerance, const std::string& where) {
  EXPECT_NEAR(a.sums.energy, b.sums.energy, tolerance) << where;
  EXPECT_NEAR(a.sums.virial, b.sums.virial, 10.0 * tolerance) << where;
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(a.sums.virial_tensor[k], b.sums.virial_tensor[k], 10.0 * tolerance) << where;
  for (std::size_t k = 0; k < a.gradient.size(); ++k) ASSERT_NEAR(a.gradient[k], b.gradient[k], 10.0 * tolerance) << where;
}

// From cubes to slabs, from all images to lattice shifts and back: the search, the unit and the constants change with the box.
TEST(ChangingBox, GivesWhatANewObjectGives) {
  for (const auto& [name, model, configuration] : pair_cases()) {
    if (configuration.size() > 300) continue;
    PairInteraction changed = interaction_of(model, configuration);
    for (const Point& factors : {Point{1.0, 1.0, 1.0}, Point{1.01, 1.0, 0.99}, Point{1.1, 1.1, 1.1}, Point{1.0, 1.0, 1.0}}) {
      const Configuration now = scaled(configuration, factors);
      changed.set_box(now.box);
      PairInteraction fresh = interaction_of(model, now);
      ASSERT_EQ(changed.list() == nullptr, fresh.list() == nullptr) << name;
      const double magnitude = evaluate_reference(model, now).magnitude;
      const double tolerance = changed.list() == nullptr ? 0.0 : 1e-14 * magnitude;
      expect_equal(evaluate(changed, model, now), evaluate(fresh, model, now), tolerance, name);
    }
  }
}

TEST(ChangingBox, IsRefusedLikeANewObjectAndThenChangesNothing) {
  PairModel model = lennard_jones();
  const Configuration start = fcc_start(model, 256, 0.8, 1);
  PairInteraction interaction = interaction_of(model, start, {.search = PairSearch::list});
  const Result before = evaluate(interaction, model, start);
  for (const double edge : {0.1, 0.0, -5.0, std::nan("")}) EXPECT_THROW(interaction.set_box({{8.0, edge, 8.0}}), Error) << edge;
  EXPECT_EQ(interaction.box(), start.box);
  expect_equal(evaluate(interaction, model, start), before, 0.0, "all images");
  model.images = ImageRule::minimum;
  PairInteraction minimum = interaction_of(model, start, {.search = PairSearch::list});
  EXPECT_THROW(minimum.set_box({{5.0, 8.0, 8.0}}), Error);
  expect_equal(evaluate(minimum, model, start), before, 1e-9, "minimum image");
}

// A walk with wrapping and a breathing box.
struct Walk {
  Configuration now;
  std::mt19937_64 engine{7};

  void step() {
    std::uniform_real_distribution<double> move(-0.02, 0.02), stretch(-1e-3, 1e-3);
    const double factor = 1.0 + stretch(engine);
    now = scaled(now, {factor, 1.0 / factor, 1.0});
    for (double& x : now.positions) x += move(engine) + 0.01;
    now.wrap();
  }
};

TEST(ChangingBox, AndWrappingLeaveTheBitsOfACopyThatWasArchived) {
  const PairModel model = kob_andersen();
  for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
    Walk walk{fcc_start(model, 500, 1.2, 1)};
    PairInteraction original = interaction_of(model, walk.now, {.precision = precision});
    std::size_t kept = 0;
    for (int step = 0; step < 30; ++step) {
      walk.step();
      original.set_box(walk.now.box);
      const std::uint64_t rebuilds = original.list()->rebuilds();
      const Result expected = evaluate(original, model, walk.now);
      kept += original.list()->rebuilds() == rebuilds;
      PairInteraction copy = interaction_of(model, walk.now, {.precision = precision});
      testing::hand_on(original, copy);
      expect_equal(evaluate(copy, model, walk.now), expected, 0.0, "step " + std::to_string(step));
    }
    EXPECT_GT(kept, 15U);
  }
}

TEST(ChangingBox, AndWrappingGiveTheReferencesEnergyInBothPrecisions) {
  const PairModel model = kob_andersen();
  for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
    Walk walk{fcc_start(model, 256, 1.2, 1)};
    PairInteraction interaction = interaction_of(model, walk.now, {.search = PairSearch::list, .precision = precision});
    for (int step = 0; step < 20; ++step) {
      walk.step();
      interaction.set_box(walk.now.box);
      const auto expected = evaluate_reference(model, walk.now);
      const double tolerance = precision == Precision::mixed ? 1e-6 : 1e-14;
      const ParticleLayout layout = ParticleLayout::in_users_order(walk.now, 2);
      EXPECT_NEAR(interaction.energy(layout.to_slots(walk.now.positions)), expected.energy, tolerance * expected.magnitude);
    }
  }
}

TEST(ChangingBox, OfSitesInStatesGivesWhatANewObjectGives) {
  for (const StateMixtureCase& one : state_mixture_cases()) {
    const ParticleLayout layout(one.configuration.species, one.model.species.size());
    StateMixture changed(one.model, one.configuration.box, layout, best_table(), {});
    for (const double factor : {1.0, 1.01, 0.97, 1.2}) {
      const Configuration now = scaled(one.configuration, {factor, factor, factor});
      changed.set_box(now.box);
      StateMixture fresh(one.model, now.box, layout, best_table(), {});
      AlignedArray a(layout.dimension(), 0.0), b = a;
      const auto x = changed.energy_and_stress(layout.to_slots(now.positions), a);
      const auto y = fresh.energy_and_stress(layout.to_slots(now.positions), b);
      double scale = std::fabs(y.energy);
      for (const double g : b) scale = std::max(scale, std::fabs(g));
      EXPECT_NEAR(x.energy, y.energy, 1e-12 * scale) << one.name << " at " << factor;
      EXPECT_NEAR(x.virial, y.virial, 1e-11 * scale) << one.name << " at " << factor;
      for (std::size_t k = 0; k < a.size(); ++k) ASSERT_NEAR(a[k], b[k], 1e-11 * scale) << one.name << " at " << factor;
    }
    EXPECT_THROW(changed.set_box({{1e-3, 5.0, 5.0}}), Error) << one.name;
  }
}

}  // namespace
}  // namespace lanescape
