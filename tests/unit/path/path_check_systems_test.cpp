#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "configuration/pair_model.hpp"
#include "landscape/kinematic_landscape.hpp"
#include "landscape/pair_landscape.hpp"
#include "path/path_check.hpp"
#include "two_sphere_path.hpp"

namespace lanescape {
namespace {

using testing::TwoSpherePath;

constexpr double degree = std::numbers::pi / 180.0;
const Box box{{20.0, 21.0, 22.0}};
const TwoSpherePath first{3.0, 3.0, 170 * degree}, second{2.0, 3.5, 150 * degree};

// Spheres of diameter 1 of two species, whose masses may differ, soft at E_L = u(1) or hard.
PairModel mixture(double mass) {
  PairModel model = wca();
  model.species.push_back({"Kr", mass, 1.0});
  model.epsilon.assign(4, model.epsilon[0]);
  model.sigma.assign(4, model.sigma[0]);
  return model;
}

class CheckedSystem : public ::testing::TestWithParam<bool> {
 protected:
  // `position` gives the 3N coordinates of the user's order at a part of the length.
  template <class Position>
  PathCheck check(const std::vector<int>& species, double mass, std::size_t nodes, Position position) const {
    const PairModel model = mixture(mass);
    const ParticleLayout layout(species, 2);
    const KinematicMetric metric(model, layout);
    Polyline path;
    for (std::size_t k = 0; k < nodes; ++k) {
      path.push_back(layout.to_slots(position(static_cast<double>(k) / static_cast<double>(nodes - 1))));
      metric.to_kinematic(path.back());
    }
    const std::vector<double> radii(species.size(), 0.5);
    const Isa isa = choose_isa("auto");
    if (GetParam()) return check_path(HardSpherePath{box, layout, radii, metric, isa}, path);
    KinematicLandscape landscape(std::make_unique<PairLandscape>(model, box, layout, isa), metric);
    return check_path(landscape, model.derivatives(model.numbers(0), 1.0).u, path);
  }
};
INSTANTIATE_TEST_SUITE_P(Kind, CheckedSystem, ::testing::Bool(), [](const auto& tested) { return tested.param ? "hard" : "soft"; });

TEST_P(CheckedSystem, UnequalMassesHaveTheGeodesicOfTheirReducedMass) {
  constexpr double heavy = 3.0, total = 1.0 + heavy, mean = 0.5 * total, reduced = heavy / total;
  const auto at = [](double t) {  // the centre of mass is at rest
    const Point x = first.geodesic(t);
    return std::vector<double>{heavy / total * x[0], heavy / total * x[1], 0.0, -x[0] / total, -x[1] / total, 0.0};
  };
  const PathCheck found = check({0, 1}, heavy, 1001, at);
  EXPECT_NEAR(found.length, first.length() * std::sqrt(reduced / mean), 1e-5);
  EXPECT_LT(found.kuhn_tucker_residual, 0.01);
  const auto with_equal_weights = [](double t) {  // the shortest for equal masses, not for these
    const Point x = first.geodesic(t);
    return std::vector<double>{0.5 * x[0], 0.5 * x[1], 0.0, -0.5 * x[0], -0.5 * x[1], 0.0};
  };
  EXPECT_GT(check({0, 1}, heavy, 1001, with_equal_weights).kuhn_tucker_residual, 0.1);
}

TEST_P(CheckedSystem, PeriodicImagesOfParticlesChangeNothing) {
  const auto shifted = [&](double edges) {
    return check({0, 0}, 1.0, 301, [&](double t) {
      const Point x = second.geodesic(t);
      return std::vector<double>{0.5 * x[0], 0.5 * x[1], 0.0, -0.5 * x[0] + edges * 20.0, -0.5 * x[1] - 2.0 * edges * 21.0, 0.0};
    });
  };
  const PathCheck here = shifted(0.0), there = shifted(1.0);
  EXPECT_NEAR(there.length, here.length, 1e-11);
  EXPECT_NEAR(there.largest_violation, here.largest_violation, 1e-9);
  EXPECT_NEAR(there.kuhn_tucker_residual, here.kuhn_tucker_residual, 1e-7);
}

// Two pairs out of each other's reach: both geodesics at constant speed make the geodesic of the whole, with two contacts at a
// node.
std::vector<double> two_pairs(double t, const std::vector<std::size_t>& order) {
  const Point x = first.geodesic(t), y = second.geodesic(t);
  const std::vector<double> plain{0.5 * x[0],        0.5 * x[1], 0.0,  -0.5 * x[0],       -0.5 * x[1], 0.0,
                                  10.0 + 0.5 * y[0], 0.5 * y[1], 11.0, 10.0 - 0.5 * y[0], -0.5 * y[1], 11.0};
  std::vector<double> result;
  for (const std::size_t j : order) result.insert(result.end(), {plain[3 * j], plain[3 * j + 1], plain[3 * j + 2]});
  return result;
}

TEST(CheckedHardSpheres, SeveralContactsAtOnceAreFoundInAnyOrderOfParticles) {
  const std::vector<std::vector<std::size_t>> orders{{0, 1, 2, 3}, {2, 0, 3, 1}};
  for (const auto& order : orders) {
    const PairModel model = mixture(1.0);
    const ParticleLayout layout({0, 1, 0, 1}, 2);
    const KinematicMetric metric(model, layout);
    const std::vector<double> radii(4, 0.5);
    Polyline path;
    for (int k = 0; k <= 1000; ++k) path.push_back(layout.to_slots(two_pairs(k / 1000.0, order)));
    const PathCheck found = check_path(HardSpherePath{box, layout, radii, metric, choose_isa("auto")}, path);
    EXPECT_NEAR(found.length, std::hypot(first.length(), second.length()) / std::sqrt(2.0), 1e-5);
    EXPECT_LT(found.kuhn_tucker_residual, 0.01);
    // The wrong speed of one pair bends the path in the open.
    Polyline uneven;
    for (int k = 0; k <= 1000; ++k) {
      std::vector<double> positions = two_pairs(k / 1000.0, {0, 1, 2, 3}), later = two_pairs(std::pow(k / 1000.0, 2), {0, 1, 2, 3});
      std::copy_n(later.begin(), 6, positions.begin());
      uneven.push_back(layout.to_slots(positions));
    }
    EXPECT_GT(check_path(HardSpherePath{box, layout, radii, metric, choose_isa("auto")}, uneven).kuhn_tucker_residual, 0.05);
  }
}

}  // namespace
}  // namespace lanescape
