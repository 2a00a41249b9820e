#include "configuration/particle_layout.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "refusal.hpp"

namespace lanescape {
namespace {

std::vector<double> numbered(std::size_t particles) {
  std::vector<double> coordinates(3 * particles);
  std::iota(coordinates.begin(), coordinates.end(), 1.0);  // no zeros, because padding holds zeros
  return coordinates;
}

// `count` particles of three species; the last species has none.
std::vector<int> mixed(std::size_t count) {
  std::vector<int> species;
  for (std::size_t i = 0; i < count; ++i) species.push_back(i % 5 == 3 ? 1 : 0);
  return species;
}

TEST(ParticleLayout, RefusesSpeciesThatAreNotThere) {
  EXPECT_EQ(testing::refusal([] { ParticleLayout({0, 1, 2}, 2); }),
            "particle 2: species 2 is not allowed: the model has 2, numbered from 0");
  EXPECT_EQ(testing::refusal([] { ParticleLayout({0, -1}, 2); }),
            "particle 1: species -1 is not allowed: the model has 2, numbered from 0");
}

TEST(ParticleLayout, SpeciesLieInPaddedBlocksInTheirOwnOrder) {
  const ParticleLayout layout({1, 0, 1, 0, 0}, 2);
  ASSERT_EQ(layout.blocks().size(), 2u);
  EXPECT_EQ(layout.blocks()[0].begin, 0u);
  EXPECT_EQ(layout.blocks()[0].count, 3u);
  EXPECT_EQ(layout.blocks()[1].begin, 8u);
  EXPECT_EQ(layout.blocks()[1].count, 2u);
  EXPECT_EQ(layout.size(), 5u);
  EXPECT_EQ(layout.slots(), 16u);
  EXPECT_EQ(layout.dimension(), 48u);
  const std::vector<std::size_t> expected{8, 0, 9, 1, 2};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(layout.slot_of(i), expected[i]);
}

TEST(ParticleLayout, CoordinatesAreThreeArraysOfSlots) {
  const ParticleLayout layout({1, 0}, 2);
  const AlignedArray slots = layout.to_slots(std::vector<double>{1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
  ASSERT_EQ(slots.size(), 48u);
  EXPECT_EQ(slots[8], 1.0);
  EXPECT_EQ(slots[16 + 8], 2.0);
  EXPECT_EQ(slots[32 + 8], 3.0);
  EXPECT_EQ(slots[0], 4.0);
  EXPECT_EQ(slots[16], 5.0);
  EXPECT_EQ(slots[32], 6.0);
}

class ParticleLayoutSizes : public ::testing::TestWithParam<std::size_t> {};

TEST_P(ParticleLayoutSizes, TranslateThereAndBackWithoutChange) {
  const ParticleLayout layout(mixed(GetParam()), 3);
  const std::vector<double> coordinates = numbered(GetParam());
  EXPECT_EQ(layout.to_user(layout.to_slots(coordinates)), coordinates);
}

TEST_P(ParticleLayoutSizes, GiveEveryParticleItsOwnSlotInItsBlock) {
  const std::vector<int> species = mixed(GetParam());
  const ParticleLayout layout(species, 3);
  std::set<std::size_t> taken;
  for (std::size_t i = 0; i < species.size(); ++i) {
    const auto& block = layout.blocks()[static_cast<std::size_t>(species[i])];
    EXPECT_GE(layout.slot_of(i), block.begin);
    EXPECT_LT(layout.slot_of(i), block.begin + block.count);
    taken.insert(layout.slot_of(i));
  }
  EXPECT_EQ(taken.size(), species.size());
}

TEST_P(ParticleLayoutSizes, HoldZerosInThePadding) {
  const ParticleLayout layout(mixed(GetParam()), 3);
  const AlignedArray slots = layout.to_slots(numbered(GetParam()));
  std::size_t zeros = 0;
  for (const double x : slots) zeros += x == 0.0;
  EXPECT_EQ(zeros, slots.size() - 3 * GetParam());
}

TEST_P(ParticleLayoutSizes, AreWholeVectorsOnAlignedMemory) {
  const ParticleLayout layout(mixed(GetParam()), 3);
  for (const auto& block : layout.blocks()) EXPECT_EQ(block.begin % kernels::slot_padding, 0u);
  EXPECT_EQ(layout.slots() % kernels::slot_padding, 0u);
  const AlignedArray slots = layout.to_slots(numbered(GetParam()));
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(slots.data() + axis * layout.slots()) % kernels::array_alignment, 0u);
}

INSTANTIATE_TEST_SUITE_P(Odd, ParticleLayoutSizes, ::testing::Values(1, 2, 4, 7, 8, 9, 10, 11, 40, 41, 108));

TEST(ParticleLayout, ValuesPerParticleLieInTheirSlotsAndThePaddingIsAsAsked) {
  const ParticleLayout layout({1, 0, 1}, 2);
  const AlignedArray values = layout.per_slot(std::vector<double>{5.0, 6.0, 7.0}, -1.0);
  ASSERT_EQ(values.size(), layout.slots());
  for (std::size_t slot = 0; slot < values.size(); ++slot)
    EXPECT_EQ(values[slot], slot == 0 ? 6.0 : slot == 8 ? 5.0 : slot == 9 ? 7.0 : -1.0) << slot;
}

TEST(ParticleLayout, NoParticlesTakeNoSlots) {
  const ParticleLayout layout({}, 2);
  EXPECT_EQ(layout.size(), 0u);
  EXPECT_EQ(layout.slots(), 0u);
  EXPECT_TRUE(layout.to_slots({}).empty());
  EXPECT_TRUE(layout.to_user({}).empty());
}

// Particles at random positions, some of them outside the box.
Configuration gas(std::size_t particles) {
  Configuration gas{{{20.0, 10.0, 15.0}}, mixed(particles), {}};
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> anywhere(-30.0, 30.0);
  for (std::size_t k = 0; k < 3 * particles; ++k) gas.positions.push_back(anywhere(engine));
  return gas;
}

TEST(ParticleLayout, OfFewParticlesIsInTheUsersOrderWhereverTheyAre) {
  const Configuration few = gas(ParticleLayout::sorted_from - 1);
  const ParticleLayout by_place = ParticleLayout::in_space_order(few, 3), by_number(few.species, 3);
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(by_place.slot_of(i), by_number.slot_of(i));
}

TEST(ParticleLayout, OfManyParticlesHasNearbyOnesInNearbySlotsAndEveryOneInItsSpeciesBlock) {
  const Configuration many = gas(4000);
  const ParticleLayout layout = ParticleLayout::in_space_order(many, 3);
  std::set<std::size_t> slots;
  for (std::size_t i = 0; i < many.size(); ++i) {
    const auto& block = layout.blocks()[static_cast<std::size_t>(many.species[i])];
    EXPECT_GE(layout.slot_of(i), block.begin);
    EXPECT_LT(layout.slot_of(i), block.begin + block.count);
    slots.insert(layout.slot_of(i));
  }
  EXPECT_EQ(slots.size(), many.size());
  EXPECT_EQ(layout.to_user(layout.to_slots(many.positions)), many.positions);

  // Successive slots are a fraction of the box apart; in random order they would be about 5 to 10 apart.
  const AlignedArray r = layout.to_slots(many.positions);
  double sum = 0.0;
  const std::size_t count = layout.blocks()[0].count;
  for (std::size_t slot = 1; slot < count; ++slot) {
    double squared = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      squared += std::pow(many.box.nearest_image(axis, r[axis * layout.slots() + slot] - r[axis * layout.slots() + slot - 1]), 2);
    sum += std::sqrt(squared);
  }
  EXPECT_LT(sum / static_cast<double>(count), 1.5);
}

}  // namespace
}  // namespace lanescape
