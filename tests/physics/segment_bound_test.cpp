#include "core/segment_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "configuration/lattice.hpp"
#include "memory_archive.hpp"
#include "path/finder.hpp"
#include "stepper/contour.hpp"
#include "systems.hpp"

namespace lanescape {
namespace {

using testing::System;

// How often and by how much segments fall short of their tangent.
struct Seen {
  int segments = 0, below_curvature = 0;
  double least_margin = std::numeric_limits<double>::infinity();
};

class Segments {
 public:
  Segments(System& system, double longest, std::uint64_t seed)
      : system_(system), bound_(system.landscape.segment_bound(longest)), longest_(longest), random_(seed) {}

  // `count` segments from points within reach of a centre.
  Seen check(const AlignedArray& centre, int count) {
    Seen seen;
    const SegmentLoss loss = bound_->around(centre);
    EXPECT_TRUE(std::isfinite(loss.curvature) && std::isfinite(loss.slope) && std::isfinite(loss.rounding));
    for (int k = 0; k < count; ++k)
      check_one(away_from(centre), k % 4 == 0 ? towards_a_particle(centre) : direction(k % 4), loss, seen);
    return seen;
  }

 private:
  double normal() { return std::normal_distribution<double>()(random_); }
  std::size_t particle() { return system_.layout.slot_of(random_() % system_.layout.size()); }
  AlignedArray nothing() const { return AlignedArray(system_.layout.dimension(), 0.0); }

  void add(AlignedArray& to, std::size_t slot, double scale) {
    for (std::size_t axis = 0; axis < 3; ++axis) to[axis * system_.layout.slots() + slot] += scale * normal();
  }
  void normalize(AlignedArray& u) const {
    const double length = system_.landscape.algebra().norm(u);
    for (double& x : u) x /= length;
  }
  // All particles, one, or two.
  AlignedArray direction(int kind) {
    AlignedArray u = nothing();
    if (kind == 1)
      for (std::size_t p = 0; p < system_.layout.size(); ++p) add(u, system_.layout.slot_of(p), 1.0);
    else
      for (int k = 1; k < kind; ++k) add(u, particle(), 1.0);
    normalize(u);
    return u;
  }
  // Two particles straight at each other, or apart.
  AlignedArray towards_a_particle(const AlignedArray& r) {
    AlignedArray u = nothing();
    const std::size_t i = particle(), slots = system_.layout.slots();
    std::size_t j = particle();
    while (j == i) j = particle();
    const double sign = random_() % 2 == 0 ? 1.0 : -1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = system_.configuration.box.nearest_image(axis, r[axis * slots + j] - r[axis * slots + i]);
      u[axis * slots + i] = sign * d;
      u[axis * slots + j] = -sign * d;
    }
    normalize(u);
    return u;
  }
  // Each particle by up to half of what two may move apart in all.
  AlignedArray away_from(const AlignedArray& centre) {
    const double most = 0.5 * (bound_->reach() - 1.4143 * longest_) / std::sqrt(3.0);
    AlignedArray r = centre;
    std::uniform_real_distribution<double> shift(-most, most);
    for (std::size_t p = 0; p < system_.layout.size(); ++p)
      for (std::size_t axis = 0; axis < 3; ++axis) r[axis * system_.layout.slots() + system_.layout.slot_of(p)] += shift(random_);
    return r;
  }

  void check_one(const AlignedArray& r, const AlignedArray& u, const SegmentLoss& loss, Seen& seen) {
    const VectorAlgebra& algebra = system_.landscape.algebra();
    AlignedArray gradient = nothing(), at = nothing();
    const double energy = system_.landscape.energy_and_gradient(r, gradient), slope = algebra.dot(gradient, u);
    bool below = false;
    for (int k = 1; k <= 20; ++k) {
      const double s = longest_ * k / 20.0;
      algebra.axpy(at, r, s, u);
      const double smooth = energy + s * slope - 0.5 * s * s * loss.curvature - loss.rounding, v = system_.landscape.energy(at);
      below = below || v < smooth;
      seen.least_margin = std::min(seen.least_margin, v - (smooth - s * loss.slope));
    }
    ++seen.segments;
    seen.below_curvature += below ? 1 : 0;
  }

