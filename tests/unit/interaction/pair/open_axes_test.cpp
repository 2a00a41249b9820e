#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "configuration/lattice.hpp"
#include "every_isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/pair/separations.hpp"
#include "interaction/state/state_mixture.hpp"
#include "memory_archive.hpp"
#include "neighbour/neighbour_list.hpp"
#include "refusal.hpp"
#include "verification/cases.hpp"
#include "verification/reference_bridge.hpp"
#include "verification/state_mixture_cases.hpp"

// Slabs and clusters: boxes that are open along some axes.
namespace lanescape {
namespace {

using Axes = std::array<bool, 3>;
constexpr Axes every_choice[] = {{false, true, true},  {true, false, true},  {true, true, false},  {false, false, true},
                                 {false, true, false}, {true, false, false}, {false, false, false}};

const kernels::KernelTable& best_table() { return kernel_table(available_isas().back()); }

struct Result {
  PairInteraction::Evaluation sums;
  AlignedArray gradient, energies;
};

PairInteraction interaction_of(const PairModel& model, const Configuration& c, Isa isa, const PairSearchOptions& options = {}) {
  return {model, c.box, ParticleLayout::in_users_order(c, model.species.size()), kernel_table(isa), options};
}

Result evaluate(PairInteraction& interaction, const PairModel& model, const Configuration& c) {
  const ParticleLayout layout = ParticleLayout::in_users_order(c, model.species.size());
  const AlignedArray positions = layout.to_slots(c.positions);
  Result result{{}, AlignedArray(layout.dimension(), 0.0), AlignedArray(layout.slots(), 0.0)};
  result.sums = interaction.energy_and_stress(positions, result.gradient);
  interaction.energies(positions, result.energies);
  return result;
}

Result evaluate(const PairModel& model, const Configuration& c, Isa isa, const PairSearchOptions& options = {}) {
  PairInteraction interaction = interaction_of(model, c, isa, options);
  return evaluate(interaction, model, c);
}

void expect_near(const Result& a, const Result& b, double tolerance, const std::string& where) {
  EXPECT_NEAR(a.sums.energy, b.sums.energy, tolerance) << where;
  EXPECT_NEAR(a.sums.virial, b.sums.virial, 10.0 * tolerance) << where;
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(a.sums.virial_tensor[k], b.sums.virial_tensor[k], 10.0 * tolerance) << where;
  for (std::size_t k = 0; k < a.gradient.size(); ++k) ASSERT_NEAR(a.gradient[k], b.gradient[k], 10.0 * tolerance) << where;
  for (std::size_t k = 0; k < a.energies.size(); ++k) ASSERT_NEAR(a.energies[k], b.energies[k], tolerance) << where;
}

void expect_reference(const PairModel& model, const Configuration& c, Isa isa, const std::string& where, double tolerance = 1e-13) {
  const Result found = evaluate(model, c, isa);
  const reference::Evaluation expected = evaluate_reference(model, c);
  const ParticleLayout layout = ParticleLayout::in_users_order(c, model.species.size());
  EXPECT_NEAR(found.sums.energy, expected.energy, tolerance * expected.magnitude) << where;
  EXPECT_NEAR(found.sums.virial, expected.virial, tolerance * expected.virial_magnitude) << where;
  const std::vector<double> gradient = layout.to_user(found.gradient);
  const double largest = *std::max_element(expected.gradient_magnitude.begin(), expected.gradient_magnitude.end());
  for (std::size_t k = 0; k < gradient.size(); ++k)
    ASSERT_NEAR(gradient[k], expected.gradient[k], tolerance * (largest + 1e-3)) << where << ", coordinate " << k;
}

// A liquid whose particles lie up to `outside` beyond the faces of open axes.
Configuration liquid(const PairModel& model, std::size_t particles, const Axes& periodic, double outside, unsigned seed = 1) {
  Configuration c = fcc_start(model, particles, 1.1, seed);
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> jitter(-0.04, 0.04);
  for (double& x : c.positions) x += jitter(engine);
  c.box.periodic = periodic;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (periodic[axis]) continue;
    for (std::size_t k = axis; k < c.positions.size(); k += 3) c.positions[k] = c.positions[k] - outside;
    c.box.length[axis] -= 2.0 * outside;
  }
  return c;
}

// The same particles in a periodic box that leaves a gap wider than cutoff and skin.
Configuration with_gap(Configuration c, double gap) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (c.box.periodic[axis]) continue;
    double low = 0.0, high = c.box.length[axis];
    for (std::size_t k = axis; k < c.positions.size(); k += 3) {
      low = std::min(low, c.positions[k]);
      high = std::max(high, c.positions[k]);
    }
    c.box.length[axis] = high - low + gap;
    c.box.periodic[axis] = true;
  }
  return c;
}

