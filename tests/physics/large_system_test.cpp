// Dynamics and paths over neighbour lists. An archive must keep everything that depends on where a list was built, and no result
// may depend on the number of threads.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "configuration/lattice.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "io/hdf5_archive.hpp"
#include "neighbour/neighbour_list.hpp"
#include "path/finder.hpp"
#include "run/path_run.hpp"
#include "stepper/adaptive_contour.hpp"
#include "stepper/contour.hpp"
#include "stepper/escape.hpp"
#include "systems.hpp"

namespace lanescape {
namespace {

constexpr std::size_t particles = 256;

struct Liquid {
  PairModel model = kob_andersen();
  Configuration configuration = fcc_start(model, particles, 1.2, 1);
  ParticleLayout layout{configuration.species, 2};

  PairLandscape landscape(int threads = 1, PairSearch search = PairSearch::automatic) const {
    return {model, configuration.box, layout, testing::active_isa(), {.search = search, .threads = threads}};
  }
  VelocityVerlet moving(SoftLandscape& landscape, double temperature = 3.0) const {
    VelocityVerlet verlet(landscape, model, layout, layout.to_slots(configuration.positions), 2e-3);
    verlet.draw_velocities(temperature, 1);
    return verlet;
  }
};

void run(VelocityVerlet& verlet, int steps) {
  for (int k = 0; k < steps; ++k) verlet.step();
}

std::filesystem::path scratch_file() {
  return std::filesystem::temp_directory_path() / ("lanescape-large-" + std::to_string(::getpid()) + ".h5");
}

template <class State>
void write(State& state) {
  Hdf5Writer archive(scratch_file());
  state.exchange(archive);
  archive.commit();
}

template <class State>
void read(State& state) {
  Hdf5Reader archive(scratch_file());
  state.exchange(archive);
  std::filesystem::remove(scratch_file());
}

TEST(LargeSystems, AreOfTheSizeThatTakesAList) { EXPECT_GE(particles, list_crossover); }

TEST(LargeSystems, DynamicsOverAListFollowsThatOverAllPairs) {
  const Liquid liquid;
  auto by_list = liquid.landscape(1, PairSearch::list), by_pairs = liquid.landscape(1, PairSearch::all_pairs);
  VelocityVerlet a = liquid.moving(by_list), b = liquid.moving(by_pairs);
  run(a, 200);
  run(b, 200);
  // Rounding errors grow by a factor of about e per tenth of a time unit.
  for (std::size_t k = 0; k < a.position().size(); ++k) ASSERT_NEAR(a.position()[k], b.position()[k], 1e-9) << k;
}

TEST(LargeSystems, DynamicsOverAListConservesEnergyThroughManyRebuilds) {
  const Liquid liquid;
  auto landscape = liquid.landscape();
  VelocityVerlet verlet = liquid.moving(landscape);
  run(verlet, 500);
  const auto total = [&] { return (verlet.potential_energy() + verlet.kinetic_energy()) / static_cast<double>(particles); };
  const double before = total();
  for (int k = 0; k < 10; ++k) {
    run(verlet, 100);
    EXPECT_NEAR(total(), before, 2e-3);
  }
}

TEST(LargeSystems, DynamicsDoesNotDependOnTheNumberOfThreads) {
  const Liquid liquid;
  auto one = liquid.landscape(1), three = liquid.landscape(3);
  VelocityVerlet a = liquid.moving(one), b = liquid.moving(three);
  run(a, 100);
  run(b, 100);
  EXPECT_EQ(a.position(), b.position());
  EXPECT_EQ(a.potential_energy(), b.potential_energy());
}

// Stops where the list is fresh, half used and about to be rebuilt.
TEST(LargeSystems, DynamicsResumedFromAnArchiveGoesOnWithTheSameBits) {
  const Liquid liquid;
  auto landscape = liquid.landscape();
  VelocityVerlet whole = liquid.moving(landscape);
  run(whole, 120);
  for (const int stop : {1, 7, 13, 20, 31, 44, 58}) {
    auto first = liquid.landscape(), second = liquid.landscape(2);
    VelocityVerlet begun = liquid.moving(first);
    run(begun, stop);
    write(begun);
    VelocityVerlet resumed = liquid.moving(second, 1.0);
    read(resumed);
    run(resumed, 120 - stop);
    EXPECT_EQ(resumed.position(), whole.position()) << stop;
    EXPECT_EQ(resumed.potential_energy(), whole.potential_energy()) << stop;
  }
}

// The errors stated in src/interaction/README.md.
TEST(LargeSystems, InMixedPrecisionALiquidHasNearlyItsEnergyAndForces) {
  const PairModel model = kob_andersen();
  const Configuration start = fcc_start(model, 4000, 1.2, 1);
  const ParticleLayout layout(start.species, 2);
  PairLandscape landscape(model, start.box, layout, testing::active_isa());
  VelocityVerlet verlet(landscape, model, layout, layout.to_slots(start.positions), 2e-3);
  verlet.draw_velocities(4.0, 1);
  run(verlet, 300);
  PairInteraction exact(model, start.box, layout, kernel_table(testing::active_isa())),
      mixed(model, start.box, layout, kernel_table(testing::active_isa()), {.precision = Precision::mixed});
  AlignedArray exact_gradient(layout.dimension(), 0.0), mixed_gradient = exact_gradient;
  const auto expected = exact.energy_and_gradient(verlet.position(), exact_gradient);
  const auto found = mixed.energy_and_gradient(verlet.position(), mixed_gradient);
  EXPECT_NEAR(found.energy / 4000.0, expected.energy / 4000.0, 2e-7);
  EXPECT_NEAR(found.virial / 4000.0, expected.virial / 4000.0, 3e-6);
  double largest = 0.0, error = 0.0;
  for (std::size_t k = 0; k < layout.dimension(); ++k) {
    largest = std::max(largest, std::fabs(exact_gradient[k]));
    error = std::max(error, std::fabs(mixed_gradient[k] - exact_gradient[k]));
  }
  EXPECT_LT(error, 3e-6 * largest);
  RecordProperty("energy_error", std::to_string(1e9 * (found.energy - expected.energy) / 4000.0) + "e-9");
  RecordProperty("virial_error", std::to_string(1e9 * (found.virial - expected.virial) / 4000.0) + "e-9");
  RecordProperty("force_error", std::to_string(1e9 * error / largest) + "e-9");
}

TEST(LargeSystems, DynamicsInMixedPrecisionConservesEnergyAsInDouble) {
  const PairModel model = kob_andersen();
  const Configuration start = fcc_start(model, 500, 1.2, 1);
  const ParticleLayout layout(start.species, 2);
  const auto drift_in = [&](Precision precision) {
    PairLandscape landscape(model, start.box, layout, testing::active_isa(), {.precision = precision});
    VelocityVerlet verlet(landscape, model, layout, layout.to_slots(start.positions), 1e-3);
    verlet.draw_velocities(3.0, 1);
    run(verlet, 500);
    const auto total = [&] { return (verlet.potential_energy() + verlet.kinetic_energy()) / 500.0; };
    const double before = total();
    double worst = 0.0;
    for (int k = 0; k < 40; ++k) {
      run(verlet, 100);
      worst = std::max(worst, std::fabs(total() - before));
    }
    RecordProperty(to_string(precision), std::to_string(1e6 * worst) + "e-6");
    return worst;
  };
  // Most of it comes from the jump of forces at the cutoff, in either precision.
  EXPECT_LT(drift_in(Precision::double_precision), 5e-4);
  EXPECT_LT(drift_in(Precision::mixed), 5e-4);
}

TEST(LargeSystems, DynamicsInMixedPrecisionResumesWithTheSameBitsOnAnyNumberOfThreads) {
  const Liquid liquid;
  const auto in_mixed = [&](int threads) {
    return PairLandscape(liquid.model, liquid.configuration.box, liquid.layout, testing::active_isa(),
                         {.threads = threads, .precision = Precision::mixed});
  };
  auto one = in_mixed(1), first = in_mixed(1), second = in_mixed(2);
  VelocityVerlet whole = liquid.moving(one), begun = liquid.moving(first), resumed = liquid.moving(second, 1.0);
  run(whole, 100);
  run(begun, 37);
  write(begun);
  read(resumed);
  run(resumed, 63);
  EXPECT_EQ(resumed.position(), whole.position());
  EXPECT_EQ(resumed.potential_energy(), whole.potential_energy());
}

// Two configurations of one trajectory and the landscape energy for a path between them.
struct Ends {
  AlignedArray start, goal;
  double energy;
};

Ends ends(const Liquid& liquid) {
  auto landscape = liquid.landscape();
  VelocityVerlet verlet = liquid.moving(landscape);
  run(verlet, 1500);
  Ends ends{testing::lowest_on_the_way(verlet, 300), {}, 0.0};
  run(verlet, 250);
  ends.goal = testing::lowest_on_the_way(verlet, 300);
  ends.energy = std::max(landscape.energy(ends.start), landscape.energy(ends.goal));
  return ends;
}

template <class Stepper>
constexpr bool has_step_length = requires(typename Stepper::Options options) { options.direct_step; };

template <class Stepper>
PathFinder<Stepper> finder_on(PairLandscape& landscape, const Ends& ends) {
  typename Stepper::Options options;
  // Long enough for many rebuilds of the list.
  if constexpr (has_step_length<Stepper>) options.direct_step = 0.03;
  return {landscape.algebra(), Stepper(landscape, ends.energy, options), ends.start, ends.goal, particles, FinderOptions{}};
}

template <class Stepper>
void expect_resumed_path_to_have_the_same_bits() {
  const Liquid liquid;
  const Ends between = ends(liquid);
  auto landscape = liquid.landscape();
  auto whole = finder_on<Stepper>(landscape, between);
  whole.advance(1'000'000);
  ASSERT_EQ(whole.outcome(), Outcome::reached) << whole.reason();
  ASSERT_GT(whole.detour_steps(), has_step_length<Stepper> ? 100u : 10u);
  for (const std::uint64_t stop : {std::uint64_t{1}, whole.steps() / 3, whole.steps() / 2, whole.steps() - 1}) {
    auto first = liquid.landscape(), second = liquid.landscape(2);
    auto begun = finder_on<Stepper>(first, between);
    begun.advance(stop);
    write(begun);
    auto resumed = finder_on<Stepper>(second, between);
    read(resumed);
    resumed.advance(1'000'000);
    EXPECT_EQ(resumed.steps(), whole.steps()) << stop;
    EXPECT_EQ(resumed.statistics().length(), whole.statistics().length()) << stop;
    EXPECT_EQ(resumed.largest_violation(), whole.largest_violation()) << stop;
  }
}

TEST(LargeSystems, AContourPathResumedFromAnArchiveGoesOnWithTheSameBits) {
  expect_resumed_path_to_have_the_same_bits<ContourStepper>();
}

TEST(LargeSystems, AnAdaptivePathResumedFromAnArchiveGoesOnWithTheSameBits) {
  expect_resumed_path_to_have_the_same_bits<AdaptiveContourStepper>();
}

TEST(LargeSystems, AnEscapePathResumedFromAnArchiveGoesOnWithTheSameBits) {
  expect_resumed_path_to_have_the_same_bits<EscapeStepper>();
}

TEST(LargeSystems, APathOverAListIsAsLongAsThatOverAllPairs) {
  const Liquid liquid;
  const Ends between = ends(liquid);
  auto by_list = liquid.landscape(2, PairSearch::list), by_pairs = liquid.landscape(1, PairSearch::all_pairs);
  auto a = finder_on<ContourStepper>(by_list, between), b = finder_on<ContourStepper>(by_pairs, between);
  a.advance(1'000'000);
  b.advance(1'000'000);
  ASSERT_EQ(a.outcome(), Outcome::reached);
  ASSERT_EQ(b.outcome(), Outcome::reached);
  EXPECT_NEAR(a.statistics().length(), b.statistics().length(), 0.01 * b.statistics().length());
}

}  // namespace
}  // namespace lanescape
