#include <lanescape/lanescape.hpp>

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "configuration/pair_model.hpp"
#include "io/extended_xyz.hpp"
#include "reference/neighbours.hpp"
#include "refusal.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

using testing::refusal;

Configuration liquid(const std::string& name) {
  return read_frames(std::string(LANESCAPE_TEST_DATA_DIR) + "/" + name, kob_andersen()).front().configuration;
}

// The lists of a host: particles first, then ghosts, images and particles of other domains, in the order in which they are met.
struct Host {
  // Particles from `first` up to `last` have lists.
  Host(const Configuration& c, double reach, std::size_t first, std::size_t last, bool half = false) {
    std::map<std::tuple<std::size_t, int, int, int>, int> numbers;
    const auto number = [&](std::size_t particle, const std::array<int, 3>& shift) {
      const auto [known, is_new] =
          numbers.try_emplace({particle, shift[0], shift[1], shift[2]}, static_cast<int>(particle_of.size()));
      if (is_new) {
        particle_of.push_back(particle);
        species.push_back(c.species[particle]);
        for (std::size_t axis = 0; axis < 3; ++axis)
          positions.push_back(c.positions[3 * particle + axis] + shift[axis] * c.box.length[axis]);
      }
      return known->second;
    };
    for (std::size_t i = first; i < last; ++i) rows.push_back(number(i, {}));
    std::vector<std::vector<int>> of_row(rows.size());
    for (const auto& pair : reference::neighbour_pairs(c.positions, c.box.length, reach)) {
      const bool is_first = pair.second > pair.first || (pair.second == pair.first && pair.shift > std::array<int, 3>{});
      if (pair.first >= first && pair.first < last && (!half || is_first))
        of_row[pair.first - first].push_back(number(pair.second, pair.shift));
    }
    lists = std::move(of_row);
    lists.resize(species.size());
    for (const auto& list : lists) {
      pointers.push_back(list.data());
      lengths.push_back(static_cast<int>(list.size()));
    }
  }
  ListsOfHost view() const { return {species, rows, pointers.data(), lengths.data()}; }
  // Of each particle, those of its ghosts added.
  std::vector<double> folded(const std::vector<double>& forces, std::size_t particles) const {
    std::vector<double> sums(3 * particles, 0.0);
    for (std::size_t k = 0; k < particle_of.size(); ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) sums[3 * particle_of[k] + axis] += forces[3 * k + axis];
    return sums;
  }

  std::vector<std::size_t> particle_of;
  std::vector<int> species, rows, lengths;
  std::vector<double> positions;
  std::vector<std::vector<int>> lists;
  std::vector<const int*> pointers;
};

struct Result {
  ListedEvaluation e;
  std::vector<double> forces, energies;
};

Result evaluate(ListedPotential& potential, const Host& host, bool stress = true) {
  Result r{{}, std::vector<double>(host.positions.size(), 7.0), std::vector<double>(host.species.size(), 7.0)};
  r.e = potential.evaluate(Vectors<const double>::interleaved(host.positions),
                           {.forces = Vectors<double>::interleaved(r.forces), .energies = r.energies, .stress = stress});
  return r;
}

Model kob_andersen_plain() { return Model::named("kob-andersen", {.truncation = "plain"}); }

PairModel reference_model() {
  PairModel model = kob_andersen();
  model.truncation = Truncation::plain;
  return model;
}

constexpr double reach = 2.8;  // cutoff and skin

void expect_reference(const Result& r, const std::vector<double>& forces, const reference::Evaluation& expected) {
  EXPECT_NEAR(r.e.energy, expected.energy, 1e-12 * std::fabs(expected.energy));
  EXPECT_NEAR(r.e.virial, expected.virial, 1e-11 * std::fabs(expected.virial));
  EXPECT_NEAR(r.e.virial_tensor[0] + r.e.virial_tensor[1] + r.e.virial_tensor[2], expected.virial,
              1e-11 * std::fabs(expected.virial));
  double sum = 0.0;
  for (const double energy : r.energies) sum += energy;
  EXPECT_NEAR(sum, expected.energy, 1e-12 * std::fabs(expected.energy));
  for (std::size_t k = 0; k < forces.size(); ++k) EXPECT_NEAR(forces[k], -expected.gradient[k], 1e-10) << k;
}

