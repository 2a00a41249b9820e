#include <lanescape/path.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <lanescape/potential.hpp>

#include "refusal.hpp"
#include "run/path_run.hpp"

namespace lanescape {
namespace {

using testing::refusal;
constexpr std::array<double, 3> cube{10.0, 10.0, 10.0};
const std::vector<int> two = {0, 0};

// Two particles with a resting centre, r apart, turned by an angle: the straight way is forbidden.
std::vector<double> turned(double r, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0, x = 0.5 * r * std::cos(angle), y = 0.5 * r * std::sin(angle);
  return {5.0 + x, 5.0 + y, 5.0, 5.0 - x, 5.0 - y, 5.0};
}
const std::vector<double> start = turned(1.3, 0.0), finish = turned(1.25, 120.0);

PathResult of_the_run(const AnyModel& model, const char* method) {
  const Configuration first{{cube}, two, start}, last{{cube}, two, finish};
  PathRunOptions options;
  options.method = &path_method(method);
  SilentMonitor monitor;
  return run_paths(model, {{first, last}}, options, choose_isa("auto"), {}, monitor).front();
}

void expect_same(const Path& path, const PathResult& expected) {
  EXPECT_TRUE(path.reached()) << path.reason;
  EXPECT_EQ(path.length, expected.length);
  EXPECT_EQ(path.direct_steps, expected.direct_steps);
  EXPECT_EQ(path.detour_steps, expected.detour_steps);
  EXPECT_EQ(path.landscape_energy, expected.landscape_energy);
  EXPECT_EQ(path.frames.front(), start);
  EXPECT_EQ(path.frames.back(), finish);
  EXPECT_GT(path.detour_steps, 0u);
}

TEST(FindPath, OfAModelIsThePathOfTheRun) {
  for (const char* method : {"contour", "escape"}) {
    const Path path = find_path(Model::named("lennard-jones"), two, cube, start, finish, {.method = method});
    const PathResult expected = of_the_run(lennard_jones(), method);
    expect_same(path, expected);
    EXPECT_EQ(path.evaluations, expected.evaluations);
  }
}

// A potential whose nature the finder cannot see.
class OfAHost final : public Landscape {
 public:
  std::size_t particles() const override { return potential_.particles(); }
  double energy(std::span<const double> r) override { return potential_.energy(r); }
  double energy_and_gradient(std::span<const double> r, std::span<double> gradient) override {
    return potential_.energy_and_gradient(r, gradient);
  }

 private:
  Potential potential_{Model::named("lennard-jones"), two, cube};
};

TEST(FindPath, OnAHostsLandscapeIsThatOfTheModelBehindIt) {
  Potential potential(Model::named("lennard-jones"), two, cube);
  OfAHost host;
  for (const char* method : {"contour", "escape"}) {
    const PathResult expected = of_the_run(lennard_jones(), method);
    const Path known = find_path(potential, start, finish, {.method = method});
    const Path unknown = find_path(host, start, finish, {.method = method});
    expect_same(known, expected);
    expect_same(unknown, expected);
    EXPECT_EQ(known.evaluations, expected.evaluations);
    // Only the model has bounds, by which the contour method leaves out trials that fail.
    if (method == std::string("contour"))
      EXPECT_GT(unknown.evaluations, 1.3 * known.evaluations);
    else
      EXPECT_EQ(unknown.evaluations, known.evaluations);
  }
}

TEST(FindPath, OfHardSpheresAvoidsOverlaps) {
  for (const char* method : {"avoidance", "away"}) {
    const Path path = find_path(Model::named("hard-sphere"), two, cube, turned(1.5, 0.0), turned(1.4, 120.0), {.method = method});
    EXPECT_TRUE(path.reached()) << path.reason;
    EXPECT_LE(path.largest_violation, 1e-9);
    EXPECT_GT(path.length, path.distance);
  }
}

// A wall of energy at x = 0 with a gap at y > 2, for one particle.
class Wall final : public Landscape {
 public:
  std::size_t particles() const override { return 1; }
  double energy(std::span<const double> r) override { return height(r) - r[1]; }
  double energy_and_gradient(std::span<const double> r, std::span<double> gradient) override {
    const double slope = -2.0 * r[0] * height(r);
    gradient[0] = slope;
    gradient[1] = -1.0;
    gradient[2] = 0.0;
    ++evaluations;
    return energy(r);
  }
  int evaluations = 0;

