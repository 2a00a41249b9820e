#include "dynamics/end_points.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/hdf5_archive.hpp"
#include "systems.hpp"

namespace lanescape {
namespace {

using testing::System;
using Phase = EndPointGenerator::Phase;

EndPointOptions few_steps() {
  EndPointOptions options;
  options.temperature = 1.0;
  options.distance = 1.0;
  options.pairs = 2;
  options.melt_steps = 70;
  options.cooling_steps = 110;
  options.rescale_interval = 10;
  options.check_steps = 60;
  options.check_interval = 5;
  options.check_tolerance = 100.0;
  options.settle_steps = 130;
  options.between_steps = 90;
  return options;
}

EndPointGenerator generator_of(System& system, const EndPointOptions& options) {
  return {system.landscape, system.model, system.layout, system.start(), options};
}

void run_to_the_end(EndPointGenerator& generator) {
  while (!generator.ended()) generator.step();
}

std::vector<double> masses_of(const PairModel& model) {
  std::vector<double> masses;
  for (const Species& s : model.species) masses.push_back(s.mass);
  return masses;
}

TEST(EndPointDistance, LeavesOutTheMotionOfTheCentreOfMass) {
  for (const double second : {1.0, 3.0}) {
    System system(testing::with_masses(kob_andersen(), 1.0, second), testing::molten_kob_andersen());
    const auto masses = masses_of(system.model);
    const AlignedArray from = system.start();
    auto shifted = system.configuration.positions;
    for (std::size_t k = 0; k < shifted.size(); ++k) shifted[k] += k % 3 == 0 ? 5.0 : -2.0;
    EXPECT_NEAR(end_point_distance(from, system.layout.to_slots(shifted), system.layout, masses, {}), 0.0, 1e-12);
    // One particle moves by an additional d. Relative to the centre it moves by d (1 - m/M), the others by -d m/M.
    const std::size_t moved = 17;
    const double d = 0.7, share = masses[static_cast<std::size_t>(system.configuration.species[moved])] / (87.0 + 21.0 * second);
    shifted[3 * moved + 1] += d;
    const double expected = d * std::sqrt((1.0 - share) * (1.0 - share) + 107.0 * share * share);
    EXPECT_NEAR(end_point_distance(from, system.layout.to_slots(shifted), system.layout, masses, {}), expected, 1e-12);
  }
}

TEST(EndPointDistance, OfOneSpeciesCountsThatSpeciesOnly) {
  System system(kob_andersen(), testing::molten_kob_andersen());
  const AlignedArray from = system.start();
  auto moved = system.configuration.positions;
  std::size_t a = 0, b = 0;
  while (system.configuration.species[a] != 0) ++a;
  while (system.configuration.species[b] != 1) ++b;
  // Opposite motion of two equal masses keeps the centre at rest.
  moved[3 * a] += 0.5;
  moved[3 * b] -= 0.5;
  const AlignedArray to = system.layout.to_slots(moved);
  const auto masses = masses_of(system.model);
  EXPECT_NEAR(end_point_distance(from, to, system.layout, masses, {}), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(end_point_distance(from, to, system.layout, masses, 0), 0.5, 1e-12);
  EXPECT_NEAR(end_point_distance(from, to, system.layout, masses, 1), 0.5, 1e-12);
}

TEST(EndPointGenerator, GoesThroughThePhasesInOrderForAsManyStepsAsAsked) {
  System system(kob_andersen(), testing::molten_kob_andersen());
  auto generator = generator_of(system, few_steps());
  std::vector<std::pair<Phase, int>> phases;
  while (!generator.ended()) {
    if (phases.empty() || phases.back().first != generator.phase()) phases.emplace_back(generator.phase(), 0);
    ++phases.back().second;
    generator.step();
  }
  ASSERT_EQ(phases.size(), 7u);
  const std::vector<std::pair<Phase, int>> expected = {{Phase::melt, 70},
                                                       {Phase::cool, 110},
                                                       {Phase::check, 60},
                                                       {Phase::settle, 130},
                                                       {Phase::pair, static_cast<int>(generator.pairs()[0].steps)},
                                                       {Phase::between, 90},
                                                       {Phase::pair, static_cast<int>(generator.pairs()[1].steps)}};
  EXPECT_EQ(phases, expected);
  EXPECT_EQ(generator.phase(), Phase::done);
}

TEST(EndPointGenerator, CountsOfZeroSkipSettlingAndTheStepsBetweenPairs) {
  System system(kob_andersen(), testing::molten_kob_andersen());
  auto options = few_steps();
  options.settle_steps = options.between_steps = 0;
  auto generator = generator_of(system, options);
  std::map<Phase, int> steps;
  while (!generator.ended()) ++steps[generator.phase()], generator.step();
  EXPECT_EQ(steps.count(Phase::settle) + steps.count(Phase::between), 0u);
  // The end of a pair is then the start of the next.
  EXPECT_EQ(generator.pairs()[0].finish, generator.pairs()[1].start);
}

TEST(EndPointGenerator, RescalesWhileMeltingAndCoolingAndNotAfterwards) {
  System system(kob_andersen(), testing::molten_kob_andersen());
  auto options = few_steps();
  options.distance = 2.0;
  auto generator = generator_of(system, options);
  EXPECT_NEAR(generator.verlet().temperature(), 5.0, 1e-12);
  double energy_after_check = 0.0;
  while (!generator.ended()) {
    const Phase before = generator.phase();
    generator.step();
    const std::uint64_t step = generator.verlet().steps();
    const double temperature = generator.verlet().temperature();
    if (before == Phase::melt && step < 70) {
      EXPECT_EQ(std::fabs(temperature - 5.0) < 1e-12, step % 10 == 0) << step;
    }
    if (before == Phase::cool && step >= 80) {
      EXPECT_EQ(std::fabs(temperature - 1.0) < 1e-12, step % 10 == 0) << step;
    }
    const double energy = generator.verlet().kinetic_energy() + generator.verlet().potential_energy();
    if (step == 190) energy_after_check = energy;
    if (step > 190) {
      EXPECT_NEAR(energy, energy_after_check, 0.1) << step;
    }
  }
}

TEST(EndPointGenerator, PairsAreUnwrappedPointsOfOneTrajectoryAtTheFirstCrossingOfTheDistance) {
  System system(kob_andersen(), testing::molten_kob_andersen());
  auto options = few_steps();
  options.distance = 6.0;
  options.pairs = 1;
  auto generator = generator_of(system, options);
  const auto masses = masses_of(system.model);
  AlignedArray start;
  while (!generator.ended()) {
    const Phase before = generator.phase();
    if (before == Phase::pair && start.empty()) start = generator.verlet().position();
    generator.step();
    if (before == Phase::pair && !generator.ended()) {
      EXPECT_LT(end_point_distance(start, generator.verlet().position(), system.layout, masses, {}), 6.0);
    }
  }
  ASSERT_EQ(generator.pairs().size(), 1u);
  const EndPointPair& pair = generator.pairs()[0];
  EXPECT_EQ(pair.start, start);
  EXPECT_EQ(pair.finish, generator.verlet().position());
  EXPECT_EQ(pair.distance, end_point_distance(pair.start, pair.finish, system.layout, masses, {}));
  EXPECT_GE(pair.distance, 6.0);
  EXPECT_LT(pair.distance, 6.1);
}

TEST(EndPointGenerator, ADistanceOfOneSpeciesTakesLonger) {
  System system(kob_andersen(), testing::molten_kob_andersen());
  auto options = few_steps();
  options.pairs = 1;
  auto both = generator_of(system, options);
  run_to_the_end(both);
  options.distance_species = 1;
  auto one = generator_of(system, options);
  run_to_the_end(one);
  const EndPointPair &all = both.pairs()[0], &small = one.pairs()[0];
  EXPECT_EQ(all.start, small.start);
  EXPECT_GT(small.steps, all.steps);
  EXPECT_EQ(small.distance, end_point_distance(small.start, small.finish, system.layout, masses_of(system.model), 1));
  EXPECT_GE(small.distance, 1.0);
  EXPECT_LT(small.distance, 1.05);
}

TEST(EndPointGenerator, HoldsTheTemperatureWithinTheTolerance) {
  System system(kob_andersen(), testing::molten_kob_andersen());
  EndPointOptions options;
  options.temperature = 1.5;
  options.distance = 3.0;
  options.melt_steps = 1000;
  options.cooling_steps = 10'000;
  options.rescale_interval = 100;
  options.check_steps = 20'000;
  options.check_tolerance = 0.03;
  options.settle_steps = 20'000;
  auto generator = generator_of(system, options);
  run_to_the_end(generator);
  ASSERT_EQ(generator.phase(), Phase::done);
  EXPECT_LT(std::fabs(generator.checked_temperature() - 1.5), 0.03);
  // The temperature after the check has passed, which the check did not use.
  EXPECT_LT(std::fabs(generator.mean_temperature() - 1.5), 0.1);
  EXPECT_NE(generator.mean_temperature(), generator.checked_temperature());
}

TEST(EndPointGenerator, GivesUpAfterAsManyChecksAsAllowed) {
  System system(kob_andersen(), testing::molten_kob_andersen());
  auto options = few_steps();
  options.check_tolerance = 1e-12;
  options.max_checks = 3;
  auto generator = generator_of(system, options);
  run_to_the_end(generator);
  EXPECT_EQ(generator.phase(), Phase::temperature_not_held);
  EXPECT_EQ(generator.verlet().steps(), 70u + 110u + 3u * 60u);
  EXPECT_TRUE(generator.pairs().empty());
}

TEST(EndPointGenerator, GivesUpWhereTheDistanceIsOutOfReach) {
  System system(kob_andersen(), testing::molten_kob_andersen());
  auto options = few_steps();
  options.distance = 50.0;
  options.max_pair_steps = 40;
  auto generator = generator_of(system, options);
  run_to_the_end(generator);
  EXPECT_EQ(generator.phase(), Phase::distance_not_reached);
  EXPECT_EQ(generator.verlet().steps(), 70u + 110u + 60u + 130u + 40u);
}

TEST(EndPointGenerator, ResumedFromAnArchiveInAnyPhaseItEndsWithTheSameBits) {
  System system(kob_andersen(), testing::molten_kob_andersen());
  const auto options = few_steps();
  auto whole = generator_of(system, options);
  run_to_the_end(whole);
  const std::uint64_t first_pair = 370 + whole.pairs()[0].steps;
  const auto file = std::filesystem::temp_directory_path() / ("lanescape-end-points-" + std::to_string(::getpid()) + ".h5");
  // During melting, cooling, check, settling, the first pair, the steps between pairs, the second pair.
  for (const std::uint64_t stop : {std::uint64_t{33}, std::uint64_t{101}, std::uint64_t{207}, std::uint64_t{333}, first_pair - 5,
                                   first_pair + 45, first_pair + 95}) {
    SCOPED_TRACE(stop);
    {
      auto begun = generator_of(system, options);
      while (begun.verlet().steps() < stop) begun.step();
      Hdf5Writer archive(file);
      begun.exchange(archive);
      archive.commit();
    }
    auto other_seed = options;
    other_seed.seed = 99;  // the archive contains everything that matters
    auto resumed = generator_of(system, other_seed);
    Hdf5Reader archive(file);
    resumed.exchange(archive);
    EXPECT_EQ(resumed.verlet().steps(), stop);
    run_to_the_end(resumed);
    ASSERT_EQ(resumed.pairs().size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(resumed.pairs()[k].start, whole.pairs()[k].start);
      EXPECT_EQ(resumed.pairs()[k].finish, whole.pairs()[k].finish);
      EXPECT_EQ(resumed.pairs()[k].distance, whole.pairs()[k].distance);
      EXPECT_EQ(resumed.pairs()[k].steps, whole.pairs()[k].steps);
    }
    EXPECT_EQ(resumed.verlet().velocity(), whole.verlet().velocity());
    EXPECT_EQ(resumed.mean_temperature(), whole.mean_temperature());
    EXPECT_EQ(resumed.checked_temperature(), whole.checked_temperature());
  }
  std::filesystem::remove(file);
}

TEST(EndPointGenerator, OptionsOutOfRangeAreRefused) {
  const auto refused = [](auto change) {
    EndPointOptions options = few_steps();
    options.check();
    change(options);
    EXPECT_THROW(options.check(), Error);
  };
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    refused([&](EndPointOptions& o) { o.temperature = bad; });
    refused([&](EndPointOptions& o) { o.melt_temperature = bad; });
    refused([&](EndPointOptions& o) { o.distance = bad; });
    refused([&](EndPointOptions& o) { o.time_step = bad; });
    refused([&](EndPointOptions& o) { o.check_tolerance = bad; });
  }
  refused([](EndPointOptions& o) { o.pairs = 0; });
  refused([](EndPointOptions& o) { o.rescale_interval = 0; });
  refused([](EndPointOptions& o) { o.check_interval = 0; });
  refused([](EndPointOptions& o) { o.check_steps = o.check_interval - 1; });
  refused([](EndPointOptions& o) { o.time_step = 0.021; });
}

}  // namespace
}  // namespace lanescape
