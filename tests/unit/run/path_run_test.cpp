#include "run/path_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "stopping_monitor.hpp"
#include "test_files.hpp"
#include "two_particles.hpp"

namespace lanescape {
namespace {

using testing::refusal;
using testing::turned;

// The straight path is forbidden, for Lennard-Jones particles and for hard spheres.
ConfigurationPair soft_pair() { return turned(1.3, 1.25, 120.0); }
ConfigurationPair hard_pair() {
  ConfigurationPair pair = turned(1.5, 1.4, 120.0);
  pair.start.radii = pair.finish.radii = {0.5, 0.5};
  return pair;
}

std::vector<PathResult> search(const AnyModel& model, const std::vector<ConfigurationPair>& pairs, const PathRunOptions& options,
                               const CheckpointOptions& checkpoint = {}) {
  SilentMonitor monitor;
  return run_paths(model, pairs, options, choose_isa("auto"), checkpoint, monitor);
}

// A method with a suitable model, and steps short enough for many queries of the monitor.
struct Method {
  AnyModel model;
  ConfigurationPair pair;
  PathRunOptions options;

  explicit Method(const char* method) : model(lennard_jones()), pair(soft_pair()) {
    options.method = &path_method(method);
    options.direct_step = 1e-4;
    options.finder.frames = 5;
    if (!options.method->is_hard) return;
    model = hard_sphere();
    pair = hard_pair();
    options.avoidance_step = 1e-5;
  }
  PathResult result(const CheckpointOptions& checkpoint = {}) const { return search(model, {pair}, options, checkpoint).front(); }
};

void expect_same_bits(const PathResult& a, const PathResult& b) {
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.length, b.length);
  EXPECT_EQ(a.participation_number, b.participation_number);
  EXPECT_EQ(a.direct_steps, b.direct_steps);
  EXPECT_EQ(a.detour_steps, b.detour_steps);
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_EQ(a.corrections, b.corrections);
  EXPECT_EQ(a.detour_length, b.detour_length);
  EXPECT_EQ(a.largest_violation, b.largest_violation);
  EXPECT_EQ(a.particle_lengths, b.particle_lengths);
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t k = 0; k < a.frames.size(); ++k) EXPECT_EQ(a.frames[k].positions, b.frames[k].positions);
  ASSERT_EQ(a.trace.rows(), b.trace.rows());
  for (std::size_t k = 0; k < a.trace.rows(); ++k)
    EXPECT_EQ(a.trace.at(k, PathRecorder::length), b.trace.at(k, PathRecorder::length));
}

