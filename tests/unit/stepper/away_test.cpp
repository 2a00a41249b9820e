#include "stepper/away.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "configuration/hard_sphere_model.hpp"
#include "configuration/lattice.hpp"
#include "core/error.hpp"
#include "dynamics/event_driven.hpp"
#include "landscape/hard_sphere_landscape.hpp"
#include "memory_archive.hpp"
#include "reference/hard_geodesic.hpp"

namespace lanescape {
namespace {

using Point = std::vector<double>;  // interleaved, as in the reference

Isa active_isa() { return choose_isa("auto"); }

// Two ends of a path, in the user's order.
struct Case {
  Box box;
  std::vector<int> species;
  std::vector<double> radii;
  Point start, finish;

  reference::Vector edges() const { return box.length; }
};

struct Visit {
  StepKind kind;
  Point position;
  double violation;
};

struct Walked {
  std::string outcome;  // as the finder reports it
  double length = 0.0;
  std::vector<Visit> visits;
};

// Does what the finder does with a stepper.
class Walk {
 public:
  explicit Walk(const Case& problem, const AwayStepper::Options& options = {})
      : layout_(problem.species, 2),
        landscape_(problem.box, layout_, problem.radii, active_isa()),
        goal_(layout_.to_slots(problem.finish)),
        position_(layout_.to_slots(problem.start)),
        to_goal_(position_),
        next_(position_),
        stepper_(problem.box, layout_, problem.radii, landscape_, goal_, options) {}
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;

  Walked go(std::size_t max_steps = 5000) {
    const VectorAlgebra& algebra = landscape_.algebra();
    Walked walked;
    for (;;) {
      algebra.difference(to_goal_, goal_, position_);
      const PathPoint at{position_, to_goal_, algebra.norm(to_goal_)};
      walked.outcome = "reached";
      if (at.distance < stepper_.step_length()) return walked;
      walked.outcome = "step_limit";
      if (walked.visits.size() == max_steps) return walked;
      const auto kind = stepper_.step(at, next_);
      walked.outcome = "stalled";
      if (!kind) return walked;
      walked.length += algebra.distance(position_, next_);
      walked.visits.push_back({*kind, layout_.to_user(next_), stepper_.violation()});
      position_.swap(next_);
    }
  }

  // These arrays include padding.
  const AlignedArray& position() const { return position_; }
  const AlignedArray& goal() const { return goal_; }
  const ParticleLayout& layout() const { return layout_; }
  const AwayStepper& stepper() const { return stepper_; }
  void exchange(Archive& archive) {
    archive.field("position", position_);
    stepper_.exchange(archive, position_);
  }