 private:
  static double height(std::span<const double> r) { return 2.0 * std::exp(-r[0] * r[0]); }
};

TEST(FindPath, WalksAroundAWallOfTheHost) {
  Wall wall;
  const std::vector<double> left = {-2.0, 0.0, 0.0}, right = {2.0, 0.0, 0.0};
  const Path path = find_path(wall, left, right, {});
  EXPECT_TRUE(path.reached()) << path.reason;
  EXPECT_LE(path.largest_violation, 0.0);
  double highest = 0.0;
  for (const auto& frame : path.frames) highest = std::max(highest, frame[1]);
  EXPECT_GT(highest, 1.9);  // where 2 - y is E_L = 2 exp(-4)
  EXPECT_GT(wall.evaluations, 0);
}

TEST(FindPath, WithAdaptiveStepsIsTheSamePathInFewerEvaluations) {
  Wall wall;
  OfAHost host;
  Potential potential(Model::named("lennard-jones"), two, cube);
  const std::vector<double> left = {-2.0, 0.0, 0.0}, right = {2.0, 0.0, 0.0};
  const auto expect_fewer = [](Landscape& landscape, std::span<const double> from, std::span<const double> to) {
    const Path faithful = find_path(landscape, from, to, {}), adaptive = find_path(landscape, from, to, {.adaptive = true});
    EXPECT_TRUE(adaptive.reached()) << adaptive.reason;
    EXPECT_NEAR(adaptive.length / faithful.length, 1.0, 2e-3);
    EXPECT_LE(adaptive.largest_violation, 1e-3);
    EXPECT_LT(10 * adaptive.evaluations, faithful.evaluations);
  };
  expect_fewer(wall, left, right);
  expect_fewer(host, start, finish);
  expect_fewer(potential, start, finish);
}

TEST(FindPath, WithMassesIsLongerInHeavyCoordinates) {
  Wall wall;
  const std::vector<double> left = {-2.0, 0.0, 0.0}, right = {2.0, 0.0, 0.0};
  const Path equal = find_path(wall, left, right, {}), one_mass = find_path(wall, left, right, {}, std::vector<double>{7.0});
  EXPECT_EQ(equal.length, one_mass.length);  // relative to the mean mass
  Potential potential(Model::named("lennard-jones"), two, cube);
  const Path heavy = find_path(potential, start, finish, {}, std::vector<double>{3.0, 1.0});
  EXPECT_TRUE(heavy.reached());
  EXPECT_NE(heavy.length, find_path(potential, start, finish, {}).length);
}

TEST(FindPath, LetsExceptionsOfTheLandscapePass) {
  class Refusing final : public Landscape {
   public:
    std::size_t particles() const override { return 2; }
    double energy(std::span<const double>) override { throw std::logic_error("no more"); }
    double energy_and_gradient(std::span<const double>, std::span<double>) override { throw std::logic_error("no more"); }
  } refusing;
  EXPECT_THROW(find_path(refusing, start, finish, {}), std::logic_error);
}

TEST(FindPath, EndsWhenProgressSaysSo) {
  int calls = 0;
  PathSettings settings;
  settings.step = 1e-6;
  settings.progress = [&](double part) {
    EXPECT_GE(part, 0.0);
    EXPECT_LE(part, 1.0);
    return ++calls < 3;
  };
  const Path path = find_path(Model::named("lennard-jones"), two, cube, start, finish, settings);
  EXPECT_EQ(path.outcome, "interrupted");
  EXPECT_EQ(calls, 3);
  EXPECT_GT(path.direct_steps, 0u);
}

TEST(FindPath, FromBothEndsKeepsTheShorterWay) {
  const Model model = Model::named("lennard-jones");
  const double forward = find_path(model, two, cube, start, finish, {}).length;
  const double backward = find_path(model, two, cube, finish, start, {}).length;
  const Path both = find_path(model, two, cube, start, finish, {.reverse = true});
  EXPECT_EQ(both.length, std::min(forward, backward));
  EXPECT_EQ(both.reversed, backward < forward);
}

TEST(FindPath, RefusesAnEndWithoutAnEnergy) {
  class Hole final : public Landscape {
   public:
    std::size_t particles() const override { return 1; }
    double energy(std::span<const double> r) override { return r[0] > 0.5 ? std::nan("") : 0.0; }
    double energy_and_gradient(std::span<const double> r, std::span<double> gradient) override {
      std::fill(gradient.begin(), gradient.end(), 0.0);
      return energy(r);
    }
  } hole;
  const std::vector<double> sound{0.0, 0.0, 0.0}, in_hole{1.0, 0.0, 0.0};
  const std::string message = "end points: an end point has energy nan: it must be finite";
  EXPECT_EQ(refusal([&] { find_path(hole, sound, in_hole, {}); }), message);
  EXPECT_EQ(refusal([&] { find_path(hole, in_hole, sound, {}); }), message);
}

TEST(FindPath, RefusesWhatCannotBe) {
  const Model model = Model::named("lennard-jones");
  const auto refused = [&](const std::vector<double>& from, const std::vector<double>& to, const PathSettings& settings) {
    return refusal([&] { find_path(model, two, cube, from, to, settings); });
  };
  EXPECT_EQ(refused(start, start, {}), "end points: the two end points coincide");
  EXPECT_EQ(refusal([&] { find_path(model, {}, cube, {}, {}, {}); }),
            "a path of no particles is not possible: at least one is needed");
  EXPECT_EQ(refusal([&] { find_path(model, two, cube, start, finish, {}, start); }),
            "model lennard-jones has no diameters of particles: none are allowed");
  EXPECT_EQ(refused(start, {0.0}, {}), "1 coordinates were given for 2 particles: 6 are needed");
  EXPECT_NE(refused(start, finish, {.method = "tunnel"}).find("unknown method 'tunnel'"), std::string::npos);
  EXPECT_NE(refused(start, finish, {.method = "away"}).find("method away is not for model lennard-jones"), std::string::npos);
  EXPECT_NE(refused(start, finish, {.landscape_energy = -5.0}).find("above the landscape energy -5"), std::string::npos);
  EXPECT_NE(refused(start, finish, {.step = -1.0}).find("step -1 is not allowed"), std::string::npos);
  EXPECT_EQ(refused(start, finish, {.method = "escape", .adaptive = true}).rfind("method escape has no adaptive steps: ", 0), 0u);
  EXPECT_EQ(refused(start, finish, {.adaptive = true, .step = 0.1}), "adaptive steps have no given length: without a step only");
  EXPECT_NE(refused(turned(0.1, 0.0), finish, {}).find("end points, first end: particles 0 and 1 overlap"), std::string::npos);
  Wall wall;
  EXPECT_EQ(refusal([&] { find_path(wall, std::vector<double>{1.0, std::nan(""), 0.0}, std::vector<double>{1.0, 0.0, 0.0}, {}); }),
            "y coordinate nan of particle 0 (from 0) is not allowed: it must be finite");
  EXPECT_EQ(refusal([&] { find_path(wall, std::vector<double>(3), std::vector<double>(3), {}); }),
            "end points: the two end points coincide");
  EXPECT_EQ(refusal([&] {
              find_path(wall, std::vector<double>(3), std::vector<double>{1.0, 0.0, 0.0}, {}, std::vector<double>{1.0, 2.0});
            }),
            "2 masses were given for 1 particles: one for each, or none");
}

}  // namespace
}  // namespace lanescape
