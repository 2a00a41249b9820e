#include "interaction/sphere/check_overlap.hpp"
#include "interaction/sphere/hard_sphere_list.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "configuration/hard_sphere_model.hpp"
#include "configuration/lattice.hpp"
#include "core/error.hpp"
#include "core/random.hpp"
#include "dispatch/isa.hpp"

namespace lanescape {
namespace {

const kernels::KernelTable& best_table() { return kernel_table(available_isas().back()); }

// Spheres of radius 1/2 in a row along x in a box of edge 10, all of one species: slot numbers are particle numbers.
struct Row {
  Box box{{10.0, 10.0, 10.0}};
  std::vector<double> x;
  ParticleLayout layout;
  HardSphereOverlap spheres;

  explicit Row(std::vector<double> at, double radius = 0.5)
      : x(std::move(at)),
        layout(std::vector<int>(x.size(), 0), 1),
        spheres(box, layout, std::vector<double>(x.size(), radius), best_table()) {}
  AlignedArray positions() const {
    AlignedArray array(layout.dimension(), 0.0);
    std::copy(x.begin(), x.end(), array.begin());
    return array;
  }
};

TEST(HardSphereOverlap, TouchingSpheresDoNotOverlap) {
  EXPECT_FALSE(Row({0.0, 1.0}).spheres.any_overlap(Row({0.0, 1.0}).positions()));
  EXPECT_TRUE(Row({0.0, 1.0}).spheres.any_overlap(Row({0.0, std::nextafter(1.0, 0.0)}).positions()));
}

TEST(HardSphereOverlap, PositionsThatAreNotFiniteAreRefused) {
  for (const Isa isa : available_isas())
    for (const auto search : {SpherePairSearch::all_pairs, SpherePairSearch::cells})
      for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        Row row({0.0, 2.0, 4.0});
        HardSphereOverlap spheres(row.box, row.layout, {0.5, 0.5, 0.5}, kernel_table(isa), search);
        HardSphereList list(spheres, 0.1);
        EXPECT_FALSE(list.any_overlap(row.positions()));
        row.x[1] = bad;
        EXPECT_THROW(spheres.any_overlap(row.positions()), Error) << to_string(isa) << " " << bad;
        EXPECT_THROW(spheres.smallest_gap(row.positions()), Error) << to_string(isa) << " " << bad;
        EXPECT_THROW(spheres.pairs_within(row.positions(), 0.1), Error) << to_string(isa) << " " << bad;
        EXPECT_THROW(list.any_overlap(row.positions()), Error) << to_string(isa) << " " << bad;
      }
}

TEST(HardSphereOverlap, SmallestGapIsThatOfTheNearestImages) {
  Row row({0.5, 3.0, 9.0});
  EXPECT_EQ(row.spheres.smallest_gap(row.positions()), 0.5);
  Row deep({0.5, 3.0, 9.75});
  EXPECT_EQ(deep.spheres.smallest_gap(deep.positions()), -0.25);
}

TEST(HardSphereOverlap, ASingleSphereHasNoGapAndNoOverlap) {
  Row row({2.0});
  EXPECT_EQ(row.spheres.smallest_gap(row.positions()), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(row.spheres.any_overlap(row.positions()));
  EXPECT_TRUE(row.spheres.pairs_within(row.positions(), 1.0).empty());
}

TEST(HardSphereOverlap, PairsWithinAreThoseNearerThanContactAndReach) {
  Row row({0.0, 1.25, 3.0, 9.5});
  const auto& pairs = row.spheres.pairs_within(row.positions(), 0.5);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_TRUE(pairs[0].first == 0 && pairs[0].second == 1);
  EXPECT_TRUE(pairs[1].first == 0 && pairs[1].second == 3);
}

TEST(HardSphereOverlap, PairsWithinFindsRoomForMoreThanItExpected) {
  Row row(std::vector<double>(200, 1.0));
  EXPECT_EQ(row.spheres.pairs_within(row.positions(), 0.0).size(), 200U * 199U / 2U);
  EXPECT_EQ(row.spheres.pairs_within(Row(std::vector<double>(200, 2.0)).positions(), 0.0).size(), 200U * 199U / 2U);
}

// Mixed radii up to `largest`, alternating species, positions up to two boxes away.
Configuration random_spheres(std::size_t n, const Box& box, double largest, std::uint64_t which) {
  const CounterRandom random(7, RandomStream::displacements);
  Configuration spheres{box, {}, {}, {}};
  for (std::uint32_t i = 0; i < n; ++i) {
    spheres.species.push_back(static_cast<int>(i % 3));
    spheres.radii.push_back(largest / (1.0 + i % 3));
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      spheres.positions.push_back(box.length[axis] * (4.0 * random.uniform(which, i, axis) - 2.0));
  }
  return spheres;
}

// Spheres of diameter 1 on a simple cubic lattice of spacing 1: each touches six others, and rounding decides which of them
// overlap.
Configuration touching_spheres(std::size_t edge, double shift) {
  Configuration spheres{{{edge + 0.0, edge + 0.0, edge + 0.0}}, std::vector<int>(edge * edge * edge, 0), {}, {}};
  spheres.radii.assign(spheres.size(), 0.5);
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (const std::size_t at : {i % edge, i / edge % edge, i / edge / edge})
      spheres.positions.push_back(static_cast<double>(at) + shift * (1.0 + 1e-3 * static_cast<double>(i)));
  return spheres;
}

void expect_same_by_cells_and_all_pairs(const Configuration& spheres) {
  const ParticleLayout layout(spheres.species, 3);
  const AlignedArray positions = layout.to_slots(spheres.positions);
  for (const Isa isa : available_isas()) {
    HardSphereOverlap all(spheres.box, layout, spheres.radii, kernel_table(isa), SpherePairSearch::all_pairs);
    HardSphereOverlap cells(spheres.box, layout, spheres.radii, kernel_table(isa), SpherePairSearch::cells);
    EXPECT_EQ(cells.any_overlap(positions), all.any_overlap(positions));
    EXPECT_EQ(cells.smallest_gap(positions), all.smallest_gap(positions));
    for (const double reach : {0.0, 0.01, 0.5}) {
      const auto &found = cells.pairs_within(positions, reach), &wanted = all.pairs_within(positions, reach);
      const auto same = [](const auto& a, const auto& b) { return a.first == b.first && a.second == b.second; };
      EXPECT_TRUE(std::equal(found.begin(), found.end(), wanted.begin(), wanted.end(), same))
          << found.size() << " and " << wanted.size() << " pairs, reach " << reach << ", " << to_string(isa);
    }
  }
}

TEST(HardSphereOverlap, CellsFindThePairsOfAllPairsInTheSameOrder) {
  for (const Box& box : {Box{{12.0, 12.0, 12.0}}, Box{{5.0, 9.0, 30.0}}, Box{{3.1, 40.0, 6.0}}, Box{{20.0, 2.2, 2.3}}})
    for (const double largest : {0.55, 0.3, 0.02})
      for (const std::size_t n : {1U, 2U, 17U, 300U, 901U}) expect_same_by_cells_and_all_pairs(random_spheres(n, box, largest, n));
}

TEST(HardSphereOverlap, CellsDecideOnTouchingSpheresAsAllPairsDo) {
  for (const std::size_t edge : {3U, 4U, 9U})
    for (const double shift : {0.0, 0.1, -7.3, 1e5}) expect_same_by_cells_and_all_pairs(touching_spheres(edge, shift));
}

TEST(HardSphereOverlap, CellsFindTheSmallestGapOfFewSpheresFarApart) {
  expect_same_by_cells_and_all_pairs(random_spheres(2, {{1000.0, 900.0, 800.0}}, 0.01, 1));
  expect_same_by_cells_and_all_pairs(random_spheres(40, {{1000.0, 900.0, 800.0}}, 0.01, 2));
}

TEST(HardSphereList, IsMadeAnewOnlyWhenAParticleIsHalfASkinAway) {
  Row row({0.0, 1.2, 3.0, 5.0});
  HardSphereList list(row.spheres, 0.1);
  EXPECT_FALSE(list.any_overlap(row.positions()));
  EXPECT_EQ(list.rebuilds(), 1U);
  row.x = {0.049, 1.151, 3.049, 4.951};
  EXPECT_FALSE(list.any_overlap(row.positions()));
  EXPECT_EQ(list.rebuilds(), 1U);
  row.x[2] = 3.051;
  EXPECT_FALSE(list.any_overlap(row.positions()));
  EXPECT_EQ(list.rebuilds(), 2U);
  row.x[0] = 4.0;
  EXPECT_TRUE(list.any_overlap(row.positions()));
  EXPECT_EQ(list.rebuilds(), 3U);
}

TEST(HardSphereList, HoldsThePairsWithinItsSkin) {
  Row row({0.0, 1.05, 2.2});
  HardSphereList list(row.spheres, 0.1);
  list.any_overlap(row.positions());
  EXPECT_EQ(list.pairs(), kernels::slot_padding);  // one pair, padded
  HardSphereList wider(row.spheres, 0.2);
  wider.any_overlap(row.positions());
  EXPECT_EQ(wider.find_contacts(row.positions()).count, 0U);
}

TEST(HardSphereList, NamesOverlappingPairs) {
  Row row({0.0, 1.25, 2.0, 6.0, 9.25});
  HardSphereList list(row.spheres, 0.3);
  const ContactPairs contacts = list.find_contacts(row.positions());
  ASSERT_EQ(contacts.count, 2U);
  EXPECT_TRUE(contacts[0].first == 0 && contacts[0].second == 4);
  EXPECT_TRUE(contacts[1].first == 1 && contacts[1].second == 2);
}

TEST(HardSphereList, ForcesPushApartWithTheDepthOfTheOverlap) {
  Row row({0.0, 0.75});
  HardSphereList list(row.spheres, 0.3);
  ASSERT_EQ(list.find_contacts(row.positions()).count, 1U);
  AlignedArray force(row.layout.dimension(), 0.0);
  list.add_contact_forces(kernels::ContactPotential::harmonic, force);
  EXPECT_EQ(force[0], -0.25);
  EXPECT_EQ(force[1], 0.25);
  list.add_contact_forces(kernels::ContactPotential::linear, force);  // adds to `force`
  EXPECT_EQ(force[0], -1.25);
}

// Two images of one pair can be within reach of a list whose skin is too large for the box.
TEST(HardSphereList, SeesTheOtherImageOfAPairInABoxOfTwiceTheDiameter) {
  Row row({0.0, 4.99}, 2.5);
  HardSphereList list(row.spheres, 1.0);
  row.x[1] = 5.0;
  EXPECT_FALSE(list.any_overlap(row.positions()));  // it touches on both sides
  row.x[1] = 5.2;
  EXPECT_TRUE(list.any_overlap(row.positions()));
  row.x[1] = 4.8;
  EXPECT_TRUE(list.any_overlap(row.positions()));
}

// Compares everything that a path uses of the list: with these, a path has the same bits with any search.
TEST(HardSphereList, HasTheSameContactsAndForcesToTheBitByCellsAndAllPairs) {
  const Configuration start = hard_sphere_start(hard_sphere_binary(), 2000, 0.49, Arrangement::random, 1);
  const ParticleLayout layout(start.species, 2);
  for (const Isa isa : available_isas()) {
    HardSphereOverlap all(start.box, layout, start.radii, kernel_table(isa), SpherePairSearch::all_pairs);
    HardSphereOverlap cells(start.box, layout, start.radii, kernel_table(isa), SpherePairSearch::cells);
    HardSphereList by_all_pairs(all, 0.01), by_cells(cells, 0.01);
    const CounterRandom random(9, RandomStream::displacements);
    std::vector<double> positions = start.positions;
    for (std::uint32_t move = 0; move < 20; ++move) {
      for (std::uint32_t k = 0; k < positions.size(); ++k) positions[k] += 0.02 * (random.uniform(move, k) - 0.5);
      const AlignedArray at = layout.to_slots(positions);
      const ContactPairs wanted = by_all_pairs.find_contacts(at), found = by_cells.find_contacts(at);
      ASSERT_EQ(found.count, wanted.count);
      for (std::size_t k = 0; k < found.count; ++k)
        EXPECT_TRUE(found[k].first == wanted[k].first && found[k].second == wanted[k].second);
      AlignedArray expected(layout.dimension(), 0.0), force(layout.dimension(), 0.0);
      by_all_pairs.add_contact_forces(kernels::ContactPotential::harmonic, expected);
      by_cells.add_contact_forces(kernels::ContactPotential::harmonic, force);
      EXPECT_EQ(force, expected);
    }
    EXPECT_EQ(by_cells.rebuilds(), by_all_pairs.rebuilds());
    EXPECT_GT(by_cells.rebuilds(), 5U);
  }
}

std::string refusal(const Configuration& configuration) {
  try {
    check_no_overlap(configuration, best_table());
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    return error.what();
  }
  return "nothing was refused";
}

TEST(CheckNoOverlap, TakesSpheresThatTouch) {
  EXPECT_EQ(refusal({{{4.0, 4.0, 4.0}}, {0, 0, 1}, {0, 0, 0, 1, 0, 0, 3, 0, 0}, {0.5, 0.5, 0.5}}), "nothing was refused");
}

TEST(CheckNoOverlap, NamesTheDeepestPairInTheUsersOrderAndTheNumberOfPairs) {
  // In order of species the second particle would be last.
  EXPECT_EQ(refusal({{{8.0, 8.0, 8.0}}, {0, 1, 0, 0}, {0, 0, 0, 3, 0, 0, 0.75, 0, 0, 3.5, 8.0, 0}, {0.5, 0.5, 0.5, 0.5}}),
            "particles 1 and 3 overlap by 0.5: spheres may touch but not overlap (2 such pairs)");
}

TEST(CheckNoOverlap, NamesTheEdgeThatIsTooShort) {
  EXPECT_EQ(refusal({{{8.0, 2.5, 8.0}}, {0, 0}, {0, 0, 0, 3, 0, 0}, {0.5, 0.75}}),
            "box edge 2.5 along axis 2 is not allowed: at least twice the largest diameter 1.5 is needed");
}

}  // namespace
}  // namespace lanescape
