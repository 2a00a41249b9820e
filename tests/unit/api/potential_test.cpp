#include <lanescape/lanescape.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "allocations.hpp"
#include "configuration/particle_layout.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "io/extended_xyz.hpp"
#include "refusal.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

using testing::refusal;
constexpr std::array<double, 3> cube{10.0, 10.0, 10.0};

// B and A, `r` apart across a face of the box: sigma_AB = 0.8, epsilon_AB = 1.5.
Potential a_and_b(const ModelChanges& changes = {}, Potential::Options options = {}) {
  return {Model::named("kob-andersen", changes), std::vector<int>{1, 0}, cube, std::move(options)};
}
std::vector<double> apart(double r) { return {10.0 - r, 2.0, 3.0, 0.0, 2.0, 3.0}; }

TEST(Potential, OfTwoParticlesIsThePairPotential) {
  for (const std::string& isa : instruction_sets()) {
    SCOPED_TRACE(isa);
    Potential potential = a_and_b({.truncation = "plain"}, {.instruction_set = isa});
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

TEST(Potential, EndsAtTheCutoffInUnitsOfSigma) {
  Potential potential = a_and_b({.cutoff = 1.5});
  EXPECT_LT(potential.energy(apart(1.199)), 0.0);
  EXPECT_EQ(potential.energy(apart(1.201)), 0.0);
}

// Unwrapped particles in a box shorter than twice the cutoff, with species in arbitrary order.
Configuration unwrapped() {
  return read_frames(std::string(LANESCAPE_TEST_DATA_DIR) + "/ka_unwrapped_45.extxyz", kob_andersen()).front().configuration;
}

TEST(Potential, HasEnergiesForcesVirialAndStressOfTheReference) {
  const Configuration configuration = unwrapped();
  for (const std::string truncation : {"shifted", "plain", "tail"})
    for (const std::string images : {"all", "minimum"}) {
      SCOPED_TRACE(truncation + ' ' + images);
      PairModel model = kob_andersen();
      model.truncation = parse_truncation(truncation);
      model.images = parse_image_rule(images);
      const reference::Evaluation expected = evaluate_reference(model, configuration);
      Potential potential(Model::named("kob-andersen", {.truncation = truncation, .images = images}), configuration.species,
                          configuration.box.length);
      std::vector<double> forces(configuration.positions.size());
      const Evaluation e =
          potential.evaluate(configuration.positions, {.forces = Vectors<double>::interleaved(forces), .stress = true});
      EXPECT_NEAR(e.energy, expected.energy, 1e-12 * std::fabs(expected.energy));
      EXPECT_NEAR(e.virial, expected.virial, 1e-10 * std::fabs(expected.virial));
      for (std::size_t k = 0; k < forces.size(); ++k) EXPECT_NEAR(forces[k], -expected.gradient[k], 1e-9);
      for (std::size_t k = 0; k < 6; ++k)
        EXPECT_NEAR(e.stress[k], -expected.virial_tensor[k] / configuration.box.volume(), 1e-10 * std::fabs(e.stress[0]));
      EXPECT_EQ(potential.energy(configuration.positions), potential.evaluate(configuration.positions, {}).energy);
    }
}

TEST(Potential, ReadsAndWritesArraysOfXYAndZ) {
  const Configuration configuration = unwrapped();
  Potential potential(Model::named("kob-andersen"), configuration.species, configuration.box.length);
  const std::size_t n = configuration.size();
  std::vector<double> forces(3 * n), x(n), y(n), z(n), fx(n), fy(n), fz(n);
  const double energy = potential.energy_and_forces(configuration.positions, forces);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = configuration.positions[3 * i];
    y[i] = configuration.positions[3 * i + 1];
    z[i] = configuration.positions[3 * i + 2];
  }
  const auto separate = Vectors<const double>::separate(x, y, z);
  EXPECT_EQ(potential.evaluate(separate, {.forces = Vectors<double>::separate(fx, fy, fz)}).energy, energy);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(fx[i], forces[3 * i]);
    EXPECT_EQ(fy[i], forces[3 * i + 1]);
    EXPECT_EQ(fz[i], forces[3 * i + 2]);
  }
  EXPECT_EQ(refusal([&] { potential.evaluate(Vectors<const double>::separate(x, std::vector<double>(3), z), {}); }),
            "arrays of x, y and z have 45, 3 and 45 entries: as many of each are needed");
}

