#include "path/shortening/soft_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "configuration/pair_model.hpp"
#include "core/byte_archive.hpp"
#include "core/error.hpp"
#include "io/extended_xyz.hpp"
#include "landscape/pair_landscape.hpp"
#include "path/finder.hpp"
#include "path/path_check.hpp"
#include "path/shortening/curve_shortening.hpp"
#include "stepper/adaptive_contour.hpp"
#include "two_sphere_path.hpp"

namespace lanescape {
namespace {

using testing::TwoSpherePath;

constexpr double degree = std::numbers::pi / 180.0;
const Point centre{3.0, -2.0, 11.0};
const TwoSpherePath examples[] = {
    {3.0, 3.0, 170 * degree}, {3.0, 2.0, 150 * degree}, {1.5, 4.0, 179 * degree}, {2.0, 2.0, 125 * degree}};

// A soft system and how its paths are shortened.
struct Shortened {
  PairModel model;
  Box box;
  ParticleLayout layout;
  double landscape_energy;
  CurveOptions options;
  int threads = 1;
  PairSearch search = PairSearch::automatic;

  SoftLandscapeMaker factory() const {
    return [this] {
      return std::make_unique<PairLandscape>(model, box, layout, choose_isa("auto"), PairSearchOptions{.search = search});
    };
  }
  std::unique_ptr<CurveShortening> begin(const VectorAlgebra& algebra) const {
    return std::make_unique<CurveShortening>(
        algebra, std::make_unique<SoftCurve>(factory(), landscape_energy, SoftCurveOptions{.threads = threads}), options);
  }
  PathCheck check(const Polyline& nodes) const { return check_path(factory(), landscape_energy, nodes); }
};

// Two particles that may not come nearer than 1.
Shortened two_particles() {
  const PairModel model = wca();
  return {model, Box{{20.0, 21.0, 22.0}}, ParticleLayout({0, 0}, 1), model.derivatives(model.numbers(0), 1.0).u,
          CurveOptions{.coarse_spacing = 0.1, .length_tolerance = 5e-5}};
}

// A hundred and eight Kob-Andersen particles from the committed pair's start to `part` of its greedy way.
struct Liquid {
  Shortened system;
  Polyline greedy;
};

Liquid liquid_path(double part) {
  const PairModel model = kob_andersen();
  const auto frames = read_frames(std::string(LANESCAPE_TEST_DATA_DIR) + "/ka108-T1-pair.extxyz", model);
  const ParticleLayout layout = ParticleLayout::in_space_order(frames[0].configuration, 2);
  Liquid liquid{{model, frames[0].configuration.box, layout, 0.0, CurveOptions{.coarse_spacing = 0.5}}, {}};
  const auto landscape = liquid.system.factory()();
  const AlignedArray start = layout.to_slots(frames[0].configuration.positions);
  const AlignedArray goal = layout.to_slots(frames[1].configuration.positions);
  liquid.system.landscape_energy = std::max(landscape->energy(start), landscape->energy(goal));
  AdaptiveContourStepper stepper(*landscape, liquid.system.landscape_energy, {});
  PathFinder<AdaptiveContourStepper> finder(landscape->algebra(), std::move(stepper), start, goal, 108, {.frames = 1000});
  finder.advance(100'000);
  EXPECT_EQ(finder.outcome(), Outcome::reached);
  liquid.greedy = {start};
  for (std::size_t k = 0; k < static_cast<std::size_t>(part * 1000.0); ++k) liquid.greedy.push_back(finder.recorder().frames()[k]);
  return liquid;
}

void finish(CurveShortening& curve) {
  while (!curve.finished()) curve.advance();
  EXPECT_EQ(curve.reason(), "");
}

Polyline greedy_path(const Shortened& system, const TwoSpherePath& example, std::size_t nodes) {
  return testing::two_particle_path(system.layout, nodes, centre, [&](double t) { return example.greedy(t); });
}

TEST(SoftCurve, FindsTheGeodesicOfTwoParticlesFromTheGreedyPath) {
  const Shortened system = two_particles();
  const auto landscape = system.factory()();
  for (const TwoSpherePath& example : examples) {
    const auto curve = system.begin(landscape->algebra());
    curve->begin(greedy_path(system, example, 301));
    finish(*curve);
    const PathCheck check = system.check(curve->nodes());
    EXPECT_NEAR(check.length, example.length() / std::sqrt(2.0), 1e-4 * check.length);
    EXPECT_LE(check.largest_violation, 1e-3);
    EXPECT_LE(check.kuhn_tucker_residual, 1e-2);
    EXPECT_LE(curve->length_change(), 1e-3);
    EXPECT_NEAR(check.length, curve->length(), 1e-12);
  }
}

TEST(SoftCurve, StraightensAPathWhereTheStraightLineIsAllowed) {
  const Shortened system = two_particles();
  const auto landscape = system.factory()();
  const auto curve = system.begin(landscape->algebra());
  const Polyline bent = testing::two_particle_path(system.layout, 50, centre, [](double t) {
    return Point{2.0 + t, 0.5 * std::sin(std::numbers::pi * t), 0.3 * std::sin(2.0 * std::numbers::pi * t)};
  });
  curve->begin(bent);
  finish(*curve);
  EXPECT_NEAR(curve->length(), landscape->algebra().distance(bent.front(), bent.back()), 1e-9);
  EXPECT_EQ(system.check(curve->nodes()).kuhn_tucker_residual, 0.0);
}

TEST(SoftCurve, ShortensALiquidsPathToAStationaryOneThatStaysInTheRegion) {
  const Liquid liquid = liquid_path(0.25);
  const auto landscape = liquid.system.factory()();
  const double before = polyline_length(landscape->algebra(), liquid.greedy);
  const auto curve = liquid.system.begin(landscape->algebra());
  curve->begin(liquid.greedy);
  finish(*curve);
  const PathCheck check = liquid.system.check(curve->nodes());
  EXPECT_LT(check.length, 0.8 * before);
  EXPECT_GE(check.length, landscape->algebra().distance(liquid.greedy.front(), liquid.greedy.back()));
  EXPECT_LE(check.kuhn_tucker_residual, 1e-2);
  EXPECT_LE(check.largest_violation, 1e-3);
  EXPECT_EQ(curve->nodes().front(), liquid.greedy.front());
  EXPECT_EQ(curve->nodes().back(), liquid.greedy.back());
}

TEST(SoftCurve, HasTheSameBitsOnAnyNumberOfThreads) {
  Liquid liquid = liquid_path(0.05);
  const auto landscape = liquid.system.factory()();
  for (const PairSearch search : {PairSearch::all_pairs, PairSearch::list}) {
    liquid.system.search = search;
    std::vector<Polyline> found;
    for (const int threads : {1, 2, 3, 4}) {
      liquid.system.threads = threads;
      const auto curve = liquid.system.begin(landscape->algebra());
      curve->begin(liquid.greedy);
      for (int iteration = 0; iteration < 60; ++iteration) curve->advance();
      found.push_back(curve->nodes());
      EXPECT_EQ(found.back(), found.front()) << threads;
    }
  }
}

TEST(SoftCurve, ContinuesFromAnArchiveWithTheSameBitsAtAnyIteration) {
  const Liquid liquid = liquid_path(0.05);
  const auto landscape = liquid.system.factory()();
  const auto whole = liquid.system.begin(landscape->algebra());
  whole->begin(liquid.greedy);
  finish(*whole);
  auto part = liquid.system.begin(landscape->algebra());
  part->begin(liquid.greedy);
  while (!part->finished()) {
    part->advance();
    ByteWriter writer;
    part->exchange(writer);
    part = liquid.system.begin(landscape->algebra());
    const std::string state = writer.bytes();
    ByteReader reader(state);
    part->exchange(reader);
  }
  EXPECT_EQ(part->nodes(), whole->nodes());
  EXPECT_EQ(part->iterations(), whole->iterations());
  EXPECT_EQ(part->evaluations(), whole->evaluations());
}

TEST(SoftCurve, SaysWhenItsIterationsEnd) {
  Shortened system = two_particles();
  system.options.most_iterations = 3;
  const auto landscape = system.factory()();
  const auto curve = system.begin(landscape->algebra());
  curve->begin(greedy_path(system, examples[0], 301));
  while (!curve->finished()) curve->advance();
  EXPECT_EQ(curve->reason().rfind("3 iterations were allowed: the residual is ", 0), 0u) << curve->reason();
}

TEST(SoftCurve, RefusesAPathThatPassesThroughAParticle) {
  const Shortened system = two_particles();
  const auto landscape = system.factory()();
  const auto curve = system.begin(landscape->algebra());
  curve->begin(testing::two_particle_path(system.layout, 3, centre, [](double t) { return Point{3.0 - 6.0 * t, 0.0, 0.0}; }));
  EXPECT_THROW(while (!curve->finished()) curve->advance(), Error);
}

}  // namespace
}  // namespace lanescape