 private:
  ParticleLayout layout_;
  HardSphereLandscape landscape_;
  AlignedArray goal_, position_, to_goal_, next_;
  AwayStepper stepper_;
};

double distance(const Point& a, const Point& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

double gap(const Case& problem, const Point& position) { return reference::smallest_gap(position, problem.radii, problem.edges()); }

// Spheres of diameter 1 in a large box.
Case few(Point start, Point finish) {
  const std::size_t count = start.size() / 3;
  return {Box{{40.0, 40.0, 40.0}}, std::vector<int>(count, 0), std::vector<double>(count, 0.5), std::move(start),
          std::move(finish)};
}

Case two_that_swap(double degrees) {
  const auto ends = [](double angle) {
    const double x = 1.5 * std::cos(angle), y = 0.9 * std::sin(angle), z = 1.2 * std::sin(angle);
    return Point{x, y, z, -x, -y, -z};
  };
  return few(ends(0.0), ends(degrees * std::numbers::pi / 180.0));
}

// A binary fluid at two times between which it has moved by `separation` in 3N space.
Case fluid(std::size_t particles, double packing_fraction, double separation, std::uint64_t seed) {
  const HardSphereModel model = hard_sphere_binary();
  const Configuration lattice = hard_sphere_start(model, particles, packing_fraction, Arrangement::random, seed);
  EventDriven dynamics(lattice, std::vector<double>(particles, 1.0), kernel_table(active_isa()));
  dynamics.draw_velocities(seed);
  Case made{lattice.box, lattice.species, lattice.radii, {}, {}};
  const auto sample = [&](Point& end, std::size_t collisions) {
    do {
      for (std::size_t k = 0; k < collisions; ++k) dynamics.collide();
      dynamics.positions(0.5 * (dynamics.time() + dynamics.next_event_time()), end);
    } while (gap(made, end) < 0.0);
  };
  sample(made.start, 100 * particles);
  do sample(made.finish, particles);
  while (distance(made.start, made.finish) < separation);
  return made;
}

// Two neighbours in a crystal that exchange positions. There is no room to do so.
Case crystal() {
  const Configuration lattice = hard_sphere_start(hard_sphere(), 108, 0.69, Arrangement::random, 1);
  Case made{lattice.box, lattice.species, lattice.radii, lattice.positions, lattice.positions};
  for (std::size_t axis = 0; axis < 3; ++axis) std::swap(made.finish[axis], made.finish[3 + axis]);
  return made;
}

reference::HardGeodesic reference_path(const Case& problem) {
  reference::AwayOptions options;
  options.record = 100'000;
  return reference::find_away_geodesic(problem.start, problem.finish, problem.radii, problem.edges(), options);
}

void expect_the_steps_of_the_reference(const Case& problem, std::size_t at_least) {
  const reference::HardGeodesic expected = reference_path(problem);
  ASSERT_EQ(expected.outcome, reference::Outcome::reached) << expected.reason;
  Walk walk(problem);
  const Walked walked = walk.go();
  ASSERT_EQ(walked.outcome, "reached") << walk.stepper().failure();
  ASSERT_EQ(walked.visits.size(), expected.accepted.size());
  EXPECT_GE(walked.visits.size(), at_least);
  for (std::size_t k = 0; k < walked.visits.size(); ++k) {
    ASSERT_EQ(walked.visits[k].kind == StepKind::detour, expected.accepted[k].kind == reference::StepKind::away) << k;
    for (std::size_t c = 0; c < problem.start.size(); ++c)
      ASSERT_NEAR(walked.visits[k].position[c], expected.accepted[k].positions[c], 1e-9) << "step " << k;
  }
  EXPECT_NEAR(walked.length, expected.length, 1e-9 * expected.length);
}

TEST(AwayStepper, AFreeWayIsOneDirectStepToExactlyTheGoal) {
  const Case problem = few({0.1, 0.2, 0.3, 5.0, 5.0, 5.0}, {1.3, -2.7, 1e-7 / 3.0, 5.0, 5.0, 6.1});
  Walk walk(problem);
  const Walked walked = walk.go();
  EXPECT_EQ(walked.outcome, "reached");
  ASSERT_EQ(walked.visits.size(), 1u);
  EXPECT_EQ(walked.visits[0].kind, StepKind::direct);
  EXPECT_EQ(walk.position(), walk.goal());
  EXPECT_EQ(walked.visits[0].violation, 0.0);
  EXPECT_EQ(walk.stepper().monitored(), 2.0);
}

TEST(AwayStepper, TwoSpheresTakeTheStepsOfTheReference) {
  expect_the_steps_of_the_reference(two_that_swap(170.0), 5);
  expect_the_steps_of_the_reference(two_that_swap(180.0), 3);  // head on: the fixed perpendicular is used
  expect_the_steps_of_the_reference(few({0.0, 0.6, 0.0, -3.0, 0.0, 0.0}, {0.0, 0.6, 0.0, 3.0, 0.0, 0.0}), 3);
  expect_the_steps_of_the_reference(
      few({0.0, 0.6, 0.0, -3.0, 0.0, 0.0, 0.1, 1.61, 0.0}, {0.0, 0.6, 0.0, 3.0, 0.0, 0.0, 0.1, 1.61, 0.0}), 3);
}

// 0 moves into 1. 1 moves sideways and pushes 2, which is next to it. 0 then advances past both.
TEST(AwayStepper, ASphereInTheWayPushesTheOneBehindItAside) {
  const Case problem = few({-3.0, 0.0, 0.0, 0.0, 0.6, 0.0, 0.0, 1.6, 0.0}, {3.0, 0.0, 0.0, 0.0, 0.6, 0.0, 0.0, 1.6, 0.0});
  Walk walk(problem);
  const Walked walked = walk.go(2);
  ASSERT_EQ(walked.visits.size(), 2u);
  EXPECT_EQ(walked.visits[0].kind, StepKind::direct);
  EXPECT_NEAR(walked.visits[0].position[0], -0.8, 1e-12);  // 0.6, 0.8 and 1 are the sides of a triangle
  const Point& after = walked.visits[1].position;
  EXPECT_EQ(walked.visits[1].kind, StepKind::detour);
  EXPECT_NEAR(after[4], 1.0, 1e-9);  // out of the path of 0
  EXPECT_NEAR(after[7], 2.0, 1e-9);  // out of the path of 1
  EXPECT_NEAR(after[0], 0.0, 1e-9);  // level with 1
  EXPECT_LE(-gap(problem, after), AwayStepper::slack);
  EXPECT_EQ(walk.stepper().monitored(), 3.0);
}

TEST(AwayStepper, MixturesOfEightAndThirtyTwoSpheresTakeTheStepsOfTheReference) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    expect_the_steps_of_the_reference(fluid(8, 0.1, 8.0, seed), 2);
    expect_the_steps_of_the_reference(fluid(32, 0.1, 12.0, seed), 10);
    expect_the_steps_of_the_reference(fluid(32, 0.2, 12.0, seed), 20);
  }
}

TEST(AwayStepper, ASphereBesideAnotherToTheSlackIsNotInItsWay) {
  // The spheres are in contact, and 0 pushes against 1. 1 would pass 0 sideways, but its direction is tilted towards 0 as rounding
  // could cause. 0 is closer to its goal: if both blocked each other, 0 would make way, by the slack.
  for (int k = 1; k <= 30; ++k) {
    const double c = std::cos(0.1 * k), s = std::sin(0.1 * k), out = 1.0 + 1e-15, tilt = 3e-11;
    const Point start{0.0, 0.0, 0.0, out * c, out * s, 0.0};
    const Point finish{0.2 * c, 0.2 * s, 0.6, out * c - 3.0 * s - tilt * c, out * s + 3.0 * c - tilt * s, 0.0};
    expect_the_steps_of_the_reference(few(start, finish), 2);
  }
}

TEST(AwayStepper, AFlightLongerThanTheNearestImageHoldsMeetsEveryImage) {
  // Sphere 0 passes periodic images of the other sphere five times, one box apart.
  Case problem = few({0.0, 0.0, 0.0, 2.0, 0.1, 0.0}, {20.0, 0.0, 0.0, 2.0, 0.1, 0.0});
  problem.box = {{4.0, 9.0, 9.0}};
  expect_the_steps_of_the_reference(problem, 4);
}

TEST(AwayStepper, SpheresNeverOverlapBeyondTheSlackAndPaddingIsLeftAlone) {
  const Case problem = fluid(108, 0.2, 30.0, 1);
  Walk walk(problem);
  const Walked walked = walk.go();
  ASSERT_EQ(walked.outcome, "reached") << walk.stepper().failure();
  EXPECT_GT(walked.visits.size(), 100u);
  double deepest = 0.0;
  for (const Visit& visit : walked.visits) {
    const double overlap = std::max(0.0, -gap(problem, visit.position));
    ASSERT_LE(overlap, AwayStepper::slack);
    ASSERT_EQ(visit.violation, overlap);
    deepest = std::max(deepest, overlap);
  }
  EXPECT_LT(deepest, AwayStepper::slack);
  EXPECT_GT(walked.length, distance(problem.start, problem.finish));
  EXPECT_EQ(walk.position(), walk.goal());
  EXPECT_EQ(walk.position(), walk.layout().to_slots(problem.finish));  // padding is zero
}

TEST(AwayStepper, PathsAreReachedAtLowPackingFractions) {
  for (const double packing_fraction : {0.05, 0.1, 0.2})
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      Walk walk(fluid(108, packing_fraction, 50.0, seed));
      EXPECT_EQ(walk.go().outcome, "reached") << packing_fraction << ' ' << walk.stepper().failure();
    }
}