TEST(Potential, InAnotherBoxEqualsANewOne) {
  const Configuration configuration = unwrapped();
  Potential potential(Model::named("kob-andersen"), configuration.species, configuration.box.length);
  const double before = potential.energy(configuration.positions);
  std::array<double, 3> longer = configuration.box.length;
  longer[1] *= 1.25;
  potential.set_box(longer);
  EXPECT_EQ(potential.box(), longer);
  const double after = potential.energy(configuration.positions);
  EXPECT_NE(after, before);
  EXPECT_EQ(after, Potential(Model::named("kob-andersen"), configuration.species, longer).energy(configuration.positions));
  EXPECT_EQ(refusal([&] { potential.set_box({0.0, 1.0, 1.0}); }), "box edge 0 is not allowed: it must be from 1e-100 to 1e+100");
  EXPECT_EQ(potential.energy(configuration.positions), after);
}

TEST(Potential, GivesEachParticleHalfOfItsPairs) {
  Potential two = a_and_b({.truncation = "plain"});
  std::vector<double> halves(2);
  const double energy = two.evaluate(apart(1.1), {.energies = halves}).energy;
  for (const double half : halves) EXPECT_NEAR(half, 0.5 * energy, 1e-14);
  const Configuration configuration = unwrapped();
  Potential potential(Model::named("kob-andersen"), configuration.species, configuration.box.length);
  std::vector<double> energies(configuration.size());
  const double sum = potential.evaluate(configuration.positions, {.energies = energies}).energy;
  EXPECT_NEAR(std::accumulate(energies.begin(), energies.end(), 0.0), sum, 1e-12 * std::fabs(sum));
}

TEST(Potential, LeavesExcludedPairsOut) {
  const Configuration configuration = unwrapped();
  Potential potential(Model::named("kob-andersen"), configuration.species, configuration.box.length);
  const double all = potential.energy(configuration.positions);
  const std::vector<std::array<std::size_t, 2>> bonds = {{0, 1}, {2, 3}, {4, 40}};
  potential.set_exclusions(bonds);
  const double fewer = potential.energy(configuration.positions);
  EXPECT_EQ(Potential(potential).energy(configuration.positions), fewer);
  EXPECT_EQ(refusal([&] { potential.set_exclusions(std::vector<std::array<std::size_t, 2>>{{3, 3}}); }).empty(), false);
  EXPECT_EQ(potential.energy(configuration.positions), fewer);
  potential.set_exclusions({});
  EXPECT_NEAR(potential.energy(configuration.positions), all, 1e-10);
  Potential alone = a_and_b();
  alone.set_exclusions(std::vector<std::array<std::size_t, 2>>{{1, 0}});
  EXPECT_NEAR(alone.energy(apart(1.1)), 0.0, 1e-13);
}

TEST(ParticleMoves, ChangeTheEnergyAsFullEvaluationsSay) {
  const Configuration configuration = unwrapped();
  const Model model = Model::named("kob-andersen");
  Potential potential(model, configuration.species, configuration.box.length);
  ParticleMoves moves(model, configuration.species, configuration.positions, configuration.box.length);
  std::vector<double> positions = configuration.positions;
  double energy = potential.energy(positions);
  for (std::size_t k = 0; k < 50; ++k) {
    const std::size_t i = (7 * k) % configuration.size();
    const std::array<double, 3> to = {positions[3 * i] + 0.02, positions[3 * i + 1] - 0.03, positions[3 * i + 2] + 0.01};
    const double change = moves.energy_change(i, to);
    std::vector<double> moved = positions;
    std::copy(to.begin(), to.end(), moved.begin() + static_cast<std::ptrdiff_t>(3 * i));
    EXPECT_NEAR(change, potential.energy(moved) - energy, 1e-9);
    if (k % 2 == 0) continue;
    moves.accept();
    positions = moved;
    energy = potential.energy(positions);
  }
  EXPECT_TRUE(std::equal(positions.begin(), positions.end(), moves.positions().begin()));
  EXPECT_EQ(refusal([&] { moves.energy_change(45, {}); }), "particle 45 is not allowed: there are 45, numbered from 0");
}