TEST(ListedPotential, HasTheReferencesEnergyForcesAndVirialForEachKindOfList) {
  for (const char* file : {"ka_melted_144.extxyz", "ka_unwrapped_45.extxyz"}) {
    const Configuration c = liquid(file);
    const reference::Evaluation expected = evaluate_reference(reference_model(), c);
    for (const std::string& isa : instruction_sets()) {
      SCOPED_TRACE(file + isa);
      for (const auto lists : {ListedPotential::Lists::rows, ListedPotential::Lists::gradient, ListedPotential::Lists::half}) {
        const Host host(c, reach, 0, c.size(), lists == ListedPotential::Lists::half);
        ListedPotential potential(kob_andersen_plain(), {.lists = lists, .instruction_set = isa});
        potential.set_lists(host.view());
        ASSERT_EQ(potential.points(), host.species.size());
        const Result r = evaluate(potential, host);
        std::vector<double> forces = host.folded(r.forces, c.size());
        expect_reference(r, forces, expected);
        const Result without_stress = evaluate(potential, host, false);
        EXPECT_EQ(without_stress.e.energy, r.e.energy);
        EXPECT_NEAR(potential.evaluate(Vectors<const double>::interleaved(host.positions), {}).energy, r.e.energy,
                    1e-13 * std::fabs(r.e.energy));
        for (std::size_t k = 3 * c.size(); lists == ListedPotential::Lists::rows && k < r.forces.size(); ++k)
          EXPECT_EQ(r.forces[k], 0.0);
      }
    }
  }
}

TEST(ListedPotential, OfOneSpeciesHasTheReferencesForcesOverHalfLists) {
  Configuration c = liquid("ka_melted_144.extxyz");
  c.species.assign(c.size(), 0);
  const reference::Evaluation expected = evaluate_reference(reference_model(), c);
  const Host host(c, reach, 0, c.size(), true);
  ListedPotential potential(kob_andersen_plain(), {.lists = ListedPotential::Lists::half, .species_of = {0}});
  ListedPotential argon(Model::named("lennard-jones", {.truncation = "plain"}), {.lists = ListedPotential::Lists::half});
  for (ListedPotential* of : {&potential, &argon}) {
    of->set_lists(host.view());
    const Result r = evaluate(*of, host);
    expect_reference(r, host.folded(r.forces, c.size()), expected);
  }
}

TEST(ListedPotential, OfTwoDomainsAddUpToTheWhole) {
  const Configuration c = liquid("ka_melted_144.extxyz");
  const reference::Evaluation expected = evaluate_reference(reference_model(), c);
  for (const auto lists : {ListedPotential::Lists::rows, ListedPotential::Lists::gradient}) {
    Result sum{{}, {}, {}};
    std::vector<double> forces(3 * c.size(), 0.0);
    for (const auto& [first, last] : {std::pair<std::size_t, std::size_t>{0, 50}, {50, c.size()}}) {
      const Host host(c, reach, first, last);
      ListedPotential potential(kob_andersen_plain(), {.lists = lists});
      potential.set_lists(host.view());
      const Result r = evaluate(potential, host);
      sum.e.energy += r.e.energy;
      sum.e.virial += r.e.virial;
      for (std::size_t k = 0; k < 6; ++k) sum.e.virial_tensor[k] += r.e.virial_tensor[k];
      sum.energies.insert(sum.energies.end(), r.energies.begin(), r.energies.end());
      const std::vector<double> folded = host.folded(r.forces, c.size());
      for (std::size_t k = 0; k < forces.size(); ++k) forces[k] += folded[k];
    }
    expect_reference(sum, forces, expected);
  }
}

TEST(ListedPotential, HasTheSlopeOfItsEnergyOnGhosts) {
  const Configuration c = liquid("ka_melted_144.extxyz");
  Host host(c, reach, 20, 60);
  ListedPotential potential(kob_andersen_plain(), {.lists = ListedPotential::Lists::gradient});
  potential.set_lists(host.view());
  const Result r = evaluate(potential, host);
  std::size_t tested = 0;
  for (std::size_t k = 3 * host.rows.size(); k < r.forces.size(); k += 71) {
    const double h = 1e-5, x = host.positions[k];
    double energies[2];
    for (const int side : {0, 1}) {
      host.positions[k] = x + (side == 0 ? -h : h);
      energies[side] = potential.evaluate(Vectors<const double>::interleaved(host.positions), {}).energy;
    }
    host.positions[k] = x;
    EXPECT_NEAR(r.forces[k], (energies[0] - energies[1]) / (2.0 * h), 1e-4 * std::max(1.0, std::fabs(r.forces[k])));
    tested += r.forces[k] != 0.0;
  }
  EXPECT_GT(tested, 5u);
}

