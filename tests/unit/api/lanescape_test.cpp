#include <lanescape/lanescape.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "dispatch/isa.hpp"
#include "io/extended_xyz.hpp"
#include "refusal.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

using Options = LennardJonesPotential::Options;
using testing::refusal;
constexpr std::array<double, 3> cube{10.0, 10.0, 10.0};

TEST(Facade, NamesItsVersion) { EXPECT_STREQ(version(), LANESCAPE_VERSION); }

TEST(Facade, ListsTheInstructionSetsOfThisProcessor) {
  std::vector<std::string> available;
  for (const Isa isa : available_isas()) available.emplace_back(to_string(isa));
  EXPECT_EQ(instruction_sets(), available);
}

// B and A, `r` apart across a face of the box: sigma_AB = 0.8, epsilon_AB = 1.5.
LennardJonesPotential a_and_b(const Options& options = {}) { return {std::vector<int>{1, 0}, cube, options}; }
std::vector<double> apart(double r) { return {10.0 - r, 2.0, 3.0, 0.0, 2.0, 3.0}; }

TEST(LennardJonesPotential, OfTwoParticlesIsThePairPotential) {
  for (const std::string& isa : instruction_sets()) {
    SCOPED_TRACE(isa);
    LennardJonesPotential potential = a_and_b({.truncation = "plain", .isa = isa});
    const double r = 1.1, s6 = std::pow(0.8 / r, 6);
    const double slope = -24.0 * 1.5 * (2.0 * s6 * s6 - s6) / r;
    std::vector<double> forces(6, 7.0);
    double virial = 7.0;
    const double energy = potential.energy_and_forces(apart(r), forces, &virial);
    EXPECT_NEAR(energy, 4.0 * 1.5 * (s6 * s6 - s6), 1e-13);
    EXPECT_EQ(potential.energy(apart(r)), energy);
    EXPECT_EQ(potential.energy_and_forces(apart(r), forces), energy);
    EXPECT_NEAR(forces[0], slope, 1e-12);
    EXPECT_NEAR(forces[3], -slope, 1e-12);
    for (const std::size_t k : {1u, 2u, 4u, 5u}) EXPECT_EQ(forces[k], 0.0);
    EXPECT_NEAR(virial, -r * slope, 1e-12);
  }
}

TEST(LennardJonesPotential, EndsAtTheCutoffInUnitsOfSigma) {
  LennardJonesPotential potential = a_and_b({.cutoff = 1.5});
  EXPECT_LT(potential.energy(apart(1.199)), 0.0);
  EXPECT_EQ(potential.energy(apart(1.201)), 0.0);
}

// Unwrapped particles in a box shorter than twice the cutoff, with species in arbitrary order.
TEST(LennardJonesPotential, HasEnergiesForcesAndVirialsOfTheReference) {
  const Configuration configuration =
      read_frames(std::string(LANESCAPE_TEST_DATA_DIR) + "/ka_unwrapped_45.extxyz", kob_andersen()).front().configuration;
  for (const std::string truncation : {"shifted", "plain", "tail"})
    for (const std::string images : {"all", "minimum"}) {
      SCOPED_TRACE(truncation + ' ' + images);
      PairModel model = kob_andersen();
      model.truncation = parse_truncation(truncation);
      model.images = parse_image_rule(images);
      const reference::Evaluation expected = evaluate_reference(model, configuration);
      LennardJonesPotential potential(configuration.species, configuration.box.length,
                                      {.truncation = truncation, .images = images});
      std::vector<double> forces(configuration.positions.size());
      double virial = 0.0;
      EXPECT_NEAR(potential.energy_and_forces(configuration.positions, forces, &virial), expected.energy,
                  1e-12 * std::fabs(expected.energy));
      EXPECT_NEAR(virial, expected.virial, 1e-10 * std::fabs(expected.virial));
      for (std::size_t k = 0; k < forces.size(); ++k) EXPECT_NEAR(forces[k], -expected.gradient[k], 1e-9);
    }
}

TEST(LennardJonesPotential, CanBeMoved) {
  LennardJonesPotential first = a_and_b();
  const double energy = first.energy(apart(1.1));
  LennardJonesPotential second(std::move(first));
  EXPECT_EQ(second.energy(apart(1.1)), energy);
  LennardJonesPotential third = a_and_b({.cutoff = 1.5});
  third = std::move(second);
  EXPECT_EQ(third.energy(apart(1.1)), energy);
}

TEST(LennardJonesPotential, RefusesWhatItDoesNotKnow) {
  const auto refused = [](const Options& options) { return refusal([&] { a_and_b(options); }); };
  EXPECT_EQ(refused({.model = "water"}), "unknown model 'water': allowed are kob-andersen, lennard-jones");
  EXPECT_EQ(refused({.cutoff = 0.0}), "cutoff 0 is not allowed: it must be a finite number above 0 (in units of sigma_ab)");
  EXPECT_NE(refused({.truncation = "abrupt"}).find("unknown truncation 'abrupt'"), std::string::npos);
  EXPECT_EQ(refused({.images = "some"}), "unknown image rule 'some': allowed are all, minimum");
  EXPECT_NE(refused({.isa = "abacus"}).find("unknown instruction set 'abacus'"), std::string::npos);
}

