#include <lanescape/shortening.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <lanescape/potential.hpp>

#include "refusal.hpp"
#include "run/shorten_run.hpp"

namespace lanescape {
namespace {

using testing::refusal;
using Frames = std::vector<std::vector<double>>;
constexpr std::array<double, 3> cube{10.0, 10.0, 10.0};
const std::vector<int> two = {0, 0};

// Two particles with a resting centre, r apart, turned by an angle: the straight way is forbidden.
std::vector<double> turned(double r, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0, x = 0.5 * r * std::cos(angle), y = 0.5 * r * std::sin(angle);
  return {5.0 + x, 5.0 + y, 5.0, 5.0 - x, 5.0 - y, 5.0};
}
const std::vector<double> start = turned(1.3, 0.0), finish = turned(1.25, 120.0);
const Model lj = Model::named("lennard-jones"), spheres = Model::named("hard-sphere");

// A potential whose nature the library cannot see.
class OfAHost final : public Landscape {
 public:
  std::size_t particles() const override { return potential_.particles(); }
  double energy(std::span<const double> r) override { return potential_.energy(r); }
  double energy_and_gradient(std::span<const double> r, std::span<double> gradient) override {
    return potential_.energy_and_gradient(r, gradient);
  }

 private:
  Potential potential_{lj, two, cube};
};

// How near two particles are, so that E_L = 0 is the surface of hard spheres of diameter 1.
class Nearness final : public Landscape {
 public:
  std::size_t particles() const override { return 2; }
  double energy(std::span<const double> r) override { return 1.0 - distance(r); }
  double energy_and_gradient(std::span<const double> r, std::span<double> gradient) override {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      gradient[axis] = (r[3 + axis] - r[axis]) / distance(r);
      gradient[3 + axis] = -gradient[axis];
    }
    return energy(r);
  }