TEST(AwayStepper, EveryAwayStepIsCountedByItsMoves) {
  Walk walk(fluid(32, 0.2, 12.0, 1));
  const Walked walked = walk.go();
  std::uint64_t away = 0, counted = 0, several = 0;
  for (const Visit& visit : walked.visits) away += visit.kind == StepKind::detour;
  for (std::size_t k = 0; k < walk.stepper().corrections().size(); ++k) {
    counted += walk.stepper().corrections()[k];
    if (k >= 2) several += walk.stepper().corrections()[k];  // more than one sphere that makes way and one that advances
  }
  EXPECT_EQ(counted, away);
  EXPECT_GT(several, 0u);
}

TEST(AwayStepper, ACrystalHasNoRoomHereNorInTheReference) {
  const Case problem = crystal();
  const reference::HardGeodesic expected = reference_path(problem);
  ASSERT_EQ(expected.outcome, reference::Outcome::stalled);
  Walk walk(problem);
  const Walked walked = walk.go();
  EXPECT_EQ(walked.outcome, "stalled");
  EXPECT_EQ(std::string(expected.reason), "spheres push each other without end");
  EXPECT_EQ(walk.stepper().failure(), "spheres push each other without end: over 2000 in a row");
  EXPECT_EQ(walked.visits.size(), expected.accepted.size());
}

