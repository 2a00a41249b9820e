#include "landscape/hard_sphere_landscape.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "every_isa.hpp"

namespace lanescape {
namespace {

class HardSphereLandscapeOn : public testing::EveryIsa {
 protected:
  // Radii 0.5, 0.75 and 0.5 in a box of edge 10.
  ParticleLayout layout_{{0, 1, 0}, 2};
  AlignedArray at(const std::vector<double>& x) const {
    return layout_.to_slots(std::vector<double>{x[0], 1, 1, x[1], 1, 1, x[2], 1, 1});
  }
  HardSphereLandscape made() const { return {Box{{10.0, 10.0, 10.0}}, layout_, {0.5, 0.75, 0.5}, GetParam()}; }
};
INSTANTIATE_TEST_SUITE_P(EveryIsa, HardSphereLandscapeOn, testing::all_isas(), testing::isa_name);

TEST_P(HardSphereLandscapeOn, AllowsWhatTouchesAndNothingNearer) {
  auto landscape = made();
  EXPECT_TRUE(landscape.allowed(at({1.0, 2.25, 4.0})));
  EXPECT_EQ(landscape.violation(at({1.0, 2.25, 4.0})), 0.0);
  EXPECT_FALSE(landscape.allowed(at({1.0, 2.125, 4.0})));
  EXPECT_EQ(landscape.violation(at({1.0, 2.125, 4.0})), 0.125);
  EXPECT_FALSE(landscape.allowed(at({9.5, 5.0, 0.25})));  // across the face of the box
  EXPECT_EQ(landscape.violation(at({9.5, 5.0, 0.25})), 0.25);
}

TEST_P(HardSphereLandscapeOn, NamesContactsAndPushesThemApart) {
  auto landscape = made();
  AlignedArray force(landscape.dimension(), 0.0);
  EXPECT_EQ(landscape.find_contacts(at({1.0, 2.25, 4.0})).count, 0u);
  const ContactPairs contacts = landscape.find_contacts(at({1.0, 2.125, 4.0}));
  ASSERT_EQ(contacts.count, 1u);
  EXPECT_EQ(static_cast<std::size_t>(contacts[0].first), layout_.slot_of(0));
  EXPECT_EQ(static_cast<std::size_t>(contacts[0].second), layout_.slot_of(1));
  landscape.add_contact_forces(kernels::ContactPotential::harmonic, force);
  EXPECT_LT(force[layout_.slot_of(0)], 0.0);
  EXPECT_EQ(force[layout_.slot_of(0)], -force[layout_.slot_of(1)]);
  EXPECT_EQ(force[layout_.slot_of(2)], 0.0);
}

}  // namespace
}  // namespace lanescape
