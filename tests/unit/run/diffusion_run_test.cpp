#include "run/diffusion_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "configuration/lattice.hpp"
#include "stopping_monitor.hpp"
#include "test_files.hpp"

namespace lanescape {
namespace {

using testing::refusal;

// Enough records for one query of the monitor in the middle of each trajectory, and one at its end.
constexpr std::uint64_t records = 2000;

struct Soft {
  AnyModel model = kob_andersen();
  Configuration start = fcc_start(kob_andersen(), 16, 0.8, 1);
  DiffusionRunOptions options;

  Soft() {
    options.window = {0.002, 100, records};
    options.relaxation.records = records / 2;
    options.trajectories = 2;
    options.between = 100;
    EndPointOptions& before = options.equilibration;
    before.time_step = 0.002;
    before.distance = 1.0;  // not used
    before.melt_steps = before.cooling_steps = before.settle_steps = before.check_steps = 250;
    before.check_tolerance = 100.0;
  }
};

// Sites in states.
struct States : Soft {
  States() {
    model = liquid_vapour();
    start = fcc_start(liquid_vapour(), 32, 0.5, 1);
  }
};

struct Hard {
  AnyModel model = hard_sphere_binary();
  Configuration start = hard_sphere_start(hard_sphere_binary(), 16, 0.2, Arrangement::random, 1);
  DiffusionRunOptions options;