TEST(ListedPotential, TakesTheHostsNumbersOfSpeciesAndNeighbours) {
  const Configuration c = liquid("ka_melted_144.extxyz");
  Host host(c, reach, 0, c.size());
  ListedPotential plain(kob_andersen_plain());
  plain.set_lists(host.view());
  const Result expected = evaluate(plain, host);
  for (int& s : host.species) s = s == 0 ? 3 : 1;
  for (auto& list : host.lists)
    for (int& j : list) j |= 1 << 30;
  ListsOfHost lists = host.view();
  lists.mask = 0x3FFFFFFF;
  ListedPotential potential(kob_andersen_plain(), {.species_of = {-1, 1, -1, 0}, .threads = 2});
  potential.set_lists(lists);
  const Result r = evaluate(potential, host);
  EXPECT_EQ(r.e.energy, expected.e.energy);
  EXPECT_EQ(r.forces, expected.forces);
  std::vector<double> sum = r.forces;
  potential.evaluate(Vectors<const double>::interleaved(host.positions),
                     {.energy = false, .forces = Vectors<double>::interleaved(sum), .add_to_forces = true});
  for (std::size_t k = 0; k < sum.size(); ++k) EXPECT_NEAR(sum[k], 2.0 * r.forces[k], 1e-12 * std::fabs(sum[k]));
}

TEST(ListedPotential, LeavesOutWhatInteractsWithNothing) {
  const Configuration c = liquid("ka_melted_144.extxyz");
  Configuration without = c;
  without.species.erase(without.species.begin(), without.species.begin() + 10);
  without.positions.erase(without.positions.begin(), without.positions.begin() + 30);
  const double expected = evaluate_reference(reference_model(), without).energy;
  Host host(c, reach, 0, c.size());
  for (std::size_t k = 0; k < host.species.size(); ++k)
    if (host.particle_of[k] < 10) host.species[k] = -1;
  for (const auto kind : {ListedPotential::Lists::rows, ListedPotential::Lists::gradient}) {
    ListedPotential potential(kob_andersen_plain(), {.lists = kind});
    potential.set_lists(host.view());
    EXPECT_NEAR(evaluate(potential, host).e.energy, expected, 1e-11 * std::fabs(expected));
  }
}

std::vector<int> marks(const Host& host) {
  std::vector<int> in_domain(host.species.size(), 0);
  for (const int row : host.rows) in_domain[static_cast<std::size_t>(row)] = 1;
  return in_domain;
}

TEST(DomainPotential, EqualsTheListedPotentialWhileParticlesMove) {
  Configuration c = liquid("ka_melted_144.extxyz");
  for (const std::string& isa : instruction_sets())
    for (const int threads : {1, 2}) {
      SCOPED_TRACE(isa);
      DomainPotential domain(kob_andersen_plain(), {.threads = threads, .instruction_set = isa});
      ListedPotential listed(kob_andersen_plain(), {.lists = ListedPotential::Lists::gradient});
      Host host(c, reach, 20, 90);
      domain.set_particles(host.species, marks(host));
      for (int step = 0; step < 6; ++step) {
        listed.set_lists(host.view());
        const Result expected = evaluate(listed, host);
        Result r{{}, std::vector<double>(host.positions.size(), 7.0), std::vector<double>(host.species.size(), 7.0)};
        r.e = domain.evaluate(Vectors<const double>::interleaved(host.positions),
                              {.forces = Vectors<double>::interleaved(r.forces), .energies = r.energies, .stress = step % 2 == 0});
        EXPECT_NEAR(r.e.energy, expected.e.energy, 1e-12 * std::fabs(expected.e.energy));
        EXPECT_NEAR(r.e.virial, expected.e.virial, 1e-11 * std::fabs(expected.e.virial));
        for (std::size_t k = 0; step % 2 == 0 && k < 6; ++k)
          EXPECT_NEAR(r.e.virial_tensor[k], expected.e.virial_tensor[k], 1e-11 * std::fabs(expected.e.virial));
        for (std::size_t k = 0; k < r.forces.size(); ++k) EXPECT_NEAR(r.forces[k], expected.forces[k], 1e-10);
        for (std::size_t k = 0; k < r.energies.size(); ++k) EXPECT_NEAR(r.energies[k], expected.energies[k], 1e-11);
        std::vector<double> sum = r.forces;
        domain.evaluate(Vectors<const double>::interleaved(host.positions),
                        {.energy = false, .forces = Vectors<double>::interleaved(sum), .add_to_forces = true});
        for (std::size_t k = 0; k < sum.size(); ++k) EXPECT_NEAR(sum[k], 2.0 * r.forces[k], 1e-12 * std::fabs(sum[k]));
        // Far, so that lists and the box around the particles are made again; the lists above hold all pairs within 2.8.
        for (double& x : host.positions) x += 0.03 * std::sin(1e3 * x) + 1.5 * step;
      }
    }
}

