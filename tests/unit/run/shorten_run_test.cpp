#include "run/shorten_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "run/given_path.hpp"
#include "stopping_monitor.hpp"
#include "test_files.hpp"
#include "two_particles.hpp"

namespace lanescape {
namespace {

using testing::refusal;
using testing::turned;

// A path method, `adaptive_contour` with adaptive steps, with a suitable pair, whose straight path is forbidden.
struct Case {
  AnyModel model = lennard_jones();
  ConfigurationPair pair = turned(1.3, 1.25, 120.0);
  ShortenOptions options;

  explicit Case(std::string_view word) {
    constexpr std::string_view adaptive = "adaptive_";
    if (word.starts_with(adaptive)) {
      word.remove_prefix(adaptive.size());
      options.search.stepping = Stepping::adaptive;
    }
    options.method = &shorten_method("montecarlo");
    options.search.method = &path_method(word);
    if (!options.search.method->is_hard) return;
    model = hard_sphere();
    pair = turned(3.0, 3.0, 170.0);
    pair.start.radii = pair.finish.radii = {0.5, 0.5};
    options.search.direct_step = 1e-3;
  }
  ShortenResult result(const CheckpointOptions& checkpoint = {}, const std::vector<Configuration>& nodes = {}) const {
    SilentMonitor monitor;
    return run_shorten(model, pair, nodes, options, choose_isa("auto"), checkpoint, monitor);
  }
  PathResult greedy() const {
    SilentMonitor monitor;
    return run_paths(model, {pair}, options.search, choose_isa("auto"), {}, monitor).front();
  }
  std::vector<Configuration> fit(const std::vector<Configuration>& nodes) const {
    return fit_path(nodes, model, pair, "here", options.search, choose_isa("auto"));
  }
};

std::size_t accepted(const ShortenResult& result) {
  const auto& trials = result.shortest.trials;
  return static_cast<std::size_t>(std::count_if(trials.begin(), trials.end(), [](const ShortenTrial& t) { return t.accepted; }));
}

void expect_same_bits(const ShortenResult& a, const ShortenResult& b) {
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.length_before, b.length_before);
  EXPECT_EQ(a.start_lengths, b.start_lengths);
  const PathResult &p = a.shortest.path, &q = b.shortest.path;
  EXPECT_EQ(p.length, q.length);
  EXPECT_EQ(p.participation_number, q.participation_number);
  EXPECT_EQ(p.direct_steps, q.direct_steps);
  EXPECT_EQ(p.detour_steps, q.detour_steps);
  EXPECT_EQ(p.corrections, q.corrections);
  EXPECT_EQ(p.largest_violation, q.largest_violation);
  EXPECT_EQ(p.particle_lengths, q.particle_lengths);
  EXPECT_EQ(p.heterogeneity, q.heterogeneity);
  ASSERT_EQ(p.frames.size(), q.frames.size());
  for (std::size_t k = 0; k < p.frames.size(); ++k) EXPECT_EQ(p.frames[k].positions, q.frames[k].positions);
  ASSERT_EQ(a.shortest.trials.size(), b.shortest.trials.size());
  for (std::size_t k = 0; k < a.shortest.trials.size(); ++k) {
    EXPECT_EQ(a.shortest.trials[k].distance_left, b.shortest.trials[k].distance_left);
    EXPECT_EQ(a.shortest.trials[k].length, b.shortest.trials[k].length);
  }
}

class ShortenBy : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(EveryPathMethod, ShortenBy,
                         ::testing::Values("contour", "adaptive_contour", "escape", "avoidance", "away"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(ShortenBy, NeverLengthensAPathAndEndsAfterFiveFailures) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Case of(GetParam());
    of.options.seed = seed;
    const ShortenResult result = of.result();
    ASSERT_EQ(result.outcome, Outcome::reached) << result.reason;
    EXPECT_EQ(result.length_before, of.greedy().length);
    EXPECT_LE(result.shortest.path.length, result.length_before);
    EXPECT_GE(result.shortest.path.length, result.shortest.path.distance);
    const auto& trials = result.shortest.trials;
    ASSERT_GE(trials.size(), 5u);
    EXPECT_TRUE(std::none_of(trials.end() - 5, trials.end(), [](const ShortenTrial& t) { return t.accepted; }));
    double shortest = result.length_before;
    for (const ShortenTrial& trial : trials) {
      EXPECT_EQ(trial.accepted, trial.length && *trial.length < shortest);
      if (trial.accepted) shortest = *trial.length;
    }
    EXPECT_EQ(result.shortest.path.length, shortest);
  }
}

TEST_P(ShortenBy, JoinsAPathBetweenTheEndsThatIsAllowedAllAlong) {
  const Case of(GetParam());
  const ShortenResult result = of.result();
  const PathResult& path = result.shortest.path;
  EXPECT_EQ(path.frames.front().positions, of.pair.start.positions);
  EXPECT_EQ(path.frames.back().positions, of.pair.finish.positions);
  EXPECT_LE(path.frames.size(), 1002u);
  EXPECT_EQ(path.frames[1].radii, of.pair.start.radii);
  of.fit(path.frames);  // refuses frames outside the region
  EXPECT_LE(path.largest_violation, of.options.search.method->is_hard ? 1e-10 : 1.001e-4);
  // Particles move by opposite vectors until one of them is displaced alone.
  double along_frames = 0.0;
  for (std::size_t k = 1; k < path.frames.size(); ++k) {
    double squared = 0.0;
    for (std::size_t c = 0; c < 6; ++c) squared += std::pow(path.frames[k].positions[c] - path.frames[k - 1].positions[c], 2);
    along_frames += std::sqrt(squared);
  }
  EXPECT_LE(along_frames, path.length * (1.0 + 1e-12));
  EXPECT_GE(along_frames, 0.9 * path.length);
  for (const StepHistogram& histogram : path.histograms) {
    if (histogram.quantity != "participation_ratio") continue;
    double steps = 0.0;
    for (const double count : histogram.counts) steps += count;
    if (of.options.search.stepping == Stepping::faithful) {
      EXPECT_EQ(steps, static_cast<double>(path.direct_steps + path.detour_steps));
    } else {
      EXPECT_LE(steps, path.length);  // weighted with length; the hops to the ends are no steps
      EXPECT_GT(steps, 0.8 * path.length);
    }
  }
}

TEST_P(ShortenBy, InterruptedAndResumedEndsWithTheSameBits) {
  const Case of(GetParam());
  const ShortenResult whole = of.result();
  for (const int looks : {2, 12}) {
    const testing::TemporaryFolder folder;
    testing::StoppingMonitor monitor(looks);
    const ShortenResult begun = run_shorten(of.model, of.pair, {}, of.options, choose_isa("auto"), {folder.path(), false}, monitor);
    EXPECT_EQ(begun.outcome, Outcome::interrupted);
    EXPECT_LT(begun.shortest.trials.size(), whole.shortest.trials.size());
    const ShortenResult resumed = of.result({folder.path(), true}), again = of.result({folder.path(), true});
    expect_same_bits(resumed, whole);
    expect_same_bits(again, whole);  // the run is already finished
    EXPECT_EQ(again.seconds, resumed.seconds);
  }
}

TEST(Shorten, BringsTwoSpheresNearTheGeodesicAndNeverBelowIt) {
  // PHYSICS 6: distances 3, contact at 1, 170 degrees.
  const double angle = 170.0 * std::numbers::pi / 180.0;
  const double geodesic = (2.0 * std::sqrt(8.0) + angle - 2.0 * std::acos(1.0 / 3.0)) / std::numbers::sqrt2;
  EXPECT_NEAR(geodesic * std::numbers::sqrt2, 6.1620, 1e-4);
  Case of("avoidance");
  of.options.starts = 20;
  const ShortenResult result = of.result();
  for (const double length : result.start_lengths) EXPECT_GE(length, geodesic * (1.0 - 1e-6));
  EXPECT_GT(result.length_before, 1.4 * geodesic);
  EXPECT_LT(result.shortest.path.length, 1.01 * geodesic);
  EXPECT_GT(accepted(result), 0u);
}

TEST(Shorten, FindsAShorterSoftPath) {
  Case of("contour");
  of.options.starts = 5;
  const ShortenResult result = of.result();
  EXPECT_GT(accepted(result), 0u);
  EXPECT_LT(result.shortest.path.length, result.length_before);
}

TEST(Shorten, LeavesAStraightPathAsItIs) {
  Case of("contour");
  of.options.search.landscape_energy = 1e6;
  const ShortenResult result = of.result();
  EXPECT_EQ(result.shortest.trials.size(), 5u);
  EXPECT_EQ(accepted(result), 0u);
  EXPECT_EQ(result.shortest.path.length, result.length_before);
  EXPECT_NEAR(result.shortest.path.length, result.shortest.path.distance, 1e-9);
}

TEST(Shorten, KeepsTheShortestOfItsStartsOnAnyNumberOfThreads) {
  Case of("avoidance");
  of.options.starts = 3;
  const ShortenResult one = of.result();
  of.options.search.threads = 2;
  const ShortenResult two = of.result();
  expect_same_bits(one, two);
  ASSERT_EQ(one.start_lengths.size(), 3u);
  EXPECT_EQ(one.shortest.path.length, *std::min_element(one.start_lengths.begin(), one.start_lengths.end()));
  EXPECT_NE(one.start_lengths[0], one.start_lengths[1]);
  of.options.starts = 1;
  EXPECT_EQ(of.result().shortest.path.length, one.start_lengths[0]);
}

TEST(Shorten, StartsFromAGivenPathThatMayRunTheOtherWay) {
  Case of("contour");
  of.options.search.finder.frames = 20;
  std::vector<Configuration> nodes = of.greedy().frames;
  const ShortenResult forward = of.result({}, of.fit(nodes));
  EXPECT_NEAR(forward.length_before, of.greedy().length, 0.01 * of.greedy().length);
  EXPECT_LE(forward.shortest.path.length, forward.length_before);
  std::reverse(nodes.begin(), nodes.end());
  expect_same_bits(of.result({}, of.fit(nodes)), forward);
}

TEST(Shorten, ReportsAFirstPathThatDoesNotReachItsGoal) {
  Case of("contour");
  of.options.search.finder.max_steps = 10;
  const ShortenResult result = of.result();
  EXPECT_EQ(result.outcome, Outcome::step_limit);
  EXPECT_TRUE(result.shortest.path.frames.empty());
  EXPECT_FALSE(result.reason.empty());
}

TEST(FitPath, RefusesWhatIsNoPathOfThePair) {
  const auto refused = [](const char* word, auto change) {
    Case of(word);
    of.options.search.finder.frames = 3;
    std::vector<Configuration> nodes = of.greedy().frames;
    of.fit(nodes);
    change(nodes);
    return refusal([&] { of.fit(nodes); });
  };
  using Nodes = std::vector<Configuration>;
  EXPECT_EQ(refused("contour", [](Nodes& n) { n.erase(n.begin() + 1, n.end() - 1); }),
            "here: holds 2 frames: a path has at least 3");
  EXPECT_EQ(refused("contour", [](Nodes& n) { n[2].box.length[0] = 11.0; }), "here, frame 3: its box is not that of the pair");
  EXPECT_EQ(refused("contour", [](Nodes& n) { n[1].species = {0, 0, 0}; }),
            "here, frame 2: its composition or the order of its particles is not that of the pair");
  EXPECT_EQ(refused("avoidance", [](Nodes& n) { n[1].radii[1] = 0.4; }), "here, frame 2: its radii are not those of the pair");
  EXPECT_EQ(refused("avoidance", [](Nodes& n) { n[1].radii.clear(); }), "here, frame 2: its radii are not those of the pair");
  EXPECT_EQ(refused("contour", [](Nodes& n) { n.back().positions[0] += 0.01; }),
            "here: its first and last frame are not the end points of the pair");
  EXPECT_EQ(refused("contour", [](Nodes& n) { n.pop_back(); }),
            "here: its first and last frame are not the end points of the pair");
  const std::string outside = refused("contour", [](Nodes& n) { n[1].positions = {5.4, 5.0, 5.0, 4.6, 5.0, 5.0}; });
  EXPECT_EQ(outside.rfind("here, frame 2: its energy ", 0), 0u) << outside;
  testing::expect_contains(outside, "is above the landscape energy");
  EXPECT_EQ(refused("avoidance", [](Nodes& n) { n[2].positions = {5.4, 5.0, 5.0, 4.6, 5.0, 5.0}; })
                .rfind("here, frame 3: particles 0 and 1 overlap", 0),
            0u);
}

TEST(Shorten, RefusesOptionsOutOfRange) {
  for (const std::uint64_t bad : {0, 10'001}) {
    Case of("contour");
    of.options.starts = bad;
    EXPECT_EQ(refusal([&] { of.result(); }), std::to_string(bad) + " starts are not allowed: from 1 to 10000");
  }
  Case of("contour");
  of.options.search.method = &path_method("away");
  EXPECT_EQ(refusal([&] { of.result(); }).rfind("method away is not for model", 0), 0u);
}

// Ends at once: start 0 fails with the shortest path, the others succeed.
class Ended final : public ShortenWork {
 public:
  explicit Ended(const ShortenSetup& setup) : start_(setup.start), path_(setup.initial) {
    path_.length = start_ == 0 ? 1.0 : 10.0 - start_;
  }
  bool finished() const override { return true; }
  void advance(RunMonitor&) override {}
  void exchange(Archive&) override {}
  ShortenedPath result() override { return {path_, {}, {}, {}}; }
  double length() const override { return path_.length; }
  bool succeeded() const override { return start_ != 0; }

 private:
  std::uint32_t start_;
  PathResult path_;
};

TEST(Shorten, KeepsTheShortestOfTheStartsThatSucceeded) {
  constexpr ShortenMethod ended{
      "ended", "ends", [](const ShortenSetup& setup) -> std::unique_ptr<ShortenWork> { return std::make_unique<Ended>(setup); }};
  Case of("contour");
  of.options.method = &ended;
  of.options.starts = 3;
  const ShortenResult result = of.result();
  EXPECT_EQ(result.start_lengths, (std::vector<double>{1.0, 9.0, 8.0}));
  EXPECT_EQ(result.shortest.path.length, 8.0);
}

TEST(ShortenMethod, HasWordsThatAreReadBack) {
  for (const ShortenMethod& method : shorten_methods()) EXPECT_EQ(&shorten_method(method.word), &method);
  EXPECT_EQ(std::string(default_shorten_method().word), "curve");
  EXPECT_EQ(refusal([] { shorten_method("walk"); }), "unknown method 'walk': allowed: " + shorten_method_words());
}

}  // namespace
}  // namespace lanescape