  Hard() {
    options.window = {0.001, 100, records};
    options.relaxation.records = records + 1500;  // trajectories go on for them
    options.trajectories = 2;
    options.between = 100;
    options.equilibration_collisions = 2000;
  }
};

template <class System>
DiffusionRunResult run(const System& system, const CheckpointOptions& checkpoint, RunMonitor&& monitor = SilentMonitor()) {
  return run_diffusion(system.model, system.start, system.options, choose_isa("auto"), checkpoint, monitor);
}

template <class System>
class DiffusionRunOf : public ::testing::Test {};
using Systems = ::testing::Types<Soft, States, Hard>;
TYPED_TEST_SUITE(DiffusionRunOf, Systems);

TYPED_TEST(DiffusionRunOf, InterruptedAndResumedEndsWithTheSameBits) {
  const TypeParam system;
  const DiffusionRunResult whole = run(system, {});
  EXPECT_FALSE(whole.interrupted);
  EXPECT_TRUE(whole.equilibrated);
  ASSERT_EQ(whole.diffusion.trajectories(), 2u);
  EXPECT_GT(whole.diffusion.vacf_diffusion(0).value, 0.0);
  // After equilibration, during the first trajectory, during the second.
  for (const int looks : {1, 2, 4}) {
    const testing::TemporaryFolder folder;
    const DiffusionRunResult begun = run(system, {folder.path(), false}, testing::StoppingMonitor(looks));
    EXPECT_TRUE(begun.interrupted) << looks;
    EXPECT_LT(begun.diffusion.trajectories(), 2u);
    const DiffusionRunResult resumed = run(system, {folder.path(), true});
    ASSERT_EQ(resumed.diffusion.trajectories(), 2u);
    for (std::size_t s = 0; s < whole.diffusion.species(); ++s) {
      EXPECT_EQ(resumed.diffusion.vacf_diffusion(s).value, whole.diffusion.vacf_diffusion(s).value);
      EXPECT_EQ(resumed.diffusion.msd_diffusion(s).error, whole.diffusion.msd_diffusion(s).error);
      for (std::size_t p = 0; p < whole.relaxation.points(); ++p) {
        EXPECT_EQ(resumed.relaxation.intermediate_scattering(s, p).value, whole.relaxation.intermediate_scattering(s, p).value);
        EXPECT_EQ(resumed.relaxation.non_gaussian(s, p).error, whole.relaxation.non_gaussian(s, p).error);
        EXPECT_EQ(resumed.relaxation.susceptibility(s, p).value, whole.relaxation.susceptibility(s, p).value);
      }
    }
    EXPECT_EQ(resumed.compressibility, whole.compressibility);
    EXPECT_EQ(resumed.pressure, whole.pressure);
    EXPECT_EQ(resumed.temperature, whole.temperature);
  }
}

TEST(DiffusionRun, RefusesWhatCannotBe) {
  const auto refused = [](auto change) {
    Soft system;
    change(system);
    return refusal([&] { run(system, {}); });
  };
  EXPECT_EQ(refused([](Soft& s) { s.options.trajectories = 0; }), "number of trajectories must be at least 1");
  EXPECT_EQ(refused([](Soft& s) { s.options.window.interval = 0.003; }),
            "record interval 0.003 is not allowed: a multiple of the time step 0.002 is needed");
  EXPECT_EQ(refused([](Soft& s) { s.options.window.records = 100; }),
            "100 records are too few for a window of 100: more than that");
  EXPECT_EQ(refused([](Soft& s) {
              std::copy_n(s.start.positions.begin(), 3, s.start.positions.begin() + 3);
            }).rfind("particles 0 and 1 overlap", 0),
            0u);
  EXPECT_EQ(refused([](Soft& s) {
              s = States();
              s.options.equilibration.precision = Precision::mixed;
            }).rfind("mixed precision is not allowed with model", 0),
            0u);
}

TEST(DiffusionRun, RelaxationIsMeasuredAtTheFirstPeakOfTheStructureFactorUnlessGiven) {
  const Soft soft;
  const Hard hard;
  EXPECT_EQ(relaxation_window(soft.model, soft.options).wave_numbers, (std::vector{7.25, 7.25}));
  EXPECT_EQ(relaxation_window(soft.model, soft.options).overlap_length, 0.3);
  const RelaxationWindow large = relaxation_window(hard.model, hard.options);  // diameters 1.4 and 1
  EXPECT_EQ(large.wave_numbers, (std::vector{7.25 / 1.4, 7.25 / 1.4}));
  EXPECT_EQ(large.overlap_length, 0.3 * 1.4);
  EXPECT_EQ(large.records, records + 1500);
  DiffusionRunOptions given = soft.options;
  given.relaxation = {{5.0, 6.0}, 0.2, {}};
  EXPECT_EQ(relaxation_window(soft.model, given).wave_numbers, (std::vector{5.0, 6.0}));
  EXPECT_EQ(relaxation_window(soft.model, given).overlap_length, 0.2);
  EXPECT_EQ(relaxation_window(soft.model, given).records, records);
  given.relaxation.wave_numbers = {5.0, 6.0, 7.0};
  EXPECT_EQ(refusal([&] { relaxation_window(soft.model, given); }),
            "3 wave numbers are given for model kob-andersen: 1 is allowed, or 2, one for each species");
}

// Both measure displacements over the same trajectories, but from different origins.
TYPED_TEST(DiffusionRunOf, DisplacementsAgreeWithThoseOfTheDiffusionWindow) {
  const TypeParam system;
  const DiffusionRunResult run_of = run(system, {});
  for (std::size_t p = 0; p < run_of.relaxation.points(); ++p)
    for (std::size_t k = 1; k < run_of.diffusion.points(); ++k)
      if (std::fabs(run_of.relaxation.time(p) / run_of.diffusion.time(k) - 1.0) < 1e-9) {
        const double expected = run_of.diffusion.squared_displacement(0, k).value;
        EXPECT_NEAR(run_of.relaxation.squared_displacement(0, p).value, expected, 0.15 * expected);
      }
}

// [G] table 4.3, and table 4.5 for two species.
TEST(DiffusionRun, HasTheParametersOfTheSource) {
  const DiffusionRunOptions one = source_diffusion_options(1, 0.10), two = source_diffusion_options(2, 0.50);
  EXPECT_EQ(one.window.interval, 5e-4);
  EXPECT_EQ(one.window.lags, 30'000u);
  EXPECT_EQ(one.window.origins(), 100'000u);
  EXPECT_EQ(one.trajectories, 5u);
  EXPECT_EQ(two.window.interval, 2e-5);
  EXPECT_EQ(two.window.lags, 100'000u);
  EXPECT_EQ(two.window.origins(), 200'000u);
  EXPECT_EQ(two.trajectories, 10u);
}

}  // namespace
}  // namespace lanescape