  System& system_;
  std::unique_ptr<SegmentBound> bound_;
  double longest_;
  std::mt19937_64 random_;
};

PairModel with(PairModel model, Truncation truncation, ImageRule images) {
  model.truncation = truncation;
  model.images = images;
  return model;
}

constexpr Truncation bounded[] = {Truncation::shifted, Truncation::shifted_force, Truncation::smooth};
constexpr ImageRule both_rules[] = {ImageRule::all, ImageRule::minimum};

TEST(SegmentBound, HoldsInLiquidsForEveryTruncationThatIsContinuousAndBothImageRules) {
  int segments = 0;
  for (const Truncation truncation : bounded)
    for (const ImageRule images : both_rules)
      for (const double temperature : {1.0, 5.0}) {
        System system(with(kob_andersen(), truncation, images), testing::molten_kob_andersen());
        VelocityVerlet verlet = system.moving(temperature);
        for (int k = 0; k < 5; ++k) {
          for (int step = 0; step < 100; ++step) verlet.step();
          for (const double longest : {1e-3, 0.02}) {
            const Seen seen = Segments(system, longest, 7 * k + 1).check(verlet.position(), 80);
            EXPECT_GE(seen.least_margin, 0.0)
                << to_string(truncation) << ' ' << to_string(images) << ' ' << temperature << ' ' << longest;
            segments += seen.segments;
          }
        }
      }
  EXPECT_EQ(segments, 9600);
}

// Three particles with every image change and cutoff within a short way: nothing but the jumps of the slope is left of the loss.
TEST(SegmentBound, CountsTheJumpsOfTheSlopeAtCutoffsAndImageChanges) {
  for (const ImageRule images : both_rules) {
    Configuration sparse;
    sparse.box = {{4.4, 4.6, 4.8}};
    sparse.species = {0, 0, 0};
    int below = 0;
    for (int k = 0; k < 200; ++k) {
      // The pair 0-1 is near the change of its image (minimum) or near the cutoff (all).
      const double d = images == ImageRule::minimum ? 2.2 : 2.5;
      sparse.positions = {0.0, 0.0, 0.0, d + 1e-4 * (k - 100), 0.01, 0.02, 1.1, 1.5, -1.3};
      System system(with(lennard_jones(), Truncation::shifted, images), sparse);
      Segments segments(system, 1e-3, 11 + k);
      const Seen seen = segments.check(system.start(), 40);
      EXPECT_GE(seen.least_margin, 0.0) << to_string(images) << ' ' << k;
      below += seen.below_curvature;
    }
    // Without them the bound is wrong.
    EXPECT_GT(below, 0) << to_string(images);
  }
}

// The pair changes its image along three axes within a short way, at different separations.
TEST(SegmentBound, CountsChangesOfTheImageAlongSeveralAxesAtOnce) {
  int below = 0;
  for (int k = 0; k < 200; ++k) {
    Configuration corner;
    corner.box = {{2.2, 2.25, 2.3}};
    corner.species = {0, 0};
    const double shift = 1e-4 * (k - 100);
    corner.positions = {0.0, 0.0, 0.0, 1.1 + shift, 1.125 - 0.5 * shift, 1.15 + 0.3 * shift};
    System system(with(lennard_jones(), Truncation::shifted, ImageRule::minimum), corner);
    Segments segments(system, 0.02, 5 + k);
    const Seen seen = segments.check(system.start(), 40);
    EXPECT_GE(seen.least_margin, 0.0) << k;
    below += seen.below_curvature;
  }
  EXPECT_GT(below, 0);
}

TEST(SegmentBound, HoldsNearContactInTinyBoxesAndAtTheMinimumOfAPurelyRepulsiveForm) {
  const auto frame = [](const char* name, const PairModel& model) {
    return read_frames(std::string(LANESCAPE_TEST_DATA_DIR) + "/" + name, model).front().configuration;
  };
  const PairModel argon = lennard_jones();
  for (const char* name : {"ar_tiny_4.extxyz", "ar_tiny_7.extxyz", "ar_melted_107.extxyz", "ar_unwrapped_61.extxyz"})
    for (const PairModel& model : {argon, wca()})
      for (const ImageRule images : both_rules) {
        System system(with(model, Truncation::shifted, images), frame(name, argon));
        EXPECT_GE(Segments(system, 1e-3, 3).check(system.start(), 200).least_margin, 0.0) << name << ' ' << model.name;
      }
}

TEST(SegmentBound, DoesNotExistWhereThePotentialJumpsAtItsCutoffOrIsNoLennardJones) {
  const Configuration liquid = testing::molten_kob_andersen();
  for (const Truncation truncation : {Truncation::plain, Truncation::tail}) {
    System system(with(kob_andersen(), truncation, ImageRule::all), liquid);
    EXPECT_EQ(system.landscape.segment_bound(1e-3), nullptr);
  }
  PairModel mie = kob_andersen();
  mie.form = &pair_form("mie");
  mie.form_numbers = {12.0, 6.0};
  System system(mie, liquid);
  EXPECT_EQ(system.landscape.segment_bound(1e-3), nullptr);
}

TEST(SegmentBound, DoesNotExistWhereItCostsMoreThanItSaves) {
  System liquid(kob_andersen(), testing::molten_kob_andersen());
  EXPECT_NE(liquid.landscape.segment_bound(0.02), nullptr);
  EXPECT_EQ(liquid.landscape.segment_bound(0.021), nullptr);
  System large(lennard_jones(), fcc_start(lennard_jones(), 16'384, 0.9, 1));
  EXPECT_EQ(large.landscape.segment_bound(1e-3), nullptr);
}

TEST(SegmentBound, IsInfiniteWhereParticlesOverlap) {
  Configuration pair;
  pair.box = {{10.0, 10.0, 10.0}};
  pair.species = {0, 0};
  pair.positions = {0.0, 0.0, 0.0, 0.3, 0.0, 0.0};
  System system(lennard_jones(), pair);
  EXPECT_EQ(system.landscape.segment_bound(1e-3)->around(system.start()).curvature, std::numeric_limits<double>::infinity());
}

// The same landscape without its bound.
class Unbounded final : public SoftLandscape {
 public:
  explicit Unbounded(PairLandscape& landscape) : landscape_(&landscape) {}
  std::size_t dimension() const override { return landscape_->dimension(); }
  std::size_t particles() const override { return landscape_->particles(); }
  const VectorAlgebra& algebra() const override { return landscape_->algebra(); }
  double energy(const AlignedArray& r) override { return landscape_->energy(r); }
  double energy_and_gradient(const AlignedArray& r, AlignedArray& g) override { return landscape_->energy_and_gradient(r, g); }
  void exchange(Archive& archive) override { landscape_->exchange(archive); }

 private:
  PairLandscape* landscape_;
};

struct Ends {
  AlignedArray start, goal;
  double energy;
};

Ends ends_of(System& system, double temperature) {
  VelocityVerlet verlet = system.moving(temperature);
  for (int k = 0; k < 2000; ++k) verlet.step();
  Ends ends{testing::lowest_on_the_way(verlet, 500), {}, 0.0};
  for (int k = 0; k < 1000; ++k) verlet.step();
  ends.goal = testing::lowest_on_the_way(verlet, 500);
  ends.energy = std::max(system.landscape.energy(ends.start), system.landscape.energy(ends.goal));
  return ends;
}

PathFinder<ContourStepper> finder_on(SoftLandscape& landscape, const Ends& ends, double step) {
  return {landscape.algebra(),
          ContourStepper(landscape, ends.energy, {.direct_step = step}),
          ends.start,
          ends.goal,
          landscape.particles(),
          FinderOptions{.frames = 20}};
}

void expect_the_same_path(const System& system, const Ends& ends, double step, const PairSearchOptions& search = {}) {
  PairLandscape first(system.model, system.configuration.box, system.layout, testing::active_isa(), search);
  PairLandscape second(system.model, system.configuration.box, system.layout, testing::active_isa(), search);
  Unbounded unbounded(second);
  auto with_bound = finder_on(first, ends, step), without = finder_on(unbounded, ends, step);
  with_bound.advance(20'000);
  without.advance(20'000);
  ASSERT_GT(without.detour_steps(), 1000u) << without.reason();
  EXPECT_EQ(with_bound.position(), without.position());
  EXPECT_EQ(with_bound.direct_steps(), without.direct_steps());
  EXPECT_EQ(with_bound.detour_steps(), without.detour_steps());
  EXPECT_EQ(with_bound.statistics().length(), without.statistics().length());
  EXPECT_EQ(with_bound.largest_violation(), without.largest_violation());
  EXPECT_EQ(with_bound.recorder().frames(), without.recorder().frames());
  EXPECT_EQ(with_bound.stepper().corrections(), without.stepper().corrections());
  // Most forbidden trials are not evaluated.
  const std::uint64_t saved = without.stepper().evaluations() - with_bound.stepper().evaluations();
  EXPECT_GT(static_cast<double>(saved), 0.7 * static_cast<double>(without.detour_steps()));
}

TEST(ContourPathWithBounds, HasTheSameBitsInFewerEvaluations) {
  const auto frames = read_frames(std::string(LANESCAPE_TEST_DATA_DIR) + "/ka108-T1-pair.extxyz", kob_andersen());
  for (const ImageRule images : both_rules)
    for (const Truncation truncation : bounded) {
      System system(with(kob_andersen(), truncation, images), frames.front().configuration);
      Ends ends{system.start(), system.layout.to_slots(frames.back().configuration.positions), 0.0};
      ends.energy = std::max(system.landscape.energy(ends.start), system.landscape.energy(ends.goal));
      expect_the_same_path(system, ends, 1e-3);
    }
}

TEST(ContourPathWithBounds, HasTheSameBitsInHotterLiquidsOfOneAndTwoSpecies) {
  System mixture(with(kob_andersen(), Truncation::shifted, ImageRule::all), testing::molten_kob_andersen());
  expect_the_same_path(mixture, ends_of(mixture, 5.0), 1e-3);
  System argon(with(lennard_jones(), Truncation::shifted, ImageRule::minimum), fcc_start(lennard_jones(), 108, 0.9, 1));
  expect_the_same_path(argon, ends_of(argon, 3.0), 1e-3);
}

// The list is rebuilt at the same trials, evaluated or not.
TEST(ContourPathWithBounds, HasTheSameBitsOverAListThatIsRebuiltOnTheWay) {
  const PairModel model = with(kob_andersen(), Truncation::shifted, ImageRule::all);
  System system(model, fcc_start(model, 500, 1.2, 1));
  expect_the_same_path(system, ends_of(system, 2.0), 4e-3, {.search = PairSearch::list, .skin = 0.15});
}

TEST(ContourPathWithBounds, EvaluatesTheSameTrialsAfterItIsHandedOn) {
  System system(with(kob_andersen(), Truncation::shifted, ImageRule::all), testing::molten_kob_andersen());
  const Ends ends = ends_of(system, 5.0);
  const auto landscape = [&] {
    return PairLandscape(system.model, system.configuration.box, system.layout, testing::active_isa());
  };
  auto one = landscape();
  auto whole = finder_on(one, ends, 1e-3);
  whole.advance(1'000'000);
  ASSERT_EQ(whole.outcome(), Outcome::reached);
  ASSERT_GT(whole.detour_steps(), 1000u);
  for (const std::uint64_t part : {3, 2}) {
    auto two = landscape(), three = landscape();
    auto begun = finder_on(two, ends, 1e-3), resumed = finder_on(three, ends, 1e-3);
    begun.advance(whole.steps() / part);
    testing::hand_on(begun, resumed);
    resumed.advance(1'000'000);
    EXPECT_EQ(resumed.statistics().length(), whole.statistics().length());
    EXPECT_EQ(resumed.stepper().evaluations(), whole.stepper().evaluations());
  }
}

}  // namespace
}  // namespace lanescape