TEST(Potential, OfManyParticlesTakesThemInAnyOrder) {
  const Model model = Model::named("kob-andersen");
  const Start start = make_start(model, 2048, 1.2);
  std::vector<std::size_t> shuffled(2048);
  for (std::size_t k = 0; k < shuffled.size(); ++k) shuffled[k] = (k * 773) % 2048;
  std::vector<int> species;
  std::vector<double> positions, forces(3 * 2048), x, y, z;
  for (const std::size_t i : shuffled) {
    species.push_back(start.species[i]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      positions.push_back(start.positions[3 * i + axis] + 0.05 * std::sin(static_cast<double>(3 * i + axis)));
  }
  Potential potential(model, species, start.box), copy = potential;
  const PairModel pairs = kob_andersen();
  const ParticleLayout layout(species, 2);
  PairInteraction interaction(pairs, Box{start.box}, layout, kernel_table(choose_isa("auto")));
  AlignedArray gradient(layout.dimension(), 0.0);
  const double energy = interaction.energy_and_gradient(layout.to_slots(positions), gradient).energy;
  EXPECT_NEAR(potential.energy_and_forces(positions, forces), energy, 1e-11 * std::fabs(energy));
  const std::vector<double> slopes = layout.to_user(gradient);
  for (std::size_t k = 0; k < forces.size(); ++k) EXPECT_NEAR(forces[k], -slopes[k], 1e-9);
  for (std::size_t i = 0; i < 2048; ++i) {
    x.push_back(positions[3 * i]);
    y.push_back(positions[3 * i + 1]);
    z.push_back(positions[3 * i + 2]);
  }
  EXPECT_EQ(copy.evaluate(Vectors<const double>::separate(x, y, z), {}).energy, potential.energy(positions));
}

TEST(Potential, AllocatesNothingAfterTheFirstCallOfAKind) {
  for (const char* images : {"all", "minimum"})
    for (const std::size_t particles : {108U, 1000U, 6000U})
      for (const char* precision : {"double", "mixed"}) {
        if (particles < 1000 && precision == std::string("mixed")) continue;
        for (const int threads : {1, 2}) {
          const Model model = Model::named("kob-andersen", {.images = images});
          const Start start = make_start(model, particles, 1.2);
          Potential potential(model, start.species, start.box, {.threads = threads, .precision = precision});
          std::vector<double> forces(3 * particles), energies(particles), moved = start.positions;
          const auto call = [&] {
            potential.energy(moved);
            potential.evaluate(moved, {.energies = energies});
            potential.evaluate(moved, {.forces = Vectors<double>::interleaved(forces), .stress = true});
            for (const double stretch : {1.001, 1.0}) {
              potential.set_box({stretch * start.box[0], stretch * start.box[1], stretch * start.box[2]});
              potential.energy_and_forces(moved, forces);
            }
          };
          call();
          call();
          const std::size_t before = testing::allocations();
          for (int k = 0; k < 10; ++k) call();
          EXPECT_EQ(testing::allocations(), before) << images << ' ' << particles << ' ' << precision << ' ' << threads;
        }
      }
}

TEST(Potential, CanBeMovedAndCopied) {
  Potential first = a_and_b();
  const double energy = first.energy(apart(1.1));
  Potential second(std::move(first));
  EXPECT_EQ(second.energy(apart(1.1)), energy);
  Potential third = a_and_b({.cutoff = 1.5});
  third = std::move(second);
  EXPECT_EQ(third.energy(apart(1.1)), energy);
  Potential copy = third;
  EXPECT_EQ(copy.energy(apart(1.1)), energy);
  EXPECT_EQ(third.energy(apart(1.1)), energy);
}

TEST(Potential, InMixedPrecisionIsRightToSixDigits) {
  const Configuration configuration = unwrapped();
  Potential exact(Model::named("kob-andersen"), configuration.species, configuration.box.length);
  Potential mixed(Model::named("kob-andersen"), configuration.species, configuration.box.length, {.precision = "mixed"});
  const double energy = exact.energy(configuration.positions);
  EXPECT_NEAR(mixed.energy(configuration.positions), energy, 2e-6 * std::fabs(energy));
  EXPECT_NE(mixed.energy(configuration.positions), energy);
}

TEST(Potential, RefusesWhatItDoesNotKnow) {
  EXPECT_NE(refusal([] { a_and_b({}, {.precision = "half"}); }).find("unknown precision 'half'"), std::string::npos);
  EXPECT_NE(refusal([] { a_and_b({}, {.instruction_set = "abacus"}); }).find("unknown instruction set 'abacus'"),
            std::string::npos);
  EXPECT_EQ(
      refusal([] { Potential(Model::named("hard-sphere"), std::vector<int>{0}, cube); }),
      "model hard-sphere is made of hard spheres: a Potential needs a model of a pair potential; HardSpheres is for hard spheres");
  EXPECT_EQ(refusal([] {
              Potential(Model::named("polydisperse"), std::vector<int>{0, 0}, cube, {.diameters = {1.0}});
            }),
            "1 diameters were given for 2 particles: one for each is needed");
}

TEST(Potential, NamesTheCoordinateThatIsNotFinite) {
  Potential potential(Model::named("lennard-jones"), std::vector<int>{0, 0}, cube);
  std::vector<double> positions = {1.0, 1.0, 1.0, 2.0, std::nan(""), 1.0}, forces(6);
  const std::string expected = "y coordinate nan of particle 1 (from 0) is not allowed: it must be finite";
  EXPECT_EQ(refusal([&] { potential.energy(positions); }), expected);
  EXPECT_EQ(refusal([&] { potential.energy_and_forces(positions, forces); }), expected);
}

TEST(Potential, RefusesSpeciesAndBoxesThatCannotBe) {
  const auto refused = [](int species, double edge, const char* model) {
    return refusal([&] { Potential(Model::named(model), std::vector<int>{0, species}, {10.0, edge, 10.0}); });
  };
  EXPECT_EQ(refused(2, 10.0, "kob-andersen"), "particle 1: species 2 is not allowed: the model has 2, numbered from 0");
  EXPECT_EQ(refused(-1, 10.0, "kob-andersen"), "particle 1: species -1 is not allowed: the model has 2, numbered from 0");
  for (const double edge : {0.0, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_NE(refused(0, edge, "kob-andersen").find("is not allowed: it must be from 1e-100 to 1e+100"), std::string::npos);
}

TEST(Potential, MovedFromIsRefusedUntilItIsAssignedTo) {
  Potential potential = a_and_b(), other = std::move(potential);
  const std::string message = "an object that was moved from cannot be used: assign to it first";
  EXPECT_EQ(refusal([&] { potential.energy(apart(1.0)); }), message);
  EXPECT_EQ(refusal([&] { potential.particles(); }), message);
  EXPECT_EQ(refusal([&] { Potential copy(potential); }), message);
  potential = other;
  EXPECT_EQ(potential.energy(apart(1.0)), other.energy(apart(1.0)));
  Model model = Model::named("wca");
  const Model moved = std::move(model);
  EXPECT_EQ(model, moved);
}

TEST(Potential, RefusesArraysOfAnotherLength) {
  Potential potential = a_and_b();
  std::vector<double> five(5, 0.0), six(6, 0.0);
  EXPECT_EQ(refusal([&] { potential.energy(five); }), "5 coordinates were given for 2 particles: 6 are needed");
  EXPECT_EQ(refusal([&] { potential.energy_and_forces(five, six); }), "5 coordinates were given for 2 particles: 6 are needed");
  EXPECT_EQ(refusal([&] { potential.energy_and_forces(six, five); }), "room for 5 force components was given: 6 are needed");
  EXPECT_EQ(refusal([&] { potential.energy_and_gradient(six, five); }), "room for 5 gradient components was given: 6 are needed");
  std::vector<double> energies(2, 7.0), three(3, 7.0);
  EXPECT_EQ(refusal([&] { potential.evaluate(apart(1.1), {.forces = Vectors<double>::interleaved(three), .energies = energies}); }),
            "room for 3 force components was given: 6 are needed");
  EXPECT_EQ(energies, (std::vector<double>{7.0, 7.0}));
  EXPECT_EQ(refusal([&] { Vectors<double>::interleaved(five); }), "an array of 5 numbers holds no vectors: 3 for each are needed");
  EXPECT_EQ(refusal([&] { potential.evaluate({.count = 2}, {}); }),
            "positions have a null pointer: arrays of x, y and z are needed");
  EXPECT_EQ(refusal([&] { potential.evaluate(apart(1.0), {.forces = {.x = six.data(), .count = 2}}); }),
            "forces have a null pointer: arrays of x, y and z are needed");
}

TEST(Potential, OfNoParticlesIsZero) {
  Potential nothing(Model::named("kob-andersen"), {}, cube);
  const Evaluation e = nothing.evaluate(std::span<const double>(), {.stress = true});
  EXPECT_EQ(e.energy, 0.0);
  for (const double s : e.stress) EXPECT_FALSE(std::signbit(s));
}

}  // namespace
}  // namespace lanescape