class PathRunBy : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(EveryMethod, PathRunBy, ::testing::Values("contour", "escape", "avoidance", "away"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(PathRunBy, LeadsFromOneEndToTheOther) {
  const Method method(GetParam());
  const PathResult path = method.result();
  ASSERT_EQ(path.outcome, Outcome::reached) << path.reason;
  EXPECT_GT(path.detour_steps, 0u);
  EXPECT_GT(path.length, path.distance);
  EXPECT_EQ(path.ratio_squared(), path.distance * path.distance / (path.length * path.length));
  EXPECT_EQ(path.frames.front().positions, method.pair.start.positions);
  EXPECT_EQ(path.frames.back().positions, method.pair.finish.positions);
  EXPECT_EQ(path.frames.back().radii, method.pair.start.radii);
  // The two particles move by opposite vectors.
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(path.particle_displacements[j], path.distance / std::numbers::sqrt2, 1e-12);
    EXPECT_GT(path.particle_lengths[j], path.particle_displacements[j]);
  }
  EXPECT_LE(path.largest_violation, path_method(GetParam()).is_hard ? 1e-10 : 1e-4);
}

TEST_P(PathRunBy, InterruptedAndResumedEndsWithTheSameBits) {
  const Method method(GetParam());
  const PathResult whole = method.result();
  const bool long_enough = GetParam() != std::string("away");  // it has too few steps for a query of the monitor
  for (const int looks : {1, 3}) {
    const testing::TemporaryFolder folder;
    testing::StoppingMonitor monitor(looks);
    const PathResult begun =
        run_paths(method.model, {method.pair}, method.options, choose_isa("auto"), {folder.path(), false}, monitor).front();
    EXPECT_EQ(begun.outcome, long_enough ? Outcome::interrupted : Outcome::reached);
    EXPECT_EQ(begun.direct_steps + begun.detour_steps < whole.direct_steps + whole.detour_steps, long_enough);
    const PathResult resumed = method.result({folder.path(), true}), again = method.result({folder.path(), true});
    expect_same_bits(resumed, whole);
    expect_same_bits(again, whole);  // the run is already finished
    EXPECT_EQ(again.seconds, resumed.seconds);
  }
}

// Adaptive steps, in all methods that have them.
class AdaptivePathRunBy : public ::testing::TestWithParam<std::string> {
 protected:
  AdaptivePathRunBy() {
    adaptive_.options.stepping = Stepping::adaptive;
    adaptive_.options.direct_step = adaptive_.options.avoidance_step = std::nullopt;
  }
  Method faithful_{GetParam().c_str()}, adaptive_{GetParam().c_str()};
};
std::vector<std::string> adaptive_methods() {
  std::vector<std::string> words;
  for (const PathMethod& method : path_methods())
    if (method.begin_adaptive != nullptr) words.emplace_back(method.word);
  return words;
}
INSTANTIATE_TEST_SUITE_P(EveryMethod, AdaptivePathRunBy, ::testing::ValuesIn(adaptive_methods()),
                         [](const auto& tested) { return tested.param; });

TEST_P(AdaptivePathRunBy, LeadsFromOneEndToTheOtherInFewerSteps) {
  const PathResult faithful = faithful_.result(), path = adaptive_.result();
  ASSERT_EQ(path.outcome, Outcome::reached) << path.reason;
  EXPECT_GT(path.detour_steps, 0u);
  EXPECT_LT(10 * path.evaluations, faithful.evaluations);
  EXPECT_LE(path.length, 1.002 * faithful.length);
  EXPECT_NEAR(path.direct_length + path.detour_length, path.length, 1e-12);
  EXPECT_EQ(path.frames.front().positions, adaptive_.pair.start.positions);
  EXPECT_EQ(path.frames.back().positions, adaptive_.pair.finish.positions);
  EXPECT_LE(path.largest_violation, 1e-3);
}

TEST_P(AdaptivePathRunBy, ResumedFromACheckpointIsFinishedAlike) {
  const PathResult whole = adaptive_.result();
  const testing::TemporaryFolder folder;
  expect_same_bits(adaptive_.result({folder.path(), false}), whole);
  expect_same_bits(adaptive_.result({folder.path(), true}), whole);
}

TEST_P(AdaptivePathRunBy, CountsStepsWithTheirLengthInItsHistograms) {
  const PathResult path = adaptive_.result();
  for (const StepHistogram& histogram : path.histograms) {
    if (histogram.quantity != "participation_ratio" && histogram.quantity != "alpha_2") continue;
    double sum = 0.0;
    for (const double count : histogram.counts) sum += count;
    EXPECT_NEAR(sum, path.length, 1e-8) << histogram.quantity;
  }
}

TEST(PathRun, DoesNotDependOnTheNumberOfThreads) {
  Method method("contour");
  const std::vector<ConfigurationPair> pairs{turned(1.3, 1.25, 120.0), turned(1.3, 1.2, 100.0), turned(1.2, 1.3, 80.0)};
  const auto one = search(method.model, pairs, method.options);
  method.options.threads = 2;
  const auto two = search(method.model, pairs, method.options);
  for (std::size_t k = 0; k < pairs.size(); ++k) expect_same_bits(one[k], two[k]);
  EXPECT_NE(one[0].length, one[1].length);
}

TEST(PathRun, InReverseKeepsTheShorterPath) {
  Method method("contour");
  method.options.direct_step = 1e-3;
  bool kept_forward = false, kept_backward = false;
  for (const auto& [before, after] : {std::pair{1.3, 1.15}, {1.15, 1.3}}) {
    method.pair = turned(before, after, 120.0);
    const double forward = method.result().length;
    Method other_way = method;
    std::swap(other_way.pair.start, other_way.pair.finish);
    const double backward = other_way.result().length;
    method.options.reverse = true;
    const PathResult kept = method.result();
    method.options.reverse = false;
    EXPECT_EQ(kept.length, std::min(forward, backward));
    EXPECT_EQ(kept.reversed, backward < forward);
    EXPECT_EQ(kept.frames.front().positions, (kept.reversed ? method.pair.finish : method.pair.start).positions);
    EXPECT_EQ(kept.frames.back().positions, (kept.reversed ? method.pair.start : method.pair.finish).positions);
    (kept.reversed ? kept_backward : kept_forward) = true;
  }
  EXPECT_TRUE(kept_forward);
  EXPECT_TRUE(kept_backward);
}

TEST(PathRun, TheLandscapeEnergyIsThatOfTheHigherEndUnlessItIsGiven) {
  Method method("contour");
  method.options.direct_step = 1e-3;
  const auto shifted = [](double r) {
    return 4.0 * (std::pow(r, -12) - std::pow(r, -6)) - 4.0 * (std::pow(2.5, -12) - std::pow(2.5, -6));
  };
  const double higher = shifted(1.3);
  EXPECT_NEAR(method.result().landscape_energy, higher, 1e-12);
  method.options.landscape_energy = 10.0;
  const PathResult path = method.result();
  EXPECT_EQ(path.landscape_energy, 10.0);
  EXPECT_LT(path.length, Method("contour").result().length);  // a higher landscape energy allows shorter paths
  method.options.landscape_energy = higher - 0.01;
  EXPECT_EQ(refusal([&] { method.result(); }).rfind("pair 1: an end point has energy -0.", 0), 0u);
}

TEST(PathRun, CountsEveryStepInItsHistograms) {
  const Method method("avoidance");
  const PathResult path = method.result();
  const auto counted = [&](const std::string& quantity) {
    for (const StepHistogram& histogram : path.histograms)
      if (histogram.quantity == quantity) {
        double sum = 0.0;
        for (const double count : histogram.counts) sum += count;
        return static_cast<std::uint64_t>(sum);
      }
    ADD_FAILURE() << quantity;
    return std::uint64_t{0};
  };
  EXPECT_EQ(counted("participation_ratio"), path.direct_steps + path.detour_steps);
  EXPECT_EQ(counted("alpha_2"), path.direct_steps + path.detour_steps);
  const std::uint64_t interval = AvoidanceStepper::statistics_interval;
  EXPECT_EQ(counted("moved_particles"), (path.detour_steps + interval - 1) / interval);
}

TEST(StepHistogram, HasTheMeanOfItsCounts) {
  EXPECT_DOUBLE_EQ((StepHistogram{"", 1.0, 0.5, {1, 0, 3}}.mean()), (1.0 + 3.0 * 2.0) / 4.0);
  EXPECT_EQ((StepHistogram{"", 1.0, 0.5, {0, 0}}.mean()), 0.0);
}

TEST(CheckEndPoints, RefusesEndsThatDoNotBelongTogether) {
  const auto refused = [](auto change) {
    ConfigurationPair pair = hard_pair();
    pair.start.diameters = pair.finish.diameters = {1.0, 1.0};
    check_end_points(pair, hard_sphere(), "here");
    change(pair);
    return refusal([&] { check_end_points(pair, hard_sphere(), "here"); });
  };
  EXPECT_EQ(refused([](ConfigurationPair& p) { p.finish.box.length[1] = 11.0; }), "here: the two end points have different boxes");
  EXPECT_EQ(refused([](ConfigurationPair& p) { p.finish.species[1] = 1; }),
            "here: the two end points differ in composition or in the order of their particles");
  EXPECT_EQ(refused([](ConfigurationPair& p) { p.finish.radii[1] = 0.4; }), "here: the two end points have different radii");
  EXPECT_EQ(refused([](ConfigurationPair& p) { p.finish.diameters[1] = 0.9; }),
            "here: the two end points have different diameters");
  EXPECT_EQ(refused([](ConfigurationPair& p) { p.finish = p.start; }), "here: the two end points coincide");
}

TEST(CheckEndPoints, RefusesEndsThatOverlapAndSaysWhich) {
  const auto refused = [](const AnyModel& model, ConfigurationPair pair, bool first) {
    (first ? pair.start : pair.finish).positions = {5.0, 5.0, 5.0, 5.25, 5.0, 5.0};
    return refusal([&] { check_end_points(pair, model, "here"); });
  };
  EXPECT_EQ(refused(hard_sphere(), hard_pair(), true).rfind("here, first end: particles 0 and 1 overlap by 0.75", 0), 0u);
  EXPECT_EQ(refused(hard_sphere(), hard_pair(), false).rfind("here, last end: particles 0 and 1 overlap by 0.75", 0), 0u);
  EXPECT_EQ(
      refused(lennard_jones(), soft_pair(), false).rfind("here, last end: particles 0 and 1 overlap: their distance is 0.25", 0),
      0u);
}

TEST(PathRun, RefusesPairsByTheirNumber) {
  const Method method("contour");
  EXPECT_EQ(refusal([&] { search(method.model, {}, method.options); }), "no pair of end points was given");
  ConfigurationPair same = method.pair;
  same.finish = same.start;
  EXPECT_EQ(refusal([&] { search(method.model, {method.pair, same}, method.options); }), "pair 2: the two end points coincide");
  Method hard("avoidance");
  HardSphereModel unequal = hard_sphere_binary();
  unequal.species[0].mass = 2.0;
  hard.model = unequal;
  EXPECT_EQ(refusal([&] { hard.result(); }),
            "pair 1: hard spheres of unequal masses have no faithful path: adaptive steps are needed");
}

TEST(PathRun, SlidesHardSpheresOfUnequalMassesWithAdaptiveSteps) {
  Method hard("avoidance");
  HardSphereModel unequal = hard_sphere_binary();
  unequal.species[0].mass = 2.0;
  hard.model = unequal;
  hard.pair.start.species = hard.pair.finish.species = {0, 1};
  hard.options.stepping = Stepping::adaptive;
  hard.options.direct_step.reset();
  const PathResult path = hard.result();
  EXPECT_EQ(path.outcome, Outcome::reached) << path.reason;
  EXPECT_GT(path.detour_steps, 0u);
  EXPECT_LE(path.largest_violation, 1e-12);
  EXPECT_EQ(path.frames.back().positions, hard.pair.finish.positions);
}

TEST(PathRun, RefusesOptionsOutOfRange) {
  const auto refused = [](const char* of_method, auto change) {
    Method method(of_method);
    method.options.check(method.model);
    change(method.options);
    return refusal([&] { method.result(); });
  };
  for (const double bad : {0.0, -1.0, 1.1, std::nan("")})
    EXPECT_NE(refused("contour", [&](PathRunOptions& o) { o.direct_step = bad; }).find("step"), std::string::npos);
  EXPECT_EQ(refused("avoidance", [](PathRunOptions& o) { o.avoidance_step = 0.2; }),
            "avoidance step 0.2 is not allowed: above 0 and at most 0.1");
  EXPECT_EQ(refused("avoidance", [](PathRunOptions& o) { o.landscape_energy = 1.0; }),
            "hard spheres have no landscape energy: without it only");
  EXPECT_EQ(refused("contour", [](PathRunOptions& o) { o.landscape_energy = HUGE_VAL; }),
            "landscape energy inf is not allowed: it must be finite");
  EXPECT_EQ(
      refused("escape", [](PathRunOptions& o) { o.stepping = Stepping::adaptive; }).rfind("method escape has no adaptive steps", 0),
      0u);
  EXPECT_EQ(refused("contour", [](PathRunOptions& o) { o.stepping = Stepping::adaptive; }),
            "adaptive steps have no given length: without a step only");
  EXPECT_EQ(refused("contour", [](PathRunOptions& o) { o.finder.max_steps = 0; }), "the step limit must be at least 1");
  EXPECT_EQ(refused("contour", [](PathRunOptions& o) { o.finder.frames = 100'001; }),
            "100001 frames are not allowed: at most 100000");
  EXPECT_EQ(refused("contour", [](PathRunOptions& o) { o.method = &path_method("away"); }).rfind("method away is not for model", 0),
            0u);
}

TEST(PathMethod, HasWordsThatAreReadBack) {
  for (const PathMethod& method : path_methods()) EXPECT_EQ(&path_method(method.word), &method);
  EXPECT_EQ(std::string(default_path_method(false).word), "contour");
  EXPECT_EQ(std::string(default_path_method(true).word), "avoidance");
  EXPECT_EQ(refusal([] { path_method("walk"); }),
            "unknown method 'walk': allowed are contour, escape (soft particles), avoidance, away (hard spheres)");
}

}  // namespace
}  // namespace lanescape
