#include "insertion/insertion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "dispatch/isa.hpp"
#include "insertion/holes.hpp"
#include "insertion/removal.hpp"
#include "insertion/search.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "refusal.hpp"
#include "thin_mixture.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

using namespace testing;

double energy_of(const PairModel& model, const Configuration& fluid) {
  const ParticleLayout layout(fluid.species, model.species.size());
  return PairInteraction(model, fluid.box, layout, table()).energy(layout.to_slots(fluid.positions));
}

TEST(Insertion, EveryParticleRaisesTheEnergyByWhatItsRecordSaysWithinTheTolerance) {
  for (const Truncation truncation : {Truncation::shifted, Truncation::tail})
    for (const InsertionMethod method : every_method)
      for (const int species : {0, 1}) {
        PairModel model = kob_andersen();
        model.truncation = truncation;
        Configuration fluid = thin_mixture();
        ProbeField field(model, fluid, species, table());
        const InsertionOptions options = options_with(species == 0 ? -4.0 : -6.0, method);
        InsertionHistory history;
        double energy = energy_of(model, fluid);
        for (const Insertion& insertion : insert_particles(field, options, 8, history, 1)) {
          ASSERT_TRUE(insertion.found) << to_string(method);
          EXPECT_LE(std::abs(insertion.energy - options.target), 0.01 * std::abs(options.target)) << to_string(method);
          EXPECT_NEAR(insertion.error, (insertion.energy - options.target) / std::abs(options.target), 1e-15);
          EXPECT_GE(insertion.evaluations, insertion.trials);
          fluid.species.push_back(species);
          fluid.positions.insert(fluid.positions.end(), insertion.position.begin(), insertion.position.end());
          const double with_it = energy_of(model, fluid);
          EXPECT_NEAR(with_it - energy, insertion.energy, 1e-11) << to_string(method);
          energy = with_it;
        }
        EXPECT_EQ(field.size(), fluid.size());
      }
}

TEST(Insertion, ATrialOfDirectUsherIsThatOfTheReference) {
  const PairModel model = kob_andersen();
  const Configuration fluid = thin_mixture();
  const ProbeField field(model, fluid, 0, table());
  InsertionOptions options = options_with(-4.0);
  options.most_trials = 1;
  options.largest_step = 0.12;
  std::size_t found = 0, longest = 0;
  for (std::uint64_t number = 0; number < 60; ++number) {
    std::vector<Point> positions;
    std::vector<double> energies;
    InsertionSearch search(field, options, number, 0.04, 40, [&](std::uint64_t, const Point& position, double energy) {
      positions.push_back(position);
      energies.push_back(energy);
    });
    search.run();
    std::vector<double> expected;
    const reference::UsherTrial trial = reference::usher_trial({-4.0, 0.12}, 0.04, 40, positions.front(), [&](const Point& p) {
      const reference::Probe probe = probe_reference(model, fluid, p, 0);
      expected.push_back(probe.energy);
      return probe;
    });
    EXPECT_EQ(search.result().found, trial.found) << number;
    ASSERT_EQ(energies.size(), expected.size()) << number;
    for (std::size_t k = 0; k < energies.size(); ++k)
      EXPECT_NEAR(energies[k], expected[k], 1e-9 * (1.0 + std::abs(expected[k]))) << number << " " << k;
    found += trial.found;
    longest = std::max(longest, energies.size());
  }
  // Searches that succeed, searches that fail, and some long ones.
  EXPECT_GT(found, 10U);
  EXPECT_LT(found, 60U);
  EXPECT_GT(longest, 10U);
}

