#include "stepper/slide.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "configuration/hard_sphere_model.hpp"
#include "core/run_monitor.hpp"
#include "dynamics/hard_sphere_start.hpp"
#include "memory_archive.hpp"
#include "path/finder.hpp"
#include "run/end_point_run.hpp"
#include "two_sphere_path.hpp"

namespace lanescape {
namespace {

// A path from one configuration to another, with every point it visits.
class Slide {
 public:
  Slide(const Configuration& start, const Configuration& finish, const HardSphereModel& model, double largest_move = 0.1)
      : start_(start),
        layout_(start.species, model.species.size()),
        metric_(model, layout_),
        options_{.largest_move = largest_move},
        landscape_(start.box, layout_, start.radii, metric_, choose_isa("auto"), SlideStepper::reach(options_),
                   SlideStepper::skin(options_)),
        finder_(landscape_.algebra(), SlideStepper(landscape_, options_), kinematic(start), kinematic(finish), start.size(),
                {.max_steps = 100'000}) {}

  void advance(std::size_t steps) {
    for (; steps > 0 && finder_.outcome() == Outcome::running; --steps) {
      points_.push_back(position());
      finder_.advance(1);
    }
    points_.push_back(position());
  }
  const PathFinder<SlideStepper>& finder() const { return finder_; }
  const std::vector<std::vector<double>>& points() const { return points_; }
  std::vector<double> position() const {
    AlignedArray q = finder_.position();
    metric_.to_positions(q);
    return layout_.to_user(q);
  }
  void exchange(Archive& archive) { finder_.exchange(archive); }

  // The smallest gap of any two spheres along all straight segments: closest approach in linear relative motion, all near images.
  double smallest_gap() const {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < points_.size(); ++k)
      for (std::size_t i = 0; i < start_.size(); ++i)
        for (std::size_t j = i + 1; j < start_.size(); ++j) smallest = std::min(smallest, gap(points_[k - 1], points_[k], i, j));
    return smallest;
  }

 private:
  AlignedArray kinematic(const Configuration& configuration) const {
    AlignedArray q = layout_.to_slots(configuration.positions);
    metric_.to_kinematic(q);
    return q;
  }
  double gap(const std::vector<double>& from, const std::vector<double>& to, std::size_t i, std::size_t j) const {
    const Point begin = start_.box.nearest_image(difference(point_at(from.data(), j), point_at(from.data(), i)));
    const Point move = difference(difference(point_at(to.data(), j), point_at(from.data(), j)),
                                  difference(point_at(to.data(), i), point_at(from.data(), i)));
    double smallest = std::numeric_limits<double>::infinity();
    for (int cell = 0; cell < 27; ++cell) {
      const Box& box = start_.box;
      const Point r{begin[0] + box.length[0] * (cell % 3 - 1), begin[1] + box.length[1] * (cell / 3 % 3 - 1),
                    begin[2] + box.length[2] * (cell / 9 - 1)};
      const double squared = dot(move, move), time = squared > 0.0 ? std::clamp(-dot(r, move) / squared, 0.0, 1.0) : 0.0;
      const Point nearest{r[0] + time * move[0], r[1] + time * move[1], r[2] + time * move[2]};
      smallest = std::min(smallest, std::sqrt(dot(nearest, nearest)));
    }
    return smallest - start_.radii[i] - start_.radii[j];
  }

  Configuration start_;
  ParticleLayout layout_;
  KinematicMetric metric_;
  SlideStepper::Options options_;
  ContactLandscape landscape_;
  PathFinder<SlideStepper> finder_;
  std::vector<std::vector<double>> points_;
};

// Two spheres whose relative vector turns by `theta` from length a to length b in a plane along no axis; the centre of mass rests.
struct TwoSpheres {
  double a = 3.0, b = 3.0, theta = 170.0 * std::numbers::pi / 180.0;
  double radius[2] = {0.5, 0.5}, mass[2] = {1.0, 1.0};

