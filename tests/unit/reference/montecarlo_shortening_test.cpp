#include "reference/montecarlo_shortening.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "reference/hard_sphere.hpp"
#include "shortening_systems.hpp"

namespace {

using namespace lanescape::reference;

class ReferenceTrials : public ::testing::TestWithParam<bool> {
 protected:
  FindPath find() const {
    AvoidanceOptions hard;
    hard.avoidance_step = 1e-3;
    GeodesicOptions soft;
    soft.step = 0.01;
    soft.landscape_energy = -1.0;
    return GetParam() ? hard_paths(kTwo, kBox, hard) : soft_paths(kNearness, kSlope, Method::contour, soft);
  }
  static bool allowed(const Point& x) { return apart(x) >= 1.0; }
  OptimisedPath optimise(const Point& start, const Point& finish, unsigned seed) const {
    std::mt19937_64 engine(seed);
    return optimise_path(start, finish, find(), allowed, [&] { return std::generate_canonical<double, 53>(engine); });
  }
};
INSTANTIATE_TEST_SUITE_P(Kind, ReferenceTrials, ::testing::Bool(),
                         [](const auto& tested) { return tested.param ? "hard" : "soft"; });

TEST_P(ReferenceTrials, ComeNearTheGeodesicOfTwoSpheresWithinTheAllowedRegion) {
  for (const Around& around : kAround) {
    double best = 1e9;
    long accepted = 0;
    const double before = find()(around.start(), around.finish()).length;
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const OptimisedPath found = optimise(around.start(), around.finish(), seed);
      EXPECT_LE(found.path.length, before);
      EXPECT_GE(found.trials, found.accepted + 5);  // five failures in a row end it
      EXPECT_EQ(found.path.steps.front(), around.start());
      EXPECT_EQ(found.path.steps.back(), around.finish());
      double length = 0.0;
      for (std::size_t k = 1; k < found.path.steps.size(); ++k) {
        EXPECT_TRUE(allowed(found.path.steps[k]));
        length += distance(found.path.steps[k - 1], found.path.steps[k]);
      }
      EXPECT_NEAR(length, found.path.length, 1e-9);
      best = std::min(best, found.path.length);
      accepted += found.accepted;
    }
    EXPECT_GT(accepted, 0);
    EXPECT_GE(best, around.shortest() * (1.0 - 1e-5));
    EXPECT_LT(best, around.shortest() * 1.03);
  }
}

TEST_P(ReferenceTrials, CannotShortenAStraightLine) {
  const Point from{1.0, 2.0, 0.0, 4.0, 1.0, 0.0}, to{1.3, 3.1, -0.4, 3.8, 1.7, 0.9};
  const OptimisedPath found = optimise(from, to, 1);
  EXPECT_EQ(found.trials, 5);
  EXPECT_EQ(found.accepted, 0);
  EXPECT_NEAR(found.path.length, distance(from, to), 1e-12);
}

TEST_P(ReferenceTrials, FollowTheirRandomNumbers) {
  const Around& around = kAround.front();
  const double first = optimise(around.start(), around.finish(), 1).path.length;
  EXPECT_EQ(optimise(around.start(), around.finish(), 1).path.length, first);
  EXPECT_NE(optimise(around.start(), around.finish(), 2).path.length, first);
}

TEST_P(ReferenceTrials, NeedAPathToStartFrom) {
  EXPECT_THROW(optimise(two_spheres(2.0, 0.0), two_spheres(0.5, 1.0), 1), std::invalid_argument);
}

}  // namespace
