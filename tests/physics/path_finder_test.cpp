#include "path/finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "configuration/lattice.hpp"
#include "landscape/kinematic_landscape.hpp"
#include "reference/geodesic.hpp"
#include "reference/lennard_jones.hpp"
#include "run/path_run.hpp"
#include "stepper/contour.hpp"
#include "stepper/escape.hpp"
#include "systems.hpp"
#include "two_spheres.hpp"

namespace lanescape {
namespace {

using testing::System;
using testing::two_spheres;
using testing::TwoSpheres;
using Point = std::vector<double>;  // interleaved, as in the reference

template <class Stepper>
PathFinder<Stepper> finder_on_two_spheres(TwoSpheres& landscape, double degrees, double step) {
  typename Stepper::Options stepping;
  stepping.direct_step = step;
  return {landscape.algebra(),
          Stepper(landscape, -1.0, stepping),
          landscape.layout().to_slots(two_spheres(3.0, 0.0)),
          landscape.layout().to_slots(two_spheres(3.0, degrees)),
          landscape.particles(),
          FinderOptions{}};
}

reference::Geodesic reference_on_two_spheres(reference::Method method, double degrees, double step) {
  const auto energy = [](const Point& r) { return -std::hypot(r[0] - r[3], r[1] - r[4], r[2] - r[5]); };
  const auto gradient = [&](const Point& r, Point& g) {
    const double length = -energy(r);
    for (std::size_t axis = 0; axis < 3; ++axis) g[axis] = -(r[axis] - r[axis + 3]) / length, g[axis + 3] = -g[axis];
  };
  reference::GeodesicOptions options;
  options.step = step;
  options.landscape_energy = -1.0;
  return reference::find_geodesic(two_spheres(3.0, 0.0), two_spheres(3.0, degrees), energy, gradient, method, options);
}

template <class Stepper>
constexpr reference::Method method_of =
    std::is_same_v<Stepper, ContourStepper> ? reference::Method::contour : reference::Method::escape;

template <class Stepper>
class PathFinderWith : public ::testing::Test {};
using Steppers = ::testing::Types<ContourStepper, EscapeStepper>;
template <class Stepper>
constexpr bool is_contour = std::is_same_v<Stepper, ContourStepper>;
struct StepperName {
  template <class Stepper>
  static std::string GetName(int) {
    return is_contour<Stepper> ? "contour" : "escape";
  }
};
TYPED_TEST_SUITE(PathFinderWith, Steppers, StepperName);

TYPED_TEST(PathFinderWith, SlidesAroundASphereByTheGreedyLength) {
  TwoSpheres landscape;
  auto finder = finder_on_two_spheres<TypeParam>(landscape, 170.0, 1e-3);
  finder.advance(100'000);
  ASSERT_EQ(finder.outcome(), Outcome::reached) << finder.reason();
  EXPECT_NEAR(finder.statistics().length(), 6.4106 / std::numbers::sqrt2, 2e-3);
  EXPECT_NEAR(finder.statistics().participation_number(), 2.0, 1e-9);  // both move by opposite vectors
  EXPECT_GT(finder.detour_steps(), 1000u);
  EXPECT_EQ(finder.distance_left(), 0.0);
  EXPECT_LE(finder.largest_violation(), is_contour<TypeParam> ? 0.0 : 1e-4 * (1.0 + 1e-9));
}

TYPED_TEST(PathFinderWith, TakesTheStepsOfTheReferenceAroundASphere) {
  for (const double degrees : {30.0, 120.0, 170.0}) {
    TwoSpheres landscape;
    auto finder = finder_on_two_spheres<TypeParam>(landscape, degrees, 2e-3);
    finder.advance(100'000);
    const auto expected = reference_on_two_spheres(method_of<TypeParam>, degrees, 2e-3);
    ASSERT_EQ(finder.outcome(), Outcome::reached);
    ASSERT_EQ(expected.outcome, reference::Outcome::reached);
    EXPECT_EQ(finder.direct_steps(), static_cast<std::uint64_t>(expected.direct_steps));
    EXPECT_EQ(finder.detour_steps(), static_cast<std::uint64_t>(expected.contour_steps + expected.escape_steps));
    EXPECT_NEAR(finder.statistics().length() / expected.length, 1.0, 1e-9);
    EXPECT_NEAR(finder.statistics().participation_number() / expected.participation, 1.0, 1e-9);
  }
}

// Two nearby end points in a small, dense box, where particles interact with several images of each other.
struct Cluster {
  System system;
  AlignedArray start, finish;
  explicit Cluster(std::size_t particles) : system(kob_andersen(), fcc_start(kob_andersen(), particles, 1.2, 3)) {
    VelocityVerlet verlet = system.moving(3.0, 1e-3, particles);
    for (int k = 0; k < 1000; ++k) verlet.step();
    start = testing::lowest_on_the_way(verlet, 300);
    finish = testing::lowest_on_the_way(verlet, 300);
  }
};

TYPED_TEST(PathFinderWith, TakesTheStepsOfTheReferenceInALennardJonesLiquid) {
  const reference::Mixture mixture{2, {1.0, 1.5, 1.5, 0.5}, {1.0, 0.8, 0.8, 0.88}, {2.5, 2.0, 2.0, 2.2}};
  for (const std::size_t particles : {8u, 13u, 20u}) {
    SCOPED_TRACE(particles);
    Cluster cluster(particles);
    System& system = cluster.system;
    const auto evaluate = [&](const Point& r) {
      return reference::lennard_jones(r, system.configuration.species, system.configuration.box.length, mixture,
                                      reference::ImageRule::all, reference::Truncation::shifted);
    };
    reference::GeodesicOptions options;
    options.step = 5e-3;
    const auto expected = reference::find_geodesic(
        system.layout.to_user(cluster.start), system.layout.to_user(cluster.finish),
        [&](const Point& r) { return evaluate(r).energy; }, [&](const Point& r, Point& g) { g = evaluate(r).gradient; },
        method_of<TypeParam>, options);

    const double limit = std::max(system.landscape.energy(cluster.start), system.landscape.energy(cluster.finish));
    typename TypeParam::Options stepping;
    stepping.direct_step = 5e-3;
    PathFinder<TypeParam> finder(system.landscape.algebra(), TypeParam(system.landscape, limit, stepping), cluster.start,
                                 cluster.finish, system.landscape.particles(), {});
    finder.advance(100'000);

    EXPECT_NEAR(limit, expected.landscape_energy, 1e-10 * std::fabs(limit));
    ASSERT_EQ(finder.outcome(), Outcome::reached) << finder.reason();
    ASSERT_EQ(expected.outcome, reference::Outcome::reached) << expected.reason;
    EXPECT_GT(finder.detour_steps(), 20u);
    EXPECT_EQ(finder.direct_steps(), static_cast<std::uint64_t>(expected.direct_steps));
    EXPECT_EQ(finder.detour_steps(), static_cast<std::uint64_t>(expected.contour_steps + expected.escape_steps));
    EXPECT_NEAR(finder.statistics().length() / expected.length, 1.0, 1e-9);
    EXPECT_NEAR(finder.statistics().participation_number() / expected.participation, 1.0, 1e-9);
  }
}

// Two configurations of one trajectory with the model's own masses, so that the centre of mass is at rest.
ConfigurationPair pair_of(const PairModel& model) {
  System system(model, testing::molten_kob_andersen());
  VelocityVerlet verlet = system.moving(2.0);
  for (int k = 0; k < 1000; ++k) verlet.step();
  ConfigurationPair pair{system.configuration, system.configuration, 0.0, 0};
  pair.start.positions = system.layout.to_user(testing::lowest_on_the_way(verlet, 1000));
  pair.finish.positions = system.layout.to_user(testing::lowest_on_the_way(verlet, 1000));
  return pair;
}

PathResult contour_path(const PairModel& model, const ConfigurationPair& pair, std::size_t frames = 500) {
  PathRunOptions options;
  options.finder.frames = frames;
  SilentMonitor monitor;
  return run_paths(model, {pair}, options, testing::active_isa(), {}, monitor).front();
}

double mass_of(const PairModel& model, const Configuration& c, std::size_t particle) {
  return model.species[static_cast<std::size_t>(c.species[particle])].mass;
}

// sqrt(sum m dr^2 / <m>)
double kinematic_distance(const PairModel& model, const Configuration& a, const Configuration& b) {
  double sum = 0.0, mass = 0.0;
  for (std::size_t k = 0; k < a.positions.size(); ++k) {
    const double d = b.positions[k] - a.positions[k];
    sum += mass_of(model, a, k / 3) * d * d;
    mass += mass_of(model, a, k / 3) / 3.0;
  }
  return std::sqrt(sum * static_cast<double>(a.size()) / mass);
}

// The largest distance of the centre of mass from its start, with the masses of `model`.
double drift(const PairModel& model, const std::vector<Configuration>& frames) {
  double farthest = 0.0;
  for (const Configuration& frame : frames) {
    std::array<double, 3> moved{};
    for (std::size_t k = 0; k < frame.positions.size(); ++k)
      moved[k % 3] += mass_of(model, frame, k / 3) * (frame.positions[k] - frames.front().positions[k]);
    for (const double x : moved) farthest = std::max(farthest, std::fabs(x));
  }
  return farthest;
}

TEST(KinematicMetric, LengthsAreWeightedWithTheMasses) {
  const auto model = testing::with_masses(kob_andersen(), 1.0, 3.0);
  const auto pair = pair_of(model);
  const PathResult path = contour_path(model, pair);
  ASSERT_EQ(path.outcome, Outcome::reached) << path.reason;
  EXPECT_GT(path.detour_steps, 100u);
  EXPECT_NEAR(path.distance, kinematic_distance(model, pair.start, pair.finish), 1e-10);
  double polygon = 0.0;
  for (std::size_t k = 1; k < path.frames.size(); ++k) polygon += kinematic_distance(model, path.frames[k - 1], path.frames[k]);
  EXPECT_LE(polygon, path.length * (1.0 + 1e-12));
  EXPECT_GT(polygon, 0.99 * path.length);
}

TEST(KinematicMetric, TheCentreOfMassDoesNotDriftAlongAPath) {
  const auto model = testing::with_masses(kob_andersen(), 1.0, 3.0);
  const auto pair = pair_of(model);
  EXPECT_LT(drift(model, contour_path(model, pair).frames), 1e-8);
  // Without the metric it would drift: the forces balance, but not the displacements that they cause.
  EXPECT_GT(drift(model, contour_path(kob_andersen(), pair).frames), 1e-3);
}

TEST(KinematicMetric, ACommonFactorOfAllMassesChangesNothing) {
  const auto equal = [&](const PairModel& a, const PairModel& b) {
    const auto pair = pair_of(a);
    const PathResult one = contour_path(a, pair), other = contour_path(b, pair);
    EXPECT_EQ(one.outcome, Outcome::reached);
    EXPECT_EQ(one.length, other.length);
    EXPECT_EQ(one.distance, other.distance);
    EXPECT_EQ(one.detour_steps, other.detour_steps);
    EXPECT_EQ(one.frames.at(200).positions, other.frames.at(200).positions);
  };
  equal(testing::with_masses(kob_andersen(), 1.0, 1.0), testing::with_masses(kob_andersen(), 7.3, 7.3));
  equal(testing::with_masses(kob_andersen(), 1.0, 3.0), testing::with_masses(kob_andersen(), 4.0, 12.0));
}

TEST(KinematicMetric, UnequalMassesChangeThePath) {
  const auto model = testing::with_masses(kob_andersen(), 1.0, 3.0);
  const auto pair = pair_of(model);
  EXPECT_GT(std::fabs(contour_path(model, pair).length / contour_path(kob_andersen(), pair).length - 1.0), 1e-3);
}

}  // namespace
}  // namespace lanescape
