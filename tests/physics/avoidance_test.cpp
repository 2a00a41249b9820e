#include "stepper/avoidance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "configuration/hard_sphere_model.hpp"
#include "core/run_monitor.hpp"
#include "dynamics/event_driven.hpp"
#include "dynamics/hard_sphere_start.hpp"
#include "landscape/hard_sphere_landscape.hpp"
#include "path/finder.hpp"
#include "reference/hard_geodesic.hpp"
#include "reference/hard_sphere.hpp"

namespace lanescape {
namespace {

struct Ends {
  Box box;
  std::vector<int> species;
  std::vector<double> radii, start, finish;
};

// Two ends of one trajectory, `collisions` apart.
Ends liquid_ends(std::size_t particles, double packing_fraction, int collisions) {
  SilentMonitor monitor;
  const Isa isa = available_isas().front();
  const auto start =
      *make_hard_sphere_start(hard_sphere_binary(), particles, packing_fraction, StartMethod::growth, 1, isa, monitor);
  EventDriven dynamics(start, std::vector<double>(particles, 1.0), kernel_table(isa));
  dynamics.draw_velocities(1);
  Ends ends{start.box, start.species, start.radii, {}, {}};
  const auto between_events = [&] { return 0.5 * (dynamics.time() + dynamics.next_event_time()); };
  for (int k = 0; k < 5000; ++k) dynamics.collide();
  dynamics.positions(between_events(), ends.start);
  for (int k = 0; k < collisions; ++k) dynamics.collide();
  dynamics.positions(between_events(), ends.finish);
  return ends;
}

Ends two_spheres(double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  // In the centre-of-mass frame: relative coordinates of length 3 at both ends.
  const auto half = [](double x, double y) {
    return std::vector<double>{-0.5 * x + 10, -0.5 * y + 10, 10, 0.5 * x + 10, 0.5 * y + 10, 10};
  };
  return {{{20.0, 20.0, 20.0}}, {0, 0}, {0.5, 0.5}, half(3.0, 0.0), half(3.0 * std::cos(angle), 3.0 * std::sin(angle))};
}

struct Search {
  ParticleLayout layout;
  HardSphereLandscape landscape;
  PathFinder<AvoidanceStepper> finder;

  Search(const Ends& ends, Isa isa, const AvoidanceStepper::Options& options = {}, const FinderOptions& limits = {})
      : layout(ends.species, 2),
        landscape(ends.box, layout, ends.radii, isa),
        finder(landscape.algebra(), AvoidanceStepper(landscape, options), layout.to_slots(ends.start), layout.to_slots(ends.finish),
               ends.species.size(), limits) {}
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::fabs(a[k] - b[k]));
  return largest;
}

TEST(Avoidance, StepsAreThoseOfTheReferenceOnEveryInstructionSet) {
  const Ends ends = liquid_ends(32, 0.45, 400);
  reference::AvoidanceOptions options;
  options.record = 600;
  options.max_steps = 600;
  const auto expected = reference::find_avoidance_geodesic(ends.start, ends.finish, ends.radii, ends.box.length, options);
  ASSERT_GE(expected.accepted.size(), 500U);
  for (const Isa isa : available_isas()) {
    Search search(ends, isa);
    // Steps amplify rounding: fewer digits agree in later steps.
    for (std::size_t k = 0; k < 500; ++k) {
      search.finder.advance(1);
      ASSERT_LT(largest_difference(search.layout.to_user(search.finder.position()), expected.accepted[k].positions), 1e-9)
          << to_string(isa) << " step " << k;
    }
  }
}

TEST(Avoidance, CountsOfAWholePathAreThoseOfTheReference) {
  const Ends ends = liquid_ends(32, 0.30, 60);
  const auto expected = reference::find_avoidance_geodesic(ends.start, ends.finish, ends.radii, ends.box.length, {});
  Search search(ends, available_isas().back());
  search.finder.advance(10'000'000);
  ASSERT_EQ(search.finder.outcome(), Outcome::reached) << search.finder.reason();
  // Sooner or later rounding decides a trial; this hardly changes lengths.
  EXPECT_NEAR(search.finder.statistics().length(), expected.length, 0.02 * expected.length);
  EXPECT_NEAR(static_cast<double>(search.finder.direct_steps()), static_cast<double>(expected.direct_steps),
              0.03 * static_cast<double>(expected.direct_steps));
  EXPECT_NEAR(static_cast<double>(search.finder.detour_steps()), static_cast<double>(expected.avoidance_steps),
              0.05 * static_cast<double>(expected.avoidance_steps));
}

TEST(Avoidance, NoConfigurationOfAPathOverlaps) {
  const Ends ends = liquid_ends(32, 0.50, 300);
  Search search(ends, available_isas().back());
  while (search.finder.outcome() == Outcome::running) {
    search.finder.advance(37);
    const auto positions = search.layout.to_user(search.finder.position());
    ASSERT_FALSE(reference::any_overlap(positions, ends.radii, ends.box.length)) << "after step " << search.finder.steps();
  }
  EXPECT_EQ(search.finder.outcome(), Outcome::reached);
}

// Every moved particle moves by exactly delta_ca, so n is the number of moved particles.
TEST(Avoidance, ParticipationOfAnAvoidanceStepIsTheNumberOfParticlesMoved) {
  const Ends ends = liquid_ends(32, 0.45, 200);
  Search search(ends, available_isas().back());
  int avoidance = 0;
  while (avoidance < 200) {
    const auto before = search.finder.detour_steps();
    search.finder.advance(1);
    if (search.finder.detour_steps() == before) continue;
    ++avoidance;
    ASSERT_NEAR(search.finder.statistics().last_participation_number(), search.finder.stepper().monitored(), 1e-6);
  }
}

// Two spheres, a = b = 3, s = 1, 170 degrees: no path is shorter than 6.1620 / sqrt 2. Avoidance takes back direct steps, so this
// path costs (1 + cos a) / sin a per arc, 9.0229 / sqrt 2 for small steps (the integral along the contact sphere).
TEST(Avoidance, TwoSpheresTakeTheZigzagRoundEachOtherAndNoShorterWayThanTheGeodesic) {
  for (const double step : {1e-1, 1e-2}) {
    AvoidanceStepper::Options options;
    options.direct_step = step;
    Search search(two_spheres(170.0), available_isas().back(), options);
    search.finder.advance(10'000'000);
    ASSERT_EQ(search.finder.outcome(), Outcome::reached);
    const double length = search.finder.statistics().length() * std::numbers::sqrt2;
    EXPECT_GT(length, 6.1620);
    EXPECT_LT(length, 9.0229);
    if (step < 0.05) {
      EXPECT_NEAR(length, 9.0229, 0.03);
    }
  }
}

TEST(Avoidance, HeadOnSpheresStallWithAReason) {
  Ends ends = two_spheres(180.0);
  for (double* x : {&ends.finish[1], &ends.finish[4]}) *x = 10.0;  // exactly on the axis
  FinderOptions limits;
  limits.patience = 5000;
  Search search(ends, available_isas().back(), {}, limits);
  search.finder.advance(1'000'000);
  EXPECT_EQ(search.finder.outcome(), Outcome::stalled);
  EXPECT_FALSE(search.finder.reason().empty());
}

}  // namespace
}  // namespace lanescape
