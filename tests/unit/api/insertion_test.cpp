#include <lanescape/insertion.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <lanescape/dynamics.hpp>
#include <lanescape/potential.hpp>

#include "refusal.hpp"

namespace lanescape {
namespace {

using testing::refusal;

struct Fluid {
  Model model = Model::named("lennard-jones");
  Start start = make_start(model, 200, 0.6, 3);
  Inserter inserter{model, start.species, start.positions, start.box};

  // The energy with one more particle, less that without.
  double rise(const std::array<double, 3>& position) const {
    std::vector<int> species = start.species;
    std::vector<double> positions = start.positions;
    Potential without(model, species, start.box);
    species.push_back(0);
    const double before = without.energy(positions);
    positions.insert(positions.end(), position.begin(), position.end());
    return Potential(model, species, start.box).energy(positions) - before;
  }
};

TEST(Inserter, KnowsByHowMuchTheEnergyRises) {
  const Fluid fluid;
  const std::array<double, 3> position = {0.4, 0.9, 0.3};
  std::array<double, 3> force{};
  const double energy = fluid.inserter.energy_and_force(position, force);
  EXPECT_NEAR(energy, fluid.rise(position), 1e-9 * std::fabs(energy));
  EXPECT_EQ(fluid.inserter.energy(position), energy);
  const double h = 1e-6;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto up = position, down = position;
    up[axis] += h;
    down[axis] -= h;
    const double slope = (fluid.inserter.energy(up) - fluid.inserter.energy(down)) / (2.0 * h);
    EXPECT_NEAR(force[axis], -slope, 1e-5 * std::fabs(slope) + 1e-6);
  }
  std::vector<double> two(2);
  fluid.inserter.energies(std::vector<double>{0.4, 0.9, 0.3, 0.4, 0.9, 0.3}, two);
  EXPECT_EQ(two, (std::vector<double>{energy, energy}));
}

TEST(Inserter, FindsAndInsertsAtTheEnergyAskedFor) {
  Fluid fluid;
  const InsertionSettings settings{.energy = -3.0, .tolerance = 1e-3};
  for (const InsertedParticle& found : fluid.inserter.find(settings, 3)) {
    ASSERT_TRUE(found.found);
    EXPECT_NEAR(found.energy, -3.0, 3e-3);
    EXPECT_NEAR(fluid.inserter.energy(found.position), found.energy, 1e-9);
  }
  EXPECT_EQ(fluid.inserter.particles(), 200u);
  const InsertedParticle inserted = fluid.inserter.insert(settings).front();
  EXPECT_NEAR(inserted.energy, fluid.rise(inserted.position), 1e-9);
  EXPECT_EQ(fluid.inserter.particles(), 201u);
  EXPECT_TRUE(fluid.inserter.remove(inserted.position));
  EXPECT_FALSE(fluid.inserter.remove(inserted.position));
  EXPECT_EQ(fluid.inserter.particles(), 200u);
}

TEST(Inserter, SearchesInARegion) {
  Fluid fluid;
  InsertionSettings settings{.energy = -3.0};
  settings.region = {{{0.0, 0.0, 0.0}, {0.5 * fluid.start.box[0], fluid.start.box[1], fluid.start.box[2]}}};
  for (const InsertedParticle& found : fluid.inserter.find(settings, 5)) EXPECT_LE(found.position[0], 0.5 * fluid.start.box[0]);
}

TEST(Inserter, RefusesWhatCannotBe) {
  Fluid fluid;
  EXPECT_NE(refusal([&] { fluid.inserter.find({.method = "hammer"}); }).find("unknown method 'hammer'"), std::string::npos);
  EXPECT_NE(refusal([&] { fluid.inserter.find({.energy = std::nan("")}); }).find("target energy nan"), std::string::npos);
  EXPECT_NE(refusal([&] { fluid.inserter.energy({0.0, std::nan(""), 0.0}); }).find("must be finite"), std::string::npos);
  EXPECT_NE(refusal([&] { fluid.inserter.add({0.0, std::nan(""), 0.0}); }).find("must be finite"), std::string::npos);
  EXPECT_EQ(
      refusal([] { Inserter(Model::named("ucg"), {}, {}, {9.0, 9.0, 9.0}); }),
      "model ucg is made of sites with states: an Inserter needs a model of a pair potential; StateSystem is for sites in states");
}

}  // namespace
}  // namespace lanescape