TEST(Insertion, ErrorsShrinkQuadraticallyNearTheTarget) {
  const PairModel model = kob_andersen();
  const ProbeField field(model, thin_mixture(), 0, table());
  const InsertionOptions options = options_with(-4.0);
  std::size_t steps = 0;
  double sum_of_orders = 0.0;
  for (std::uint64_t number = 0; number < 200; ++number) {
    std::vector<double> errors;
    InsertionSearch search(field, options, number, 1e-9, 100,
                           [&](std::uint64_t, const Point&, double energy) { errors.push_back(std::abs(energy + 4.0) / 4.0); });
    search.run();
    ASSERT_TRUE(search.result().found);
    for (std::size_t k = 0; k + 1 < errors.size(); ++k)
      if (errors[k] < 1e-2 && errors[k + 1] > 1e-13 && errors[k + 1] < errors[k]) {
        sum_of_orders += std::log(errors[k + 1]) / std::log(errors[k]);
        ++steps;
      }
  }
  ASSERT_GT(steps, 100U);
  // ln e' / ln e is 2 for e' = e^2, and less by ln c / ln e for e' = c e^2.
  EXPECT_NEAR(sum_of_orders / static_cast<double>(steps), 2.0, 0.25);
}

TEST(Insertion, SearchesDoNotDependOnTheNumberOfThreads) {
  const PairModel model = kob_andersen();
  for (const InsertionMethod method : {InsertionMethod::usher, InsertionMethod::screened}) {
    std::vector<std::vector<Insertion>> runs;
    for (const int threads : {1, 3}) {
      ProbeField field(model, thin_mixture(), 0, table());
      InsertionHistory history;
      runs.push_back(insert_particles(field, options_with(-3.0, method), 12, history, threads));
      for (const Insertion& place : find_places(field, options_with(-3.0, method), 40, history, threads))
        runs.back().push_back(place);
    }
    for (std::size_t k = 0; k < runs[0].size(); ++k) {
      EXPECT_EQ(runs[0][k].position, runs[1][k].position);
      EXPECT_EQ(runs[0][k].energy, runs[1][k].energy);
      EXPECT_EQ(runs[0][k].evaluations, runs[1][k].evaluations);
    }
  }
}

TEST(Insertion, ATargetThatNoPlaceHasIsGivenUpAtTheLimitAndNothingIsPutIn) {
  const PairModel model = kob_andersen();
  ProbeField field(model, thin_mixture(), 0, table());
  const std::size_t before = field.size();
  for (const InsertionMethod method : every_method) {
    InsertionOptions options = options_with(-200.0, method);
    options.most_trials = 25;
    InsertionHistory history;
    for (const Insertion& insertion : insert_particles(field, options, 2, history, 1)) {
      EXPECT_FALSE(insertion.found);
      EXPECT_EQ(insertion.trials, 25U);
      EXPECT_GE(insertion.evaluations, 25U);
    }
    EXPECT_EQ(history.mean_iterations(), 0.0);
  }
  EXPECT_EQ(field.size(), before);
}

TEST(Insertion, UnderARunningMeanSingleErrorsMayBeLargerButNoMeanOfThirtyIs) {
  const PairModel model = kob_andersen();
  const ProbeField field(model, thin_mixture(), 0, table());
  InsertionOptions options = options_with(-3.5);
  options.measure = ErrorMeasure::running_mean;
  options.tolerance = 0.02;
  InsertionHistory history;
  const std::vector<Insertion> places = find_places(field, options, 150, history, 1);
  double largest = 0.0;
  for (std::size_t end = 1; end <= places.size(); ++end) {
    const std::size_t begin = end < 30 ? 0 : end - 30;
    double sum = 0.0;
    for (std::size_t k = begin; k < end; ++k) sum += std::abs(places[k].error);
    EXPECT_LE(sum / static_cast<double>(end - begin), 0.02 * (1.0 + 1e-12));
    largest = std::max(largest, std::abs(places[end - 1].error));
  }
  EXPECT_GT(largest, 0.02);
}

TEST(Insertion, TowardsZeroTheToleranceIsAbsolute) {
  const PairModel model = kob_andersen();
  const ProbeField field(model, thin_mixture(), 0, table());
  InsertionHistory history;
  for (const Insertion& place : find_places(field, options_with(0.0), 20, history, 1)) {
    ASSERT_TRUE(place.found);
    EXPECT_LE(std::abs(place.energy), 0.01);
    EXPECT_EQ(place.error, place.energy);
  }
}

