#include <lanescape/dynamics.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <lanescape/potential.hpp>

#include "refusal.hpp"

namespace lanescape {
namespace {

using testing::refusal;

// Springs of unit constant to the origin: r = cos(t / sqrt m).
class Springs final : public Landscape {
 public:
  explicit Springs(std::size_t n) : n_(n) {}
  std::size_t particles() const override { return n_; }
  double energy(std::span<const double> r) override {
    double sum = 0.0;
    for (const double x : r) sum += 0.5 * x * x;
    return sum;
  }
  double energy_and_gradient(std::span<const double> r, std::span<double> gradient) override {
    std::copy(r.begin(), r.end(), gradient.begin());
    return energy(r);
  }

 private:
  std::size_t n_;
};

TEST(MolecularDynamics, SwingsAsSpringsDo) {
  Springs springs(2);
  const std::vector<double> start = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0}, masses = {1.0, 4.0};
  MolecularDynamics dynamics(springs, masses, start, 1e-3);
  dynamics.run(1000);
  EXPECT_EQ(dynamics.steps(), 1000u);
  const std::vector<double> r = dynamics.positions(), v = dynamics.velocities();
  EXPECT_NEAR(r[0], std::cos(1.0), 1e-6);
  EXPECT_NEAR(r[4], std::cos(0.5), 1e-6);
  EXPECT_NEAR(v[0], -std::sin(1.0), 1e-6);
  EXPECT_NEAR(dynamics.potential_energy() + dynamics.kinetic_energy(), 1.0, 1e-6);
}

TEST(MolecularDynamics, GoesOnFromAStateWithTheSameBits) {
  const Start start = make_start(Model::named("kob-andersen"), 108, 1.2);
  Potential potential(Model::named("kob-andersen"), start.species, start.box);
  const auto begin = [&] { return MolecularDynamics(potential, {}, start.positions, 1e-3); };
  MolecularDynamics whole = begin();
  whole.draw_velocities(1.0, 7);
  EXPECT_NEAR(whole.temperature(), 1.0, 1e-12);
  whole.run(20);
  const std::string state = whole.state();
  whole.run(20);
  MolecularDynamics resumed = begin();
  resumed.restore(state);
  EXPECT_EQ(resumed.steps(), 20u);
  resumed.run(20);
  EXPECT_EQ(resumed.positions(), whole.positions());
  EXPECT_EQ(resumed.velocities(), whole.velocities());
  EXPECT_FALSE(refusal([&] { resumed.restore(state.substr(0, 100)); }).empty());
  EXPECT_FALSE(refusal([&] { resumed.restore("nonsense"); }).empty());
}

TEST(MolecularDynamics, RefusesWhatCannotBe) {
  Springs springs(1);
  const std::vector<double> origin(3);
  EXPECT_EQ(refusal([&] { MolecularDynamics(springs, {}, origin, 0.0); }),
            "time step 0 is not allowed: it must be finite and above 0");
  EXPECT_EQ(refusal([&] { MolecularDynamics(springs, std::vector<double>{-1.0}, origin, 1e-3); }),
            "mass -1 of particle 0 (from 0) is not allowed: it must be finite and above 0");
  MolecularDynamics dynamics(springs, {}, origin, 1e-3);
  EXPECT_EQ(refusal([&] { dynamics.set_velocities(std::vector<double>(2)); }), "2 velocity components were given: 3 are needed");
}

TEST(MolecularDynamics, RefusesTheStateOfAnotherNumberOfParticles) {
  Springs one(1), two(2);
  MolecularDynamics of_one(one, {}, std::vector<double>(3, 1.0), 1e-3), of_two(two, {}, std::vector<double>(6, 1.0), 1e-3);
  EXPECT_EQ(refusal([&] { of_one.restore(of_two.state()); }), "state: it is of 2 particles: one of 1 is needed");
}

TEST(MolecularDynamics, EndsWhereTheGradientIsNotFinite) {
  class Edge final : public Landscape {
   public:
    std::size_t particles() const override { return 2; }
    double energy(std::span<const double>) override { return 0.0; }
    double energy_and_gradient(std::span<const double> r, std::span<double> gradient) override {
      std::fill(gradient.begin(), gradient.end(), 0.0);
      gradient[4] = r[4] > 1.0 ? std::numeric_limits<double>::infinity() : 0.0;
      return 0.0;
    }
  } edge;
  MolecularDynamics dynamics(edge, {}, std::vector<double>(6), 1.0);
  dynamics.set_velocities(std::vector<double>{0.0, 0.0, 0.0, 0.0, 0.75, 0.0});
  dynamics.run(1);
  EXPECT_EQ(refusal([&] { dynamics.run(1); }),
            "landscape: gradient component inf of particle 1 (from 0) is not allowed: it must be finite");
}

TEST(EventDrivenDynamics, ExchangesTheVelocitiesOfEqualSpheres) {
  const std::vector<double> radii = {0.5, 0.5}, positions = {2.0, 5.0, 5.0, 4.0, 5.0, 5.0};
  EventDrivenDynamics dynamics(radii, {}, positions, {10.0, 10.0, 10.0});
  EXPECT_EQ(refusal([&] { dynamics.collide(1); }), "all spheres are at rest and never collide: give them velocities first");
  dynamics.set_velocities(std::vector<double>{1.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  dynamics.collide(1);
  EXPECT_EQ(dynamics.collisions(), 1u);
  EXPECT_NEAR(dynamics.time(), 1.0, 1e-14);
  EXPECT_NEAR(dynamics.positions()[0], 3.0, 1e-14);
  EXPECT_NEAR(dynamics.velocities()[3], 1.0, 1e-14);
  EXPECT_NEAR(dynamics.kinetic_energy(), 0.5, 1e-14);
  dynamics.advance_to(1.5);
  EXPECT_NEAR(dynamics.positions()[3], 4.5, 1e-14);
  EXPECT_NE(refusal([&] { dynamics.advance_to(1.0); }).find("time 1 is not allowed"), std::string::npos);
}

TEST(EventDrivenDynamics, GoesOnFromAStateWithTheSameBits) {
  const Start start = make_start(Model::named("hard-sphere-binary"), 64, 0.4);
  std::vector<double> radii;
  for (const double d : start.diameters) radii.push_back(0.5 * d);
  EventDrivenDynamics whole(radii, {}, start.positions, start.box), resumed(radii, {}, start.positions, start.box);
  whole.draw_velocities(3);
  whole.collide(500);
  resumed.restore(whole.state());
  whole.collide(500);
  resumed.collide(500);
  EXPECT_EQ(resumed.positions(), whole.positions());
  EXPECT_EQ(resumed.collisions(), 1000u);
  EXPECT_GT(whole.compressibility(), 1.0);
}

TEST(EventDrivenDynamics, TakesItsOwnLaterPositions) {
  const Start start = make_start(Model::named("hard-sphere-binary"), 64, 0.5);
  std::vector<double> radii;
  for (const double d : start.diameters) radii.push_back(0.5 * d);
  EventDrivenDynamics dynamics(radii, {}, start.positions, start.box);
  dynamics.draw_velocities(3);
  for (int k = 0; k < 100; ++k) {
    dynamics.collide(7);  // ends in contact, to rounding
    EventDrivenDynamics again(radii, {}, dynamics.positions(), start.box);
    again.set_velocities(dynamics.velocities());
    again.collide(1);
    EXPECT_NEAR(again.kinetic_energy(), 96.0, 1e-9);
  }
}

TEST(EventDrivenDynamics, EndsWhereSpheresNeverMeet) {
  const std::vector<double> radii = {0.5, 0.5}, positions = {2.0, 5.0, 5.0, 4.0, 5.0, 5.0};
  EventDrivenDynamics dynamics(radii, {}, positions, {10.0, 10.0, 10.0});
  dynamics.set_velocities(std::vector<double>{1.0, 0.0, 0.0, 1.0, 0.0, 0.0});
  EXPECT_NE(refusal([&] { dynamics.collide(1); }, ErrorCode::goal_not_reached).find("no spheres collide within 10000000 events"),
            std::string::npos);
  dynamics.set_velocities(std::vector<double>{1e200, 0.0, 0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(refusal([&] { dynamics.collide(1); }), "velocities are too large: their kinetic energy must be finite");
}

TEST(EventDrivenDynamics, RefusesOverlaps) {
  EXPECT_NE(refusal([] {
              EventDrivenDynamics(std::vector<double>{0.5, 0.5}, {}, std::vector<double>{1.0, 1.0, 1.0, 1.5, 1.0, 1.0},
                                  {9.0, 9.0, 9.0});
            }).find("particles 0 and 1 overlap: their gap is -0.5"),
            std::string::npos);
}

TEST(MakeEndPoints, OfBothFamiliesAreTheDistanceApart) {
  for (const char* name : {"lennard-jones", "hard-sphere"}) {
    SCOPED_TRACE(name);
    const Model model = Model::named(name);
    const Start start = make_start(model, 32, model.is_hard() ? 0.3 : 0.7, 5);
    double last = 0.0;
    EndPointSettings settings;
    settings.distance = 6.0;
    settings.pairs = 2;
    settings.quick = true;
    settings.equilibration = 2000;
    settings.between = 500;
    settings.temperature = 2.0;
    settings.progress = [&](double part) {
      EXPECT_GE(part, last);
      last = part;
      return true;
    };
    const std::vector<EndPoints> pairs = make_end_points(model, start, settings);
    ASSERT_EQ(pairs.size(), 2u);
    for (const EndPoints& pair : pairs) {
      EXPECT_GE(pair.distance, 6.0);
      EXPECT_LT(pair.distance, 6.5);
      EXPECT_EQ(pair.start.size(), 96u);
      EXPECT_GT(pair.time, 0.0);
    }
    settings.progress = [](double) { return false; };
    refusal([&] { make_end_points(model, start, settings); }, ErrorCode::interrupted);
    settings.threads = 0;
    EXPECT_EQ(refusal([&] { make_end_points(model, start, settings); }), "0 threads are not allowed: from 1 to 4096");
  }
}

}  // namespace
}  // namespace lanescape