using OpenAxesOnEveryIsa = testing::EveryIsa;

INSTANTIATE_TEST_SUITE_P(EveryIsa, OpenAxesOnEveryIsa, testing::all_isas(), testing::isa_name);

TEST_P(OpenAxesOnEveryIsa, AreAPeriodicBoxWithAWideGap) {
  for (const PairModel& model : {lennard_jones(), kob_andersen()})
    for (const std::size_t particles : {32U, 500U, 2048U})
      for (const Axes& axes : every_choice) {
        if (particles > 500 && axes != every_choice[0] && axes != every_choice[4]) continue;
        const Configuration open = liquid(model, particles, axes, 0.3);
        const Configuration gap = with_gap(open, 3.2);
        for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
          const PairSearchOptions options{.search = PairSearch::list, .precision = precision};
          const double tolerance = (precision == Precision::mixed ? 2e-6 : 2e-12) * static_cast<double>(particles);
          expect_near(evaluate(model, open, GetParam(), options), evaluate(model, gap, GetParam(), options), tolerance, model.name);
        }
      }
}

// On a face, one ulp beyond it, and far outside: particles that have left and are not removed yet.
TEST_P(OpenAxesOnEveryIsa, HoldParticlesOnTheFacesAndOutside) {
  const PairModel model = kob_andersen();
  for (const Axes& axes : every_choice)
    for (const std::size_t particles : {4U, 108U}) {
      Configuration c = liquid(model, particles, axes, 0.0);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (axes[axis]) continue;
        const double edge = c.box.length[axis];
        const double places[] = {0.0,
                                 edge,
                                 std::nextafter(0.0, -1.0),
                                 std::nextafter(edge, 2.0 * edge),
                                 -0.0,
                                 -0.9,
                                 -2.6,
                                 edge + 0.95,
                                 edge + 2.7,
                                 -30.0 * edge,
                                 40.0 * edge};
        // One particle at a time: two moved ones could come to lie on each other.
        for (const double x : places) {
          Configuration moved = c;
          moved.positions[axis] = x;
          expect_reference(model, moved, GetParam(), "at " + std::to_string(x));
        }
      }
    }
}

// Narrowed gaps: what lies far away costs neither memory nor digits of the others.
TEST_P(OpenAxesOnEveryIsa, FollowParticlesAsFarAsTheyGo) {
  const PairModel model = lennard_jones();
  Configuration c = liquid(model, 256, {false, true, false}, 0.2);
  const double near = evaluate(model, c, GetParam()).sums.energy;
  for (const double away : {1e3, 1e6, 1e9}) {
    Configuration far = c;
    const double beside = away + 1.2;
    for (const double x : {away, beside}) {  // a pair of its own
      far.positions.insert(far.positions.end(), {x, 1.0, -away});
      far.species.push_back(0);
    }
    PairInteraction interaction = interaction_of(model, far, GetParam());
    const Result found = evaluate(interaction, model, far);
    Configuration pair{c.box, {0, 0}, {0.0, 1.0, 0.0, beside - away, 1.0, 0.0}};
    const double alone = evaluate(model, pair, GetParam()).sums.energy;
    EXPECT_LT(alone, -0.5);
    EXPECT_NEAR(found.sums.energy, near + alone, 1e-10 * std::abs(near)) << away;
    EXPECT_LT(interaction.list_memory(), 4'000'000U) << away;
    EXPECT_LT(interaction.list()->neighbours(), 256U * 120U) << away;
  }
}