TEST(Insertion, RefusesWhatMakesNoSense) {
  const Box box{{5.0, 6.0, 7.0}};
  const auto refused = [&](auto change) {
    InsertionOptions options = options_with(-1.0);
    change(options);
    return testing::refusal([&] { options.check(box); });
  };
  EXPECT_EQ(refused([](auto& o) { o.tolerance = 0.0; }), "tolerance 0 is not allowed: it must be finite and above 0");
  EXPECT_EQ(refused([](auto& o) { o.target = std::nan(""); }), "target energy nan is not allowed: it must be finite");
  EXPECT_EQ(refused([](auto& o) { o.region = Region{{1.0, 4.0, 0.0}, {2.0, 3.0, 7.0}}; }),
            "region from 4 to 3 along y is not allowed: from < to <= from + 6 in this box, at most 1000 edges away");
  EXPECT_EQ(refused([](auto& o) { o.region = Region{{1.0, 0.0, 0.0}, {2.0, 3.0, 7.5}}; }),
            "region from 0 to 7.5 along z is not allowed: from < to <= from + 7 in this box, at most 1000 edges away");
  EXPECT_EQ(
      refused([](auto& o) { o.region = Region{{1.0, 0.0, 7e8}, {2.0, 3.0, 7e8 + 1.0}}; }),
      "region from 700000000 to 700000001 along z is not allowed: from < to <= from + 7 in this box, at most 1000 edges away");
  EXPECT_EQ(refused([](auto& o) { o.most_trials = 0; }), "most trials 0 is not allowed: from 1 to 1000000000");
  EXPECT_NE(refused([](auto& o) { o.contact = 0.4; }).find("contact distance 0.4 is not allowed: above 0.5"), std::string::npos);
  EXPECT_EQ(testing::refusal([] { parse_insertion_method("newton"); }),
            "unknown method 'newton': allowed are usher, usher-indirect, usher-near, screened, descent");
  ProbeField empty(kob_andersen(), {box, {}, {}}, 0, table());
  InsertionHistory history;
  EXPECT_EQ(testing::refusal([&] { find_places(empty, options_with(-1.0), 1, history, 1); }),
            "insertion into an empty fluid is not allowed: at least one particle is needed");
}

TEST(Insertion, VelocitiesAreMaxwells) {
  const CounterRandom random(1, RandomStream::insertion);
  double sum = 0.0, squares = 0.0, fourths = 0.0;
  constexpr int n = 20'000;
  for (int k = 0; k < n; ++k) {
    const auto v = maxwellian_velocity(random, static_cast<std::uint64_t>(k), 1.5, 2.0, {0.0, 3.0, 0.0});
    sum += v[1] - 3.0;
    squares += v[0] * v[0];
    fourths += v[2] * v[2] * v[2] * v[2];
  }
  EXPECT_NEAR(sum / n, 0.0, 4.0 * std::sqrt(0.75 / n));
  EXPECT_NEAR(squares / n, 0.75, 4.0 * 0.75 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourths / n, 3.0 * 0.75 * 0.75, 4.0 * 0.75 * 0.75 * std::sqrt(96.0 / n));
}

