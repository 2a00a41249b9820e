#include "interaction/hard_sphere.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "dispatch/isa.hpp"

namespace lanescape {
namespace {

const kernels::KernelTable& best_table() { return kernel_table(available_isas().back()); }

// Spheres of radius 1/2 in a row along x in a box of edge 10, all of one species: slots are particles.
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
  list.add_contact_forces(kernels::ContactPotential::linear, force);  // adds
  EXPECT_EQ(force[0], -1.25);
}

// Two images of one pair can be in reach of a list whose skin does not fit the box.
TEST(HardSphereList, SeesTheOtherImageOfAPairInABoxOfTwiceTheDiameter) {
  Row row({0.0, 4.99}, 2.5);
  HardSphereList list(row.spheres, 1.0);
  row.x[1] = 5.0;
  EXPECT_FALSE(list.any_overlap(row.positions()));  // it touches on either side
  row.x[1] = 5.2;
  EXPECT_TRUE(list.any_overlap(row.positions()));
  row.x[1] = 4.8;
  EXPECT_TRUE(list.any_overlap(row.positions()));
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
  // By species the second particle would come last.
  EXPECT_EQ(refusal({{{8.0, 8.0, 8.0}}, {0, 1, 0, 0}, {0, 0, 0, 3, 0, 0, 0.75, 0, 0, 3.5, 8.0, 0}, {0.5, 0.5, 0.5, 0.5}}),
            "particles 1 and 3 overlap by 0.5: spheres may touch but not overlap (2 such pairs)");
}

TEST(CheckNoOverlap, NamesTheEdgeThatIsTooShort) {
  EXPECT_EQ(refusal({{{8.0, 2.5, 8.0}}, {0, 0}, {0, 0, 0, 3, 0, 0}, {0.5, 0.75}}),
            "box edge 2.5 along axis 2 is not allowed: at least twice the largest diameter 1.5 is needed");
}

}  // namespace
}  // namespace lanescape