TEST(AwayStepper, AStepThatLeavesSpheresOverlappingIsRefusedHereAndInTheReference) {
  const Case problem = fluid(32, 0.38, 6.0, 25);
  const reference::HardGeodesic expected = reference_path(problem);
  ASSERT_EQ(std::string(expected.reason), "a moved sphere overlaps");
  Walk walk(problem);
  const Walked walked = walk.go();
  EXPECT_EQ(walked.outcome, "stalled");
  EXPECT_EQ(walk.stepper().failure().rfind("spheres overlap by 0.0", 0), 0u) << walk.stepper().failure();
  EXPECT_EQ(walked.visits.size(), expected.accepted.size());
  EXPECT_LE(walk.stepper().violation(), AwayStepper::slack);  // of the last accepted point
}

TEST(AwayStepper, LimitsOnDepthAndMovesEndInAReason) {
  // The first sphere that makes way pushes a second one.
  const Case problem = few({0.0, 0.6, 0.0, -3.0, 0.0, 0.0, 0.1, 1.61, 0.0}, {0.0, 0.6, 0.0, 3.0, 0.0, 0.0, 0.1, 1.61, 0.0});
  Walk shallow(problem, {.max_depth = 1});
  EXPECT_EQ(shallow.go().outcome, "stalled");
  EXPECT_EQ(shallow.stepper().failure(), "spheres push each other without end: over 1 in a row");
  Walk few_moves(problem, {.max_moves = 1});
  EXPECT_EQ(few_moves.go().outcome, "stalled");
  EXPECT_EQ(few_moves.stepper().failure(), "one away step takes over 1 moves of spheres");
  Walk enough(problem, {.max_depth = 2, .max_moves = 3});
  EXPECT_EQ(enough.go(2).outcome, "step_limit");
}

TEST(AwayStepper, AFailedStepLeavesTheStateAsItWas) {
  Walk walk(crystal());
  ASSERT_EQ(walk.go().outcome, "stalled");
  const auto corrections = walk.stepper().corrections();
  const std::string reason = walk.stepper().failure();
  const Walked again = walk.go();
  EXPECT_EQ(again.outcome, "stalled");
  EXPECT_TRUE(again.visits.empty());
  EXPECT_EQ(walk.stepper().failure(), reason);
  EXPECT_EQ(walk.stepper().corrections(), corrections);
}

TEST(AwayStepper, APathThatIsArchivedAndReadGoesOnWithTheSameBits) {
  const Case problem = fluid(32, 0.2, 12.0, 2);
  Walk whole(problem);
  const Walked all = whole.go();
  ASSERT_EQ(all.outcome, "reached");
  ASSERT_GT(all.visits.size(), 8u);
  bool between = false;   // between a flight and its away step
  bool rounding = false;  // at contact
  for (const std::size_t cut : {1u, 2u, 3u, 4u, 5u, 7u}) {
    between = between || all.visits[cut - 1].kind == StepKind::direct;
    Walk first(problem);
    first.go(cut);
    Walk second(problem);
    testing::hand_on(first, second);
    EXPECT_EQ(second.stepper().monitored(), first.stepper().monitored());
    EXPECT_EQ(second.stepper().violation(), first.stepper().violation());
    rounding = rounding || first.stepper().violation() > 0.0;
    const Walked rest = second.go();
    ASSERT_EQ(rest.visits.size(), all.visits.size() - cut);
    for (std::size_t k = 0; k < rest.visits.size(); ++k) {
      ASSERT_EQ(rest.visits[k].kind, all.visits[cut + k].kind);
      ASSERT_EQ(rest.visits[k].position, all.visits[cut + k].position);
    }
    EXPECT_EQ(second.stepper().evaluations(), whole.stepper().evaluations());
    EXPECT_EQ(second.stepper().corrections(), whole.stepper().corrections());
  }
  EXPECT_TRUE(between);
  EXPECT_TRUE(rounding);
}

TEST(AwayStepper, ABoxNoLongerThanTwoDiametersIsRefused) {
  Case problem = few({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  problem.box = {{2.0, 9.0, 9.0}};
  try {
    Walk walk(problem);
    FAIL() << "nothing was refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_EQ(std::string(error.what()),
              "away steps: a box edge of 2 is too short for spheres of diameter 1: at least 2.002 is needed");
  }
}

}  // namespace
}  // namespace lanescape