  HardSphereModel model() const {
    HardSphereModel made = hard_sphere_binary();
    for (std::size_t k = 0; k < 2; ++k) {
      made.diameters[k] = 2.0 * radius[k];
      made.species[k].mass = mass[k];
    }
    return made;
  }
  Configuration at(double length, double angle) const {
    const double x = length * std::cos(angle), y = length * std::sin(angle);
    const Point r{0.6 * x, y, 0.8 * x};
    Configuration made{{{20.0, 21.0, 22.0}}, {0, 1}, {}, {radius[0], radius[1]}, {}};
    for (std::size_t k = 0; k < 2; ++k) {
      const double share = (k == 0 ? -mass[1] : mass[0]) / (mass[0] + mass[1]);
      for (std::size_t axis = 0; axis < 3; ++axis) made.positions.push_back(1.0 + share * r[axis]);
    }
    return made;
  }
  Slide slide(double largest_move) const { return {at(a, 0.0), at(b, theta), model(), largest_move}; }
  double greedy_length() const {  // kinematic
    const double relative = testing::TwoSpherePath{a, b, theta, radius[0] + radius[1]}.greedy_length();
    const double total = mass[0] + mass[1];
    return relative * std::sqrt(mass[0] * mass[1] / total / (0.5 * total));
  }
};

void expect_greedy_length(const TwoSpheres& spheres) {
  Slide coarse = spheres.slide(0.1), fine = spheres.slide(0.01);
  coarse.advance(10'000);
  fine.advance(100'000);
  ASSERT_EQ(coarse.finder().outcome(), Outcome::reached) << coarse.finder().reason();
  ASSERT_EQ(fine.finder().outcome(), Outcome::reached) << fine.finder().reason();
  const double expected = spheres.greedy_length();
  EXPECT_NEAR(coarse.finder().statistics().length(), expected, 3e-3 * expected);
  EXPECT_NEAR(fine.finder().statistics().length(), expected, 3e-4 * expected);
  EXPECT_GE(coarse.smallest_gap(), -1e-12);
  EXPECT_GE(fine.smallest_gap(), -1e-12);
  EXPECT_LE(fine.smallest_gap(), 3e-4 / (spheres.radius[0] + spheres.radius[1]));  // contacts curve away within a step
}

TEST(SlideStepper, TakesTheGreedyWayOfTwoSpheres) {
  const TwoSpheres spheres;
  EXPECT_NEAR(spheres.greedy_length() * std::numbers::sqrt2, 6.4106, 5e-5);  // PHYSICS 6
  expect_greedy_length(spheres);
}

TEST(SlideStepper, TakesTheGreedyWayForAnyDistancesDiametersAndMasses) {
  expect_greedy_length({.a = 2.0, .b = 4.0, .theta = 2.5});
  expect_greedy_length({.radius = {0.3, 0.9}});
  expect_greedy_length({.theta = 2.8, .radius = {0.7, 0.5}, .mass = {1.0, 10.0}});
  expect_greedy_length({.a = 1.5, .b = 3.5, .mass = {7.0, 0.5}});
}

TEST(SlideStepper, KeepsTheCentreOfMassAtRestWithUnequalMasses) {
  const TwoSpheres spheres{.mass = {1.0, 10.0}};
  Slide slide = spheres.slide(0.1);
  slide.advance(10'000);
  for (const std::vector<double>& point : slide.points())
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR((point[axis] + 10.0 * point[3 + axis]) / 11.0, 1.0, 1e-12);
}

Configuration spheres_at(std::vector<double> positions) {
  const std::size_t particles = positions.size() / 3;
  return {{{20.0, 20.0, 20.0}}, std::vector<int>(particles, 0), std::move(positions), std::vector<double>(particles, 0.5), {}};
}

TEST(SlideStepper, GoesStraightToTheGoalWhereNothingIsInTheWay) {
  Slide slide(spheres_at({5.0, 5.0, 5.0, 5.0, 7.0, 5.0}), spheres_at({8.0, 5.0, 5.0, 8.0, 7.0, 5.0}), hard_sphere());
  slide.advance(1000);
  EXPECT_EQ(slide.finder().outcome(), Outcome::reached);
  EXPECT_NEAR(slide.finder().statistics().length(), 3.0 * std::numbers::sqrt2, 1e-12);
  EXPECT_EQ(slide.finder().detour_steps(), 0u);
  EXPECT_LT(slide.finder().steps(), 45u);
}

TEST(SlideStepper, MovesNoSphereFurtherThanItsOptionAllows) {
  const TwoSpheres spheres;
  Slide slide = spheres.slide(0.05);
  slide.advance(10'000);
  const auto& points = slide.points();
  for (std::size_t k = 1; k < points.size(); ++k)
    for (std::size_t j = 0; j < 2; ++j) {
      const Point move = difference(point_at(points[k].data(), j), point_at(points[k - 1].data(), j));
      EXPECT_LE(std::sqrt(dot(move, move)), 1.25 * 0.05 * (1.0 + 1e-12));
    }
}

TEST(SlideStepper, PassesSpheresThatMeetHeadOn) {
  Slide slide(spheres_at({4.0, 5.0, 5.0, 6.0, 5.0, 5.0}), spheres_at({7.0, 5.0, 5.0, 3.0, 5.0, 5.0}), hard_sphere());
  slide.advance(10'000);
  EXPECT_EQ(slide.finder().outcome(), Outcome::reached) << slide.finder().reason();
  EXPECT_GE(slide.smallest_gap(), -1e-12);
  EXPECT_LT(slide.finder().statistics().length(), 6.0);
  EXPECT_GT(slide.finder().stepper().histograms()[0].counts[1], 0.0);  // with a sharpened pull
}

TEST(SlideStepper, StopsWithAReasonInACrystalThatLetsNothingPass) {
  // fcc at close packing but for 1e-6; two neighbours are to change places.
  Configuration crystal = spheres_at({});
  const double edge = std::numbers::sqrt2 * (1.0 + 1e-6);
  crystal.box = {{2.0 * edge, 2.0 * edge, 2.0 * edge}};
  for (int cell = 0; cell < 8; ++cell)
    for (int site = 0; site < 4; ++site) {
      const Point offset{site == 1 || site == 2 ? 0.5 : 0.0, site == 1 || site == 3 ? 0.5 : 0.0, site >= 2 ? 0.5 : 0.0};
      for (int axis = 0; axis < 3; ++axis)
        crystal.positions.push_back(edge * ((cell >> axis & 1) + offset[static_cast<std::size_t>(axis)]));
    }
  crystal.species.assign(32, 0);
  crystal.radii.assign(32, 0.5);
  Configuration swapped = crystal;
  std::swap_ranges(swapped.positions.begin(), swapped.positions.begin() + 3, swapped.positions.begin() + 3);
  Slide slide(crystal, swapped, hard_sphere());
  slide.advance(10'000);
  EXPECT_EQ(slide.finder().outcome(), Outcome::stalled);
  EXPECT_EQ(slide.finder().reason().rfind("contacts balance the pull of the goal, at a distance of ", 0), 0u)
      << slide.finder().reason();
  EXPECT_GE(slide.smallest_gap(), -1e-12);
}

ConfigurationPair dense_pair(double packing_fraction, const HardSphereModel& model) {
  HardEndPointOptions options;
  options.distance = 20.0;
  options.equilibration_collisions = 20'000;
  options.seed = 3;
  SilentMonitor monitor;
  const Isa isa = choose_isa("auto");
  const Configuration start = make_hard_sphere_start(model, 32, packing_fraction, StartMethod::growth, 1, isa, monitor).value();
  return run_hard_end_points(model, start, options, isa, {}, monitor).pairs.at(0);
}

TEST(SlideStepper, ReachesItsGoalInADenseMixtureWithNoOverlapAlongAnySegment) {
  for (const double packing_fraction : {0.3, 0.5, 0.56}) {
    const ConfigurationPair pair = dense_pair(packing_fraction, hard_sphere_binary());
    Slide slide(pair.start, pair.finish, hard_sphere_binary());
    slide.advance(100'000);
    ASSERT_EQ(slide.finder().outcome(), Outcome::reached) << slide.finder().reason();
    EXPECT_GE(slide.smallest_gap(), -1e-12);
    EXPECT_LE(slide.finder().largest_violation(), 1e-12);
    EXPECT_EQ(slide.position(), pair.finish.positions);
  }
}

TEST(SlideStepper, ReachesItsGoalInADenseMixtureOfUnequalMasses) {
  HardSphereModel model = hard_sphere_binary();
  model.species[0].mass = 5.0;
  const ConfigurationPair pair = dense_pair(0.5, model);
  Slide slide(pair.start, pair.finish, model);
  slide.advance(100'000);
  ASSERT_EQ(slide.finder().outcome(), Outcome::reached) << slide.finder().reason();
  EXPECT_GE(slide.smallest_gap(), -1e-12);
}

TEST(SlideStepper, ContinuesFromAnArchiveWithTheSameBits) {
  const ConfigurationPair pair = dense_pair(0.5, hard_sphere_binary());
  for (const std::size_t steps : {0u, 1u, 17u, 60u}) {
    Slide whole(pair.start, pair.finish, hard_sphere_binary()), resumed(pair.start, pair.finish, hard_sphere_binary());
    whole.advance(steps);
    testing::MemoryArchive archive;
    whole.exchange(archive);
    archive.rewind();
    resumed.exchange(archive);
    whole.advance(100'000);
    resumed.advance(100'000);
    EXPECT_EQ(resumed.finder().steps(), whole.finder().steps());
    EXPECT_EQ(resumed.finder().statistics().length(), whole.finder().statistics().length());
    EXPECT_EQ(resumed.finder().stepper().corrections(), whole.finder().stepper().corrections());
    const auto& a = whole.points();
    const auto& b = resumed.points();
    for (std::size_t k = 1; k <= b.size(); ++k) EXPECT_EQ(b[b.size() - k], a[a.size() - k]);
  }
}

}  // namespace
}  // namespace lanescape