TEST(DomainPotential, TakesOtherParticles) {
  const Configuration c = liquid("ka_melted_144.extxyz");
  DomainPotential domain(kob_andersen_plain());
  EXPECT_EQ(domain.evaluate(Vectors<const double>{}, {}).energy, 0.0);
  double sum = 0.0;
  for (const auto& [first, last] : {std::pair<std::size_t, std::size_t>{0, 50}, {50, c.size()}}) {
    const Host host(c, reach, first, last);
    domain.set_particles(host.species, marks(host));
    ASSERT_EQ(domain.particles(), host.species.size());
    sum += domain.evaluate(Vectors<const double>::interleaved(host.positions), {}).energy;
  }
  const double expected = evaluate_reference(reference_model(), c).energy;
  EXPECT_NEAR(sum, expected, 1e-12 * std::fabs(expected));
  EXPECT_NE(refusal([&] {
              domain.set_particles(std::vector<int>{0, 2}, std::vector<int>{1, 1});
            }).find("species 2"),
            std::string::npos);
  EXPECT_NE(refusal([&] { domain.set_particles(std::vector<int>{0, 1}, std::vector<int>{1}); }).find("marks"), std::string::npos);
  EXPECT_NE(refusal([] { DomainPotential(Model::named("kob-andersen", {.truncation = "tail"})); }).find("plain"),
            std::string::npos);
}

TEST(ListedPotential, HasCutoffsOfTheModelInItsUnit) {
  const Model argon = Model::mixture({.species = {{"Ar"}}, .epsilon = {0.0104}, .sigma = {3.4}, .cutoff = 2.5});
  EXPECT_DOUBLE_EQ(ListedPotential(argon).cutoff(0, 0), 8.5);
  EXPECT_DOUBLE_EQ(ListedPotential(kob_andersen_plain()).cutoff(0, 1), 2.0);
}

TEST(ListedPotential, RefusesWhatItCannotDo) {
  const Configuration c = liquid("ka_melted_144.extxyz");
  Host host(c, reach, 0, 3);
  ListedPotential potential(kob_andersen_plain());
  const auto lists_refused = [&](const ListsOfHost& lists) { return refusal([&] { potential.set_lists(lists); }); };
  EXPECT_NE(refusal([] { ListedPotential(Model::named("hard-sphere-binary")); }).find("pair potential"), std::string::npos);
  EXPECT_NE(refusal([] { ListedPotential(Model::named("kob-andersen", {.truncation = "tail"})); }).find("plain"),
            std::string::npos);
  EXPECT_NE(refusal([] { ListedPotential(kob_andersen_plain(), {.species_of = {0, 2}}); }).find("species 2"), std::string::npos);
  EXPECT_NE(refusal([&] { potential.cutoff(0, 2); }).find("species 2"), std::string::npos);

  host.lists[1][4] = 100000;
  EXPECT_NE(lists_refused(host.view()).find("neighbour 100000 of point 1"), std::string::npos);
  EXPECT_EQ(potential.points(), 0u);
  host.lists[1][4] = -1;
  EXPECT_NE(lists_refused(host.view()).find("of point 1 "), std::string::npos);
  host.lists[1][4] = 0;
  host.lengths[2] = -1;
  EXPECT_NE(lists_refused(host.view()).find("length -1"), std::string::npos);
  host.lengths[2] = 0;
  host.species[5] = 2;
  EXPECT_NE(lists_refused(host.view()).find("species 2 of point 5"), std::string::npos);
  host.species[5] = 0;
  host.rows[0] = -4;
  EXPECT_NE(lists_refused(host.view()).find("point -4"), std::string::npos);
  host.rows[0] = 0;

  potential.set_lists(host.view());
  host.positions[7] = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal([&] { evaluate(potential, host); }).find("inf"), std::string::npos);
  host.positions.resize(9);
  EXPECT_NE(refusal([&] { evaluate(potential, host); }).find("needed"), std::string::npos);
}

}  // namespace
}  // namespace lanescape
