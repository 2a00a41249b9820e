#include "run/end_point_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "configuration/lattice.hpp"
#include "reference/hard_sphere.hpp"
#include "stopping_monitor.hpp"
#include "test_files.hpp"

namespace lanescape {
namespace {

using testing::refusal;

// Liquids of 32 particles, with protocols of some thousand steps.
struct Soft {
  PairModel model = kob_andersen();
  Configuration start = fcc_start(model, 32, 1.0, 1);
  EndPointOptions options;

  Soft() {
    options.distance = 1.0;
    options.pairs = 2;
    options.melt_steps = options.cooling_steps = options.settle_steps = 1500;
    options.check_steps = options.between_steps = 500;
    options.check_tolerance = 100.0;
  }
  // Most of the run is then equilibration, and a pair takes several chunks.
  void equilibrate_longer() {
    options.melt_steps = 100'000;
    options.distance = 8.0;
  }
  EndPointRunResult run(const CheckpointOptions& checkpoint, RunMonitor& monitor) const {
    return run_end_points(model, start, options, choose_isa("auto"), checkpoint, monitor);
  }
};

struct Hard {
  HardSphereModel model = hard_sphere_binary();
  Configuration start = hard_sphere_start(model, 32, 0.3, Arrangement::random, 1);
  HardEndPointOptions options;

  Hard() {
    options.distance = 2.0;
    options.pairs = 2;
    options.equilibration_collisions = 20'000;
    options.between_collisions = 10'000;
  }
  void equilibrate_longer() {
    options.equilibration_collisions = 1'000'000;
    options.distance = 150.0;
  }
  EndPointRunResult run(const CheckpointOptions& checkpoint, RunMonitor& monitor) const {
    return run_hard_end_points(model, start, options, choose_isa("auto"), checkpoint, monitor);
  }
};

template <class Protocol>
class EndPointRunOf : public ::testing::Test {};
using Protocols = ::testing::Types<Soft, Hard>;
TYPED_TEST_SUITE(EndPointRunOf, Protocols);

double distance(const ConfigurationPair& pair) {
  double sum = 0.0;
  for (std::size_t k = 0; k < pair.start.positions.size(); ++k) {
    const double d = pair.finish.positions[k] - pair.start.positions[k];
    sum += d * d;
  }
  return std::sqrt(sum);
}

TYPED_TEST(EndPointRunOf, MakesPairsTheDistanceApart) {
  const TypeParam protocol;
  SilentMonitor monitor;
  const EndPointRunResult result = protocol.run({}, monitor);
  EXPECT_TRUE(result.done);
  EXPECT_FALSE(result.interrupted);
  EXPECT_EQ(result.ended_as, "done");
  ASSERT_EQ(result.pairs.size(), 2u);
  EXPECT_EQ(result.pair_seconds.size(), 2u);
  for (const ConfigurationPair& pair : result.pairs) {
    EXPECT_GE(pair.distance, protocol.options.distance);
    EXPECT_LT(pair.distance, 1.2 * protocol.options.distance);
    EXPECT_NEAR(distance(pair), pair.distance, 1e-9);  // the centre of mass is at rest
    EXPECT_EQ(pair.start.species, protocol.start.species);
    EXPECT_EQ(pair.start.radii, protocol.start.radii);
  }
  EXPECT_EQ(result.trace.columns(), result.trace_columns.size());
  EXPECT_GT(result.trace.rows(), 0u);
}

constexpr std::string_view name_of_pairs = "towards the far end point";

// Stops a run while it makes a pair.
class StopInAPair final : public RunMonitor {
 public:
  void progress(std::string_view stage, double, double) override { in_pair_ = stage == name_of_pairs; }
  bool stop_requested() const override { return in_pair_; }