TEST(LennardJonesPotential, NamesTheCoordinateThatIsNotFinite) {
  LennardJonesPotential potential(std::vector<int>{0, 0}, {10.0, 10.0, 10.0}, {.model = "lennard-jones"});
  std::vector<double> positions = {1.0, 1.0, 1.0, 2.0, std::nan(""), 1.0}, forces(6);
  const std::string expected = "y coordinate nan of particle 1 (from 0) is not allowed: it must be finite";
  EXPECT_EQ(refusal([&] { potential.energy(positions); }), expected);
  EXPECT_EQ(refusal([&] { potential.energy_and_forces(positions, forces); }), expected);
}

TEST(LennardJonesPotential, RefusesSpeciesAndBoxesThatCannotBe) {
  const auto refused = [](int species, double edge, const Options& options) {
    return refusal([&] { LennardJonesPotential(std::vector<int>{0, species}, {10.0, edge, 10.0}, options); });
  };
  EXPECT_EQ(refused(2, 10.0, {}), "species 2 is not allowed: model kob-andersen has 0 to 1");
  EXPECT_EQ(refused(-1, 10.0, {}), "species -1 is not allowed: model kob-andersen has 0 to 1");
  EXPECT_EQ(refused(1, 10.0, {.model = "lennard-jones"}), "species 1 is not allowed: model lennard-jones has 0 to 0");
  EXPECT_EQ(refused(0, 0.0, {}), "box edge 0 is not allowed: it must be from 1e-100 to 1e+100");
  EXPECT_EQ(refused(0, std::numeric_limits<double>::infinity(), {}),
            "box edge inf is not allowed: it must be from 1e-100 to 1e+100");
  EXPECT_EQ(refused(0, std::nan(""), {}), "box edge nan is not allowed: it must be from 1e-100 to 1e+100");
}

TEST(LennardJonesPotential, RefusesArraysOfAnotherLength) {
  LennardJonesPotential potential = a_and_b();
  std::vector<double> five(5, 0.0), six(6, 0.0);
  EXPECT_EQ(refusal([&] { potential.energy(five); }), "5 coordinates were given for 2 particles: 6 are needed");
  EXPECT_EQ(refusal([&] { potential.energy_and_forces(five, six); }), "5 coordinates were given for 2 particles: 6 are needed");
  EXPECT_EQ(refusal([&] { potential.energy_and_forces(six, five); }), "room for 5 force components was given: 6 are needed");
}

TEST(LennardJonesPotential, ThrowsWhatHostsCanCatch) {
  EXPECT_THROW(a_and_b({.model = "water"}), std::runtime_error);
  EXPECT_THROW(neighbour_pairs(std::vector<double>{0.0}, cube, 1.0), std::runtime_error);
}

// Two particles that are neighbours twice across the short edge, and one that is its own neighbour.
TEST(NeighbourPairs, AreOrderedAndHoldImagesOfAParticleItself) {
  const NeighbourPairs pairs = neighbour_pairs(std::vector<double>{1.0, 1.0, 1.0, 1.0, 1.0, 2.0}, {10.0, 10.0, 2.5}, 2.0);
  EXPECT_EQ(pairs.first, (std::vector<std::size_t>{0, 0, 1, 1}));
  EXPECT_EQ(pairs.second, (std::vector<std::size_t>{1, 1, 0, 0}));
  using Shift = std::array<int, 3>;
  EXPECT_EQ(pairs.shift, (std::vector<Shift>{{0, 0, -1}, {0, 0, 0}, {0, 0, 0}, {0, 0, 1}}));
  EXPECT_EQ(pairs.distance, (std::vector<double>{1.5, 1.0, 1.0, 1.5}));
  EXPECT_EQ(pairs.separation[0], (std::array<double, 3>{0.0, 0.0, -1.5}));
  const NeighbourPairs alone = neighbour_pairs(std::vector<double>{1.0, 1.0, 1.0}, {10.0, 10.0, 1.5}, 2.0);
  EXPECT_EQ(alone.first, (std::vector<std::size_t>{0, 0}));
  EXPECT_EQ(alone.second, alone.first);
  EXPECT_EQ(alone.distance, (std::vector<double>{1.5, 1.5}));
}

TEST(NeighbourPairs, RefuseWhatCannotBe) {
  const auto refused = [](std::vector<double> positions, double edge, double cutoff) {
    return refusal([&] { neighbour_pairs(positions, {10.0, edge, 10.0}, cutoff); });
  };
  EXPECT_EQ(refused({0.0, 0.0}, 10.0, 1.0), "2 coordinates were given: 3 for each particle are needed");
  EXPECT_NE(refused({0.0, 0.0, 0.0}, 0.0, 1.0).find("box edge 0 is not allowed"), std::string::npos);
  EXPECT_NE(refused({0.0, 0.0, 0.0}, 10.0, 0.0).find("cutoff 0 is not allowed"), std::string::npos);
  EXPECT_NE(refused({0.0, std::nan(""), 0.0}, 10.0, 1.0).find("coordinate nan of particle 0"), std::string::npos);
}

}  // namespace
}  // namespace lanescape