TEST(OpenAxes, RefuseParticlesBeyondTheLimit) {
  const PairModel model = lennard_jones();
  for (const double x : {2e12, -2e12, 1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
    Configuration c = liquid(model, 32, {true, false, true}, 0.0);
    c.positions[1] = x * c.box.length[1];
    PairInteraction interaction = interaction_of(model, c, available_isas().back());
    const std::string message = testing::refusal([&] { evaluate(interaction, model, c); });
    EXPECT_NE(message.find(std::isfinite(x) ? "boxes away" : "finite"), std::string::npos) << message;
  }
}

// A list that was made elsewhere gives what a new one gives, at every step out of the box.
TEST(OpenAxes, MissNoPairWhileParticlesLeave) {
  const PairModel model = kob_andersen();
  for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
    Configuration c = liquid(model, 500, {false, true, true}, 0.0, 3);
    const PairSearchOptions options{.threads = 2, .precision = precision};
    PairInteraction followed = interaction_of(model, c, available_isas().back(), options);
    std::mt19937_64 engine(5);
    std::uniform_real_distribution<double> step(-0.03, 0.03);
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * c.box.length[0];
      for (std::size_t i = 0; i < c.size(); ++i) {
        c.positions[3 * i] += 0.01 * (c.positions[3 * i] - middle);  // apart, through both faces
        for (std::size_t axis = 1; axis < 3; ++axis) c.positions[3 * i + axis] += 0.3 * step(engine);
      }
      const double tolerance = precision == Precision::mixed ? 1e-3 : 1e-9;
      expect_near(evaluate(followed, model, c), evaluate(model, c, available_isas().back(), {.precision = precision}), tolerance,
                  "step " + std::to_string(k));
    }
    EXPECT_LT(followed.rebuilds(), 35U);
    EXPECT_GT(followed.rebuilds(), 1U);
  }
}

// A particle that crosses the box along an open axis has moved; along a periodic one it has been shifted.
TEST(OpenAxes, KnowAWholeEdgeFromNone) {
  const PairModel model = lennard_jones();
  Configuration c = liquid(model, 256, {true, false, true}, 0.0);
  PairInteraction interaction = interaction_of(model, c, available_isas().back());
  evaluate(interaction, model, c);
  c.positions[0] += c.box.length[0];
  expect_reference(model, c, available_isas().back(), "along x");
  evaluate(interaction, model, c);
  EXPECT_EQ(interaction.rebuilds(), 1U);
  c.positions[1] += c.box.length[1];
  const double moved = evaluate(interaction, model, c).sums.energy;
  EXPECT_EQ(interaction.rebuilds(), 2U);
  EXPECT_NEAR(moved, evaluate_reference(model, c).energy, 1e-9);
}

TEST(OpenAxes, GiveTheSameBitsOnAnyNumberOfThreadsAndAfterAnInterruption) {
  const PairModel model = kob_andersen();
  Configuration c = liquid(model, 2048, {false, true, true}, 0.4);
  const Result one = evaluate(model, c, available_isas().back());
  for (const int threads : {2, 3, 5}) {
    const Result several = evaluate(model, c, available_isas().back(), {.threads = threads});
    EXPECT_EQ(one.sums.energy, several.sums.energy);
    EXPECT_EQ(one.gradient, several.gradient);
  }
  PairInteraction running = interaction_of(model, c, available_isas().back());
  evaluate(running, model, c);
  for (double& x : c.positions) x += 0.01;
  PairInteraction resumed = interaction_of(model, c, available_isas().back());
  testing::hand_on(running, resumed);
  EXPECT_EQ(evaluate(running, model, c).gradient, evaluate(resumed, model, c).gradient);
}

// Boxes that open, close and change their edges.
TEST(OpenAxes, OfAnotherBoxGiveWhatANewObjectGives) {
  const PairModel model = lennard_jones();
  Configuration c = liquid(model, 500, {true, true, true}, 0.0);
  PairInteraction changed = interaction_of(model, c, available_isas().back());
  evaluate(changed, model, c);
  for (const Axes& axes : every_choice)
    for (const double factor : {1.0, 1.01, 1.2}) {
      c.box.periodic = axes;
      c.box.length[0] *= factor;
      changed.set_box(c.box);
      expect_near(evaluate(changed, model, c), evaluate(model, c, available_isas().back()), 1e-9, "box");
      c.box.length[0] /= factor;
    }
}