 private:
  bool in_pair_ = false;
};

TYPED_TEST(EndPointRunOf, SecondsOfAPairAreWithoutEquilibrationAlsoInAResumedRun) {
  TypeParam protocol;
  protocol.equilibrate_longer();
  protocol.options.pairs = 1;
  SilentMonitor silent;
  const testing::TemporaryFolder folder;
  StopInAPair stopping;
  const EndPointRunResult begun = protocol.run({folder.path(), false}, stopping);
  ASSERT_TRUE(begun.interrupted);
  EXPECT_TRUE(begun.pair_seconds.empty());
  for (const EndPointRunResult& result : {protocol.run({}, silent), protocol.run({folder.path(), true}, silent)}) {
    ASSERT_EQ(result.pair_seconds.size(), 1u);
    EXPECT_GT(result.pair_seconds[0], 0.0);
    EXPECT_LT(result.pair_seconds[0], 0.5 * result.seconds);
  }
}

TYPED_TEST(EndPointRunOf, InterruptedAndResumedEndsWithTheSameBits) {
  const TypeParam protocol;
  SilentMonitor silent;
  const EndPointRunResult whole = protocol.run({}, silent);
  for (const int looks : {1, 2}) {
    const testing::TemporaryFolder folder;
    testing::StoppingMonitor monitor(looks);
    const EndPointRunResult begun = protocol.run({folder.path(), false}, monitor);
    EXPECT_TRUE(begun.interrupted);
    EXPECT_FALSE(begun.done);
    const EndPointRunResult resumed = protocol.run({folder.path(), true}, silent);
    EXPECT_TRUE(resumed.done);
    ASSERT_EQ(resumed.pairs.size(), whole.pairs.size());
    for (std::size_t k = 0; k < whole.pairs.size(); ++k) {
      EXPECT_EQ(resumed.pairs[k].start.positions, whole.pairs[k].start.positions);
      EXPECT_EQ(resumed.pairs[k].finish.positions, whole.pairs[k].finish.positions);
      EXPECT_EQ(resumed.pairs[k].steps, whole.pairs[k].steps);
    }
    EXPECT_EQ(resumed.temperature, whole.temperature);
    EXPECT_EQ(resumed.compressibility, whole.compressibility);
    ASSERT_EQ(resumed.trace.rows(), whole.trace.rows());
    for (std::size_t row = 0; row < whole.trace.rows(); ++row) EXPECT_EQ(resumed.trace.at(row, 2), whole.trace.at(row, 2));
  }
}

TEST(EndPointRun, EndsOfHardSpheresDoNotOverlap) {
  const Hard protocol;
  SilentMonitor monitor;
  for (const ConfigurationPair& pair : protocol.run({}, monitor).pairs)
    for (const Configuration* end : {&pair.start, &pair.finish})
      EXPECT_FALSE(reference::any_overlap(end->positions, end->radii, end->box.length));
}

TEST(EndPointRun, RefusesStartsThatOverlapAndHardSpheresWithoutTheirOwnRun) {
  SilentMonitor monitor;
  Soft soft;
  EXPECT_EQ(refusal([&] { run_end_points(hard_sphere_binary(), soft.start, soft.options, choose_isa("auto"), {}, monitor); }),
            "model hard-sphere-binary has no soft landscape: its spheres are hard");
  std::copy_n(soft.start.positions.begin(), 3, soft.start.positions.begin() + 3);
  EXPECT_EQ(refusal([&] { soft.run({}, monitor); }).rfind("particles 0 and 1 overlap", 0), 0u);
  Hard hard;
  std::copy_n(hard.start.positions.begin(), 3, hard.start.positions.begin() + 3);
  EXPECT_EQ(refusal([&] { hard.run({}, monitor); }).rfind("particles 0 and 1 overlap", 0), 0u);
}

TEST(EndPointRun, RefusesSpeciesThatTheModelDoesNotHave) {
  SilentMonitor monitor;
  const Soft soft;
  for (const AnyModel& model : {AnyModel(lennard_jones()), AnyModel(hard_sphere())})
    EXPECT_NE(refusal([&] {
                run_end_points(model, soft.start, soft.options, choose_isa("auto"), {}, monitor);
              }).find("species 1 is not allowed: the model has 1, numbered from 0"),
              std::string::npos);
}

TEST(EndPointRun, RefusesOptionsOutOfRange) {
  SilentMonitor monitor;
  Soft soft;
  soft.options.pairs = 0;
  EXPECT_EQ(refusal([&] { soft.run({}, monitor); }), "number of pairs must be at least 1");
  Hard hard;
  hard.options.distance = 0.0;
  EXPECT_EQ(refusal([&] { hard.run({}, monitor); }), "distance 0 is not allowed: it must be finite and above 0");
}

}  // namespace
}  // namespace lanescape