 private:
  static double distance(std::span<const double> r) { return std::hypot(r[0] - r[3], r[1] - r[4], r[2] - r[5]); }
};

ShortenResult of_the_run(const AnyModel& model, const char* method, const char* path_method_word) {
  const ConfigurationPair pair{{{cube}, two, start}, {{cube}, two, finish}};
  ShortenOptions options;
  options.method = &shorten_method(method);
  options.search.method = &path_method(path_method_word);
  SilentMonitor monitor;
  return run_shorten(model, pair, {}, options, choose_isa("auto"), {}, monitor);
}

ShortenSettings by(const char* method, const char* path_method_word = "") {
  ShortenSettings settings;
  settings.method = method;
  settings.search.method = path_method_word;
  return settings;
}

TEST(ShortenPath, OfAModelIsThePathOfTheRun) {
  for (const std::string& method : shorten_method_names()) {
    const ShortPath path = shorten_path(lj, two, cube, start, finish, by(method.c_str()));
    const ShortenResult expected = of_the_run(lennard_jones(), method.c_str(), "contour");
    EXPECT_TRUE(path.reached()) << path.reason;
    EXPECT_EQ(path.length, expected.shortest.path.length);
    EXPECT_EQ(path.length_before, expected.length_before);
    EXPECT_EQ(path.start_lengths, expected.start_lengths);
    EXPECT_EQ(path.landscape_energy, expected.shortest.path.landscape_energy);
    ASSERT_EQ(path.kuhn_tucker_residual.has_value(), expected.shortest.check.has_value());
    if (expected.shortest.check) {
      EXPECT_EQ(*path.kuhn_tucker_residual, expected.shortest.check->kuhn_tucker_residual);
    }
    EXPECT_EQ(path.multipliers.size(), path.kuhn_tucker_residual ? path.frames.size() : 0);
    ASSERT_EQ(path.frames.size(), expected.shortest.path.frames.size());
    EXPECT_EQ(path.frames.front(), start);
    EXPECT_EQ(path.frames.back(), finish);
    EXPECT_LE(path.length, path.length_before);
    EXPECT_NEAR(path.ratio_squared, std::pow(path.distance / path.length, 2), 1e-12);
  }
}

TEST(ShortenPath, OnAHostsLandscapeIsThatOfTheModelBehindIt) {
  Potential potential(lj, two, cube);
  OfAHost host;
  for (const std::string& method : shorten_method_names()) {
    const ShortPath expected = shorten_path(lj, two, cube, start, finish, by(method.c_str(), "escape"));
    EXPECT_EQ(shorten_path(potential, start, finish, by(method.c_str(), "escape")).length, expected.length);
    EXPECT_EQ(shorten_path(host, start, finish, by(method.c_str(), "escape")).length, expected.length);
  }
}

TEST(ShortenPath, ByItsCurveIsTheGeodesicOfTwoSpheres) {
  Nearness soft;
  ShortenSettings settings = by("curve");
  settings.search.landscape_energy = 0.0;
  settings.search.adaptive = true;
  const ShortPath path = shorten_path(soft, turned(3.0, 0.0), turned(3.0, 170.0), settings);
  EXPECT_TRUE(path.reached()) << path.reason;
  EXPECT_NEAR(path.length, 6.1620 / std::numbers::sqrt2, 1e-4 * path.length);
  const PathCertificate certificate = check_path(soft, path.frames, {.landscape_energy = 0.0});
  EXPECT_EQ(path.kuhn_tucker_residual, certificate.kuhn_tucker_residual);
  EXPECT_EQ(path.multipliers, certificate.multipliers);
  EXPECT_EQ(path.largest_violation, certificate.largest_violation);
}

TEST(ShortenPath, OfHardSpheresByItsCurveIsTheirGeodesic) {
  const ShortPath path = shorten_path(spheres, two, cube, turned(3.0, 0.0), turned(3.0, 170.0), by("curve", "away"));
  EXPECT_TRUE(path.reached()) << path.reason;
  EXPECT_NEAR(path.length, 6.1620 / std::numbers::sqrt2, 1e-4 * path.length);
  EXPECT_EQ(path.multipliers, check_path(spheres, two, cube, path.frames, {}).multipliers);
}

TEST(ShortenPath, StartsFromAGivenPathThatMayRunTheOtherWay) {
  OfAHost host;
  Frames frames = find_path(lj, two, cube, start, finish, {.frames = 20}).frames;
  const ShortPath forward = shorten_path(host, start, finish, by("montecarlo"), {}, frames);
  EXPECT_LE(forward.length, forward.length_before);
  EXPECT_EQ(shorten_path(lj, two, cube, start, finish, by("montecarlo"), {}, frames).reached(), true);
  std::reverse(frames.begin(), frames.end());
  const ShortPath backward = shorten_path(host, start, finish, by("montecarlo"), {}, frames);
  EXPECT_EQ(backward.length, forward.length);
  EXPECT_EQ(backward.frames.front(), start);
}

TEST(ShortenPath, OfHardSpheresAvoidsOverlapsOnAnyNumberOfThreads) {
  ShortenSettings settings = by("montecarlo", "away");
  settings.starts = 3;
  const ShortPath one = shorten_path(spheres, two, cube, turned(1.5, 0.0), turned(1.4, 120.0), settings);
  EXPECT_TRUE(one.reached()) << one.reason;
  EXPECT_LE(one.largest_violation, 1e-9);
  ASSERT_EQ(one.start_lengths.size(), 3u);
  EXPECT_EQ(one.length, *std::min_element(one.start_lengths.begin(), one.start_lengths.end()));
  settings.search.threads = 2;
  EXPECT_EQ(shorten_path(spheres, two, cube, turned(1.5, 0.0), turned(1.4, 120.0), settings).start_lengths, one.start_lengths);
}

TEST(ShortenPath, WithMassesIsLongerInHeavyCoordinates) {
  Potential potential(lj, two, cube);
  const ShortPath equal = shorten_path(potential, start, finish, {});
  const ShortPath heavy = shorten_path(potential, start, finish, {}, std::vector<double>{3.0, 1.0});
  EXPECT_TRUE(heavy.reached()) << heavy.reason;
  EXPECT_NE(heavy.length, equal.length);
  EXPECT_EQ(heavy.frames.front(), start);
}

TEST(ShortenPath, EndsWhenProgressSaysSo) {
  for (const bool at_once : {true, false}) {
    ShortenSettings settings;
    double last = 0.0;
    settings.search.progress = [&](double made) {
      last = made;
      return !at_once && made < 1.0;
    };
    const ShortPath path = shorten_path(lj, two, cube, start, finish, settings);
    EXPECT_EQ(path.outcome, "interrupted");
    EXPECT_EQ(last, at_once ? 0.0 : 1.0);
    EXPECT_EQ(path.frames.empty(), at_once);
  }
}

TEST(ShortenPath, LetsExceptionsPassOnAnyNumberOfThreads) {
  class Refusing final : public Landscape {
   public:
    std::size_t particles() const override { return 2; }
    double energy(std::span<const double>) override { throw std::logic_error("no more"); }
    double energy_and_gradient(std::span<const double>, std::span<double>) override { throw std::logic_error("no more"); }
  } refusing;
  EXPECT_THROW(shorten_path(refusing, start, finish, {}), std::logic_error);
  ShortenSettings settings = by("montecarlo");
  settings.starts = 4;
  settings.search.threads = 2;
  settings.search.progress = [](double made) -> bool {
    if (made > 0.0) throw std::logic_error("enough");
    return true;
  };
  EXPECT_THROW(shorten_path(lj, two, cube, start, finish, settings), std::logic_error);
}

TEST(ShortenPath, ReportsAFirstPathThatDoesNotReachItsGoal) {
  ShortenSettings settings;
  settings.search.max_steps = 10;
  const ShortPath path = shorten_path(lj, two, cube, start, finish, settings);
  EXPECT_EQ(path.outcome, "step_limit");
  EXPECT_FALSE(path.reason.empty());
  EXPECT_TRUE(path.frames.empty());
  EXPECT_EQ(path.ratio_squared, 0.0);
}

TEST(ShortenPath, RefusesWhatCannotBe) {
  const auto refused = [&](const ShortenSettings& settings) {
    return refusal([&] { shorten_path(lj, two, cube, start, finish, settings); });
  };
  EXPECT_NE(refused(by("walk")).find("unknown method 'walk': allowed: "), std::string::npos);
  EXPECT_NE(refused(by("", "away")).find("method away is not for model lennard-jones"), std::string::npos);
  ShortenSettings settings;
  settings.starts = 0;
  EXPECT_EQ(refused(settings), "0 starts are not allowed: from 1 to 10000");
  settings = {};
  settings.search.reverse = true;
  EXPECT_EQ(refused(settings), "a path to shorten is not searched from both ends: without reverse only");
  EXPECT_EQ(refusal([&] { shorten_path(lj, two, cube, start, start, {}); }), "end points: the two end points coincide");
}

TEST(ShortenPath, RefusesFramesThatAreNoPathOfTheEnds) {
  OfAHost host;
  const Frames frames = find_path(lj, two, cube, start, finish, {.frames = 3}).frames;
  ASSERT_EQ(frames.size(), 5u);
  const auto refused = [&](auto change) {
    Frames changed = frames;
    change(changed);
    const std::string of_model = refusal([&] { shorten_path(lj, two, cube, start, finish, {}, {}, changed); });
    EXPECT_EQ(refusal([&] { shorten_path(host, start, finish, {}, {}, changed); }), of_model);
    return of_model;
  };
  EXPECT_EQ(refused([](Frames& f) { f.resize(2); }), "path: holds 2 frames: a path has at least 3");
  EXPECT_EQ(refused([](Frames& f) { f[1].pop_back(); }), "path, frame 2: 5 coordinates were given for 2 particles: 6 are needed");
  EXPECT_EQ(refused([](Frames& f) { f[2][1] = std::nan(""); }),
            "path, frame 3: y coordinate nan of particle 0 (from 0) is not allowed: it must be finite");
  EXPECT_EQ(refused([](Frames& f) { f.front()[0] += 0.01; }), "path: its first and last frame are not the end points of the pair");
  const std::string outside = refused([](Frames& f) { f[1] = turned(0.8, 60.0); });
  EXPECT_EQ(outside.rfind("path, frame 2: its energy ", 0), 0u) << outside;
}

// The straight way of two spheres past each other, three apart at first, and the taut one around the ball of diameter 1.
Frames around(std::size_t segments, double radius) {
  const double angle = 170.0 * std::numbers::pi / 180.0, tangent = std::acos(radius / 3.0);
  Frames frames;
  const auto add = [&](double r, double at) { frames.push_back(turned(r, at * 180.0 / std::numbers::pi)); };
  add(3.0, 0.0);
  for (std::size_t k = 0; k <= segments; ++k)
    add(radius, tangent + (angle - 2.0 * tangent) * static_cast<double>(k) / static_cast<double>(segments));
  add(3.0, angle);
  return frames;
}

TEST(CheckPath, CertifiesTheGeodesicOfTwoSpheres) {
  const Frames taut = around(200, 1.0);
  Nearness soft;
  for (const PathCertificate& c : {check_path(spheres, two, cube, taut, {}), check_path(soft, taut, {.landscape_energy = 0.0})}) {
    EXPECT_NEAR(c.length, 6.1620 / std::numbers::sqrt2, 1e-4);
    EXPECT_LT(c.kuhn_tucker_residual, 1e-2);
    EXPECT_LT(c.largest_violation, 1e-4);
    EXPECT_EQ(c.multipliers.size(), taut.size());
    EXPECT_EQ(c.excess.size(), taut.size());
    EXPECT_EQ(c.segment_violation.size(), taut.size() - 1);
    EXPECT_NEAR(c.ratio_squared, std::pow(c.distance / c.length, 2), 1e-12);
  }
  const PathCertificate wide = check_path(spheres, two, cube, around(200, 1.1), {});
  EXPECT_EQ(wide.largest_violation, 0.0);
  EXPECT_NEAR(wide.kuhn_tucker_residual, 1.0, 1e-12);  // it bends where nothing is in the way
}

TEST(CheckPath, OfAStraightLineTellsHowFarItLeavesTheAllowedRegion) {
  const Frames straight = {turned(3.0, 0.0), turned(0.0, 0.0), turned(3.0, 180.0)};
  EXPECT_NEAR(check_path(spheres, two, cube, straight, {}).largest_violation, 1.0, 1e-12);
  const Frames past = {{0.0, 0.0, 0.0, 2.0, 0.5, 0.0}, {1.0, 0.0, 0.0, 1.0, 0.5, 0.0}, {2.0, 0.0, 0.0, 0.0, 0.5, 0.0}};
  Nearness soft;
  const PathCertificate c = check_path(soft, past, {});
  EXPECT_NEAR(c.largest_violation, std::hypot(2.0, 0.5) - 0.5, 1e-12);
  EXPECT_EQ(c.kuhn_tucker_residual, 0.0);
  EXPECT_NEAR(c.length, c.distance, 1e-12);
  EXPECT_EQ(c.landscape_energy, 1.0 - std::hypot(2.0, 0.5));
}

TEST(CheckPath, OnAHostsLandscapeIsThatOfTheModelBehindIt) {
  const Frames frames = find_path(lj, two, cube, start, finish, {.frames = 100}).frames;
  Potential potential(lj, two, cube);
  OfAHost host;
  const PathCertificate expected = check_path(lj, two, cube, frames, {.threads = 2});
  for (const PathCertificate& c : {check_path(potential, frames, {}), check_path(host, frames, {})}) {
    EXPECT_EQ(c.length, expected.length);
    EXPECT_EQ(c.kuhn_tucker_residual, expected.kuhn_tucker_residual);
    EXPECT_EQ(c.multipliers, expected.multipliers);
    EXPECT_EQ(c.landscape_energy, expected.landscape_energy);
  }
  EXPECT_NE(check_path(host, frames, {}, std::vector<double>{3.0, 1.0}).length, expected.length);
}

TEST(CheckPath, RefusesWhatCannotBe) {
  OfAHost host;
  const Frames frames = {start, turned(1.3, 50.0), finish};
  EXPECT_EQ(refusal([&] { check_path(lj, two, cube, {start, finish}, {}); }),
            "a path of 2 frames is not allowed: at least 3 are needed");
  EXPECT_EQ(refusal([&] { check_path(host, {}, {}); }), "a path of 0 frames is not allowed: at least 3 are needed");
  EXPECT_EQ(refusal([&] { check_path(host, {start, {1.0}, finish}, {}); }),
            "path, frame 2: 1 coordinates were given for 2 particles: 6 are needed");
  EXPECT_EQ(refusal([&] { check_path(host, {start, start, finish}, {}); }),
            "nodes 0 and 1 of the path coincide: neighbouring nodes must differ");
  EXPECT_EQ(refusal([&] { check_path(spheres, two, cube, frames, {.landscape_energy = 0.0}); }),
            "hard spheres have no landscape energy: without it only");
  EXPECT_EQ(refusal([&] { check_path(lj, two, cube, frames, {.landscape_energy = std::nan("")}); }),
            "landscape energy nan is not allowed: it must be finite");
  EXPECT_NE(refusal([&] { check_path(lj, two, cube, frames, {.threads = 0}); }).find("0 threads are not allowed"),
            std::string::npos);
  EXPECT_EQ(refusal([&] { check_path(lj, two, cube, frames, {}, start); }),
            "model lennard-jones has no diameters of particles: none are allowed");
  const Model glass = Model::named("polydisperse");
  EXPECT_EQ(refusal([&] { check_path(glass, two, cube, frames, {}, std::vector<double>{1.0}); }),
            "1 diameters were given for 2 particles: one for each is needed");
  EXPECT_EQ(refusal([&] { check_path(lj, std::vector<int>{0, 7}, cube, frames, {}); }).empty(), false);
}

}  // namespace
}  // namespace lanescape