TEST(Removal, OfTheLeastDisturbanceHasTheEnergyNearestToTheOneAskedForAndLiesInTheRegion) {
  const PairModel model = kob_andersen();
  const Configuration fluid = thin_mixture();
  const CounterRandom random(1, RandomStream::insertion);
  const auto without = [&](std::size_t particle) {
    Configuration rest = fluid;
    const auto at = static_cast<std::ptrdiff_t>(particle);
    rest.species.erase(rest.species.begin() + at);
    rest.positions.erase(rest.positions.begin() + 3 * at, rest.positions.begin() + 3 * at + 3);
    return rest;
  };
  const Region half{{0.0, 0.0, 0.0}, {0.5 * fluid.box.length[0], fluid.box.length[1], fluid.box.length[2]}};
  const auto removal = choose_removal(model, fluid, 0, RemovalRule::least_disturbance, half, -7.0, random, 0, choose_isa("auto"));
  ASSERT_TRUE(removal);
  const double all = energy_of(model, fluid);
  EXPECT_NEAR(removal->energy, all - energy_of(model, without(removal->particle)), 1e-11);
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    const bool inside = fluid.box.wrapped(0, fluid.position(i)[0]) <= half.high[0];
    EXPECT_TRUE(i != removal->particle || (inside && fluid.species[i] == 0));
    if (!inside || fluid.species[i] != 0) continue;
    EXPECT_GE(std::abs(all - energy_of(model, without(i)) + 7.0) + 1e-11, std::abs(removal->energy + 7.0));
  }
  const Configuration nobody{fluid.box, {1}, {0.0, 0.0, 0.0}};
  EXPECT_FALSE(choose_removal(model, nobody, 0, RemovalRule::random, {}, 0.0, random, 0, choose_isa("auto")));
}

TEST(Removal, AtRandomTakesEveryParticleAboutEquallyOften) {
  const PairModel model = lennard_jones();
  Configuration fluid{{{9.0, 9.0, 9.0}}, {}, {}};
  for (int i = 0; i < 5; ++i) {
    fluid.species.push_back(0);
    for (int axis = 0; axis < 3; ++axis) fluid.positions.push_back(1.5 * i);
  }
  const CounterRandom random(1, RandomStream::insertion);
  std::vector<int> taken(5, 0);
  for (std::uint64_t k = 0; k < 1000; ++k)
    ++taken[choose_removal(model, fluid, 0, RemovalRule::random, {}, 0.0, random, k, choose_isa("auto"))->particle];
  for (const int count : taken) EXPECT_NEAR(count, 200, 60);
}

TEST(Holes, TheFitOfAProlateEllipsoidIsInvertedExactly) {
  for (const double e : {0.1, 0.5, 0.9, 0.99}) {
    Hole hole;
    hole.mean_radius = 0.3 * std::asin(e) / e;
    hole.mean_square = 0.09 * std::atanh(e) / e;
    fit_prolate(hole);
    EXPECT_NEAR(hole.eccentricity, e, 1e-9);
    EXPECT_NEAR(hole.semi_minor, 0.3, 1e-9);
    EXPECT_NEAR(hole.semi_major, 0.3 / std::sqrt(1.0 - e * e), 1e-8);
  }
}

TEST(Holes, InACageOfSixTheRadiusAlongTheAxesIsWhereTheEnergyRises) {
  // A cage with octahedral symmetry is nearly round, and <R> lies between the radii towards a particle and between particles.
  const PairModel model = lennard_jones();
  const double d = 1.2;
  const Configuration cage{
      {{12.0, 12.0, 12.0}}, {0, 0, 0, 0, 0, 0}, {6 + d, 6, 6, 6 - d, 6, 6, 6, 6 + d, 6, 6, 6 - d, 6, 6, 6, 6 + d, 6, 6, 6 - d}};
  const ProbeField field(model, cage, 0, table());
  const double iso = field.energy({6.25, 6.0, 6.0});
  const auto hole = measure_hole(field, {6.0, 6.0, 6.0}, iso);
  ASSERT_TRUE(hole);
  // Towards a particle the energy reaches that value at 0.25; between three particles it does so further out.
  EXPECT_GT(hole->mean_radius, 0.25);
  EXPECT_GT(hole->mean_square, hole->mean_radius * hole->mean_radius);
  EXPECT_GE(hole->semi_major, hole->semi_minor);
  EXPECT_FALSE(measure_hole(field, {6.3, 6.0, 6.0}, iso));
}

}  // namespace
}  // namespace lanescape