TEST(OpenAxes, LeaveOutExcludedPairs) {
  const PairModel model = lennard_jones();
  const Configuration c = liquid(model, 32, {false, true, true}, 0.2);
  PairInteraction interaction = interaction_of(model, c, available_isas().back());
  const Result all = evaluate(interaction, model, c);
  const std::array<std::size_t, 2> pair{0, 1};
  interaction.set_exclusions({&pair, 1});
  Configuration two{c.box, {0, 0}, {c.positions.begin(), c.positions.begin() + 6}};
  two.box.length[1] = two.box.length[2] = 50.0;  // the nearest image alone
  EXPECT_NEAR(all.sums.energy - evaluate(interaction, model, c).sums.energy,
              evaluate(model, two, available_isas().back()).sums.energy, 1e-10);
}

TEST(OpenAxes, SeeNoOverlapAcrossAFace) {
  const PairModel model = lennard_jones();
  Configuration c{{{10.0, 10.0, 10.0}}, {0, 0}, {0.05, 5.0, 5.0, 9.95, 5.0, 5.0}};
  EXPECT_THROW(check_separations(c, model), Error);
  c.box.periodic = {false, true, true};
  EXPECT_NO_THROW(check_separations(c, model));
  for (const double x : {-0.02, 11.0, -12.0, 1e7}) {
    c.positions[0] = x;
    c.positions[3] = x + 0.1;
    EXPECT_THROW(check_separations(c, model), Error) << x;
  }
}

TEST(OpenAxes, AreRefusedInOneLineWhereTheyCannotBe) {
  const auto refused = [](PairModel model, const Axes& axes, const PairSearchOptions& options, const char* wanted) {
    Configuration c = liquid(model, 32, axes, 0.0);
    const std::string message = testing::refusal([&] { interaction_of(model, c, available_isas().back(), options); });
    EXPECT_NE(message.find(wanted), std::string::npos) << message;
  };
  PairModel model = lennard_jones();
  refused(model, {true, false, true}, {.search = PairSearch::all_pairs}, "open along y");
  refused(model, {true, false, true}, {.search = PairSearch::clusters, .precision = Precision::mixed}, "periodic box");
  model.truncation = Truncation::tail;
  refused(model, {true, true, false}, {}, "open along z");
  PairInteraction periodic = interaction_of(model, liquid(model, 32, {true, true, true}, 0.0), available_isas().back());
  testing::refusal([&] { periodic.set_box({{5.0, 5.0, 5.0}, {false, true, true}}); });
  model.truncation = Truncation::shifted;
  model.images = ImageRule::minimum;
  refused(model, {false, true, true}, {}, "which open axes need");
  // Edges along open axes do not matter to the minimum image.
  Configuration slab = liquid(model, 500, {false, true, true}, 0.0);
  slab.box.length[0] = 1.0;
  expect_reference(model, slab, available_isas().back(), "minimum image");
}

TEST(OpenAxes, AreRefusedBySitesInStates) {
  const StateMixtureCase one = state_mixture_cases().front();
  Box box = one.configuration.box;
  box.periodic[2] = false;
  const std::string message = testing::refusal(
      [&] { StateMixture(one.model, box, ParticleLayout(one.configuration.species, one.model.species.size()), best_table(), {}); });
  EXPECT_NE(message.find("sites in states are not allowed in a box that is open along z"), std::string::npos) << message;
}

TEST(OpenAxes, HaveNoBoundAlongSegments) {
  const PairModel model = lennard_jones();
  const auto bound = [&](const Axes& axes) {
    return interaction_of(model, liquid(model, 500, axes, 0.0), available_isas().back()).segment_bound(1e-3);
  };
  EXPECT_NE(bound({true, true, true}), nullptr);
  EXPECT_EQ(bound({true, false, true}), nullptr);
}

}  // namespace
}  // namespace lanescape
