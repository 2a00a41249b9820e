#include "path/shortening/hard_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "configuration/pair_model.hpp"
#include "core/byte_archive.hpp"
#include "core/error.hpp"
#include "path/path_check.hpp"
#include "path/shortening/curve_shortening.hpp"
#include "reference/curve_shortening.hpp"
#include "small_spheres.hpp"
#include "two_sphere_path.hpp"

namespace lanescape {
namespace {

using testing::TwoSpherePath;

constexpr double degree = std::numbers::pi / 180.0;
const Point centre{3.0, -2.0, 11.0};

// Two spheres of two species, whose masses may differ, and how their paths are shortened.
struct TwoHardSpheres {
  double mass = 1.0;  // of the second
  std::vector<double> radii = {0.5, 0.5};
  std::vector<int> species = {0, 1};
  int threads = 1;
  CurveOptions options{.coarse_spacing = 0.05, .length_tolerance = 3e-5};

  Box box{{20.0, 21.0, 22.0}};
  ParticleLayout layout{species, 2};
  KinematicMetric metric{model(), layout};
  Isa isa = choose_isa("auto");
  VectorAlgebra algebra{kernel_table(isa)};

  PairModel model() const {
    PairModel result = wca();
    result.species.push_back({"Kr", mass, 1.0});
    result.epsilon.assign(4, result.epsilon[0]);
    result.sigma.assign(4, result.sigma[0]);
    return result;
  }
  HardSpherePath path() const { return {box, layout, radii, metric, isa}; }
  PathCheck check(const Polyline& nodes) const { return check_path(path(), nodes); }
  std::unique_ptr<CurveShortening> begin() const {
    return std::make_unique<CurveShortening>(algebra, std::make_unique<HardCurve>(path(), HardCurveOptions{.threads = threads}),
                                             options);
  }
  // Nodes from the separation at a part of the length. The centre of mass is at rest.
  template <class Relative>
  Polyline nodes(std::size_t count, Relative relative) const {
    Polyline result = testing::two_particle_path(layout, count, centre, relative, mass);
    for (AlignedArray& node : result) metric.to_kinematic(node);
    return result;
  }
};

void finish(CurveShortening& curve) {
  while (!curve.finished()) curve.advance();
  EXPECT_EQ(curve.reason(), "");
}

PathCheck shortened_path(const TwoHardSpheres& spheres, const Polyline& start) {
  const auto curve = spheres.begin();
  curve->begin(start);
  finish(*curve);
  const PathCheck check = spheres.check(curve->nodes());
  EXPECT_NEAR(check.length, curve->length(), 1e-12);
  EXPECT_LE(check.largest_violation, 1e-9);
  EXPECT_EQ(curve->nodes().front(), start.front());
  EXPECT_EQ(curve->nodes().back(), start.back());
  return check;
}

PathCheck shortened(const TwoHardSpheres& spheres, const Polyline& start) {
  const PathCheck check = shortened_path(spheres, start);
  EXPECT_LE(check.kuhn_tucker_residual, 1e-2);
  return check;
}

TEST(HardCurve, FindsTheGeodesicOfTwoSpheresFromTheGreedyPath) {
  const TwoHardSpheres spheres;
  for (const TwoSpherePath& example : {TwoSpherePath{3.0, 3.0, 170 * degree}, TwoSpherePath{3.0, 2.0, 150 * degree},
                                       TwoSpherePath{1.5, 4.0, 179 * degree}, TwoSpherePath{2.0, 2.0, 125 * degree}}) {
    const PathCheck check = shortened(spheres, spheres.nodes(301, [&](double t) { return example.greedy(t); }));
    EXPECT_NEAR(check.length, example.length() / std::sqrt(2.0), 1e-4 * check.length);
  }
}

// No residual is asked of these: the segment at such an end leaves the contact straight, and the node after it touches nothing.
TEST(HardCurve, FindsTheLengthOfTheGeodesicOfTwoSpheresThatTouchAtAnEnd) {
  const TwoHardSpheres spheres;
  for (const TwoSpherePath& example :
       {TwoSpherePath{3.0, 1.0, 150 * degree}, TwoSpherePath{1.0, 3.0, 150 * degree}, TwoSpherePath{1.0, 1.0, 125 * degree}}) {
    const PathCheck check = shortened_path(spheres, spheres.nodes(301, [&](double t) { return example.greedy(t); }));
    EXPECT_NEAR(check.length, example.length() / std::sqrt(2.0), 1e-4 * check.length);
  }
}

// A detour far around the other sphere, out of the plane of the geodesic.
Point detour(const TwoSpherePath& path, double t) {
  const Point on = TwoSpherePath::polar(path.a + (path.b - path.a) * t, path.angle * t);
  const double bulge = std::sin(std::numbers::pi * t);
  return {(1.0 + bulge) * on[0], (1.0 + bulge) * on[1], 0.8 * bulge};
}

TEST(HardCurve, FindsTheGeodesicOfTwoSpheresFromAFarDetour) {
  const TwoHardSpheres spheres;
  const TwoSpherePath example{3.0, 3.0, 170 * degree};
  const PathCheck check = shortened(spheres, spheres.nodes(200, [&](double t) { return detour(example, t); }));
  EXPECT_NEAR(check.length, example.length() / std::sqrt(2.0), 1e-4 * check.length);
}

TEST(HardCurve, HoldsForUnequalDiametersAndMasses) {
  const TwoHardSpheres spheres{.mass = 3.0, .radii = {0.3, 0.9}};
  const TwoSpherePath example{2.0, 3.0, 160 * degree, 1.2};
  const PathCheck check = shortened(spheres, spheres.nodes(200, [&](double t) { return detour(example, t); }));
  EXPECT_NEAR(check.length, example.length() * std::sqrt(0.75 / 2.0), 1e-4 * check.length);
}

TEST(HardCurve, StraightensAPathWhereTheStraightLineIsAllowed) {
  const TwoHardSpheres spheres;
  const Polyline bent = spheres.nodes(50, [](double t) {
    return Point{2.0 + t, 0.5 * std::sin(std::numbers::pi * t), 0.3 * std::sin(2.0 * std::numbers::pi * t)};
  });
  const PathCheck check = shortened(spheres, bent);
  EXPECT_NEAR(check.length, spheres.algebra.distance(bent.front(), bent.back()), 1e-9);
  EXPECT_EQ(check.kuhn_tucker_residual, 0.0);
}

TEST(HardCurve, FindsThePathOfTheSameLengthFromItsOtherEndAndWithParticlesSwapped) {
  const TwoHardSpheres spheres, swapped{.species = {1, 0}};
  const TwoSpherePath example{3.0, 2.0, 150 * degree};
  const Polyline start = spheres.nodes(150, [&](double t) { return detour(example, t); });
  const double length = shortened(spheres, start).length;
  EXPECT_NEAR(shortened(spheres, reversed(start)).length, length, 1e-5 * length);
  EXPECT_NEAR(shortened(swapped, swapped.nodes(150, [&](double t) { return detour(example, t); })).length, length, 1e-5 * length);
}

// The reference keeps nodes apart, but its segments cut corners, and it may end in another geodesic nearby.
TEST(HardCurve, MakesPathsOfSmallFluidsStationaryAndAboutAsShortAsTheReferenceDoes) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const testing::SmallSpheres spheres(seed);
    const auto greedy = spheres.greedy();
    const auto expected =
        reference::shorten_curve(greedy, reference::without_overlaps(spheres.pair.radii, spheres.pair.box), {.fine = 129});
    const HardSpherePath system = spheres.path();
    const VectorAlgebra algebra(kernel_table(system.isa));
    const Polyline start = spheres.in_slots(greedy);
    CurveShortening curve(algebra, std::make_unique<HardCurve>(system, HardCurveOptions{}),
                          {.coarse_spacing = 0.5, .length_tolerance = 1e-3});
    curve.begin(start);
    finish(curve);
    const PathCheck check = check_path(system, curve.nodes());
    EXPECT_LE(check.kuhn_tucker_residual, 1e-2) << seed;
    EXPECT_LE(check.largest_violation, 1e-9) << seed;
    EXPECT_LE(check.length, 1.001 * expected.length) << seed;
    EXPECT_LT(check.length, polyline_length(algebra, start)) << seed;
  }
}

TEST(HardCurve, RefusesMoreSpheresThanItsMatricesHaveMemoryFor) {
  const std::size_t count = 8000;
  const Box box{{1000.0, 1000.0, 1000.0}};
  const ParticleLayout layout(std::vector<int>(count, 0), 1);
  const KinematicMetric metric(hard_sphere(), layout);
  const std::vector<double> radii(count, 0.5);
  const HardSpherePath many{box, layout, radii, metric, choose_isa("auto")};
  try {
    HardCurve(many, {});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_NE(std::string(error.what()).find("8000 hard spheres"), std::string::npos) << error.what();
  }
}

TEST(HardCurve, HasTheSameBitsOnOneThreadAndOnTwoAndAfterResumingAtAnyIteration) {
  TwoHardSpheres spheres{.options = {.coarse_spacing = 0.2, .length_tolerance = 1e-2}};
  const TwoSpherePath example{3.0, 2.0, 150 * degree};
  const Polyline start = spheres.nodes(150, [&](double t) { return detour(example, t); });
  const auto whole = spheres.begin();
  whole->begin(start);
  finish(*whole);
  spheres.threads = 2;
  auto part = spheres.begin();
  part->begin(start);
  while (!part->finished()) {
    part->advance();
    ByteWriter writer;
    part->exchange(writer);
    const std::string bytes = writer.bytes();
    ByteReader reader(bytes);
    part = spheres.begin();
    part->exchange(reader);
  }
  EXPECT_EQ(part->nodes(), whole->nodes());
  EXPECT_EQ(part->iterations(), whole->iterations());
}

}  // namespace
}  // namespace lanescape
