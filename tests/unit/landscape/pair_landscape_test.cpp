#include "landscape/pair_landscape.hpp"

#include <gtest/gtest.h>

#include <string>

#include "every_isa.hpp"
#include "io/extended_xyz.hpp"
#include "memory_archive.hpp"

namespace lanescape {
namespace {

Configuration stored(const std::string& name) {
  return read_frames(std::string(LANESCAPE_TEST_DATA_DIR) + "/" + name, kob_andersen()).front().configuration;
}

class PairLandscapeOn : public testing::EveryIsa {};
INSTANTIATE_TEST_SUITE_P(EveryIsa, PairLandscapeOn, testing::all_isas(), testing::isa_name);

TEST_P(PairLandscapeOn, HasTheBitsOfThePairInteraction) {
  for (const char* file : {"ka_tiny_8.extxyz", "ka_near_contact_33.extxyz", "ka_rattled_256.extxyz"}) {
    const Configuration configuration = stored(file);
    const ParticleLayout layout(configuration.species, 2);
    PairInteraction interaction(kob_andersen(), configuration.box, layout, kernel_table(GetParam()));
    PairLandscape landscape(kob_andersen(), configuration.box, layout, GetParam());
    const AlignedArray positions = layout.to_slots(configuration.positions);
    AlignedArray expected(layout.dimension(), 0.0), gradient(expected), alone(expected), with_virial(expected);
    const PairInteraction::Evaluation sums = interaction.energy_and_gradient(positions, expected);
    EXPECT_NE(sums.energy, 0.0);
    EXPECT_EQ(landscape.energy(positions), sums.energy);
    EXPECT_EQ(landscape.energy_and_gradient(positions, gradient), sums.energy);
    EXPECT_EQ(gradient, expected);
    landscape.gradient(positions, alone);
    EXPECT_EQ(alone, expected);
    const auto [energy, virial] = landscape.energy_and_virial(positions, with_virial);
    EXPECT_EQ(energy, sums.energy);
    EXPECT_EQ(virial, sums.virial);
    EXPECT_EQ(with_virial, expected);
    EXPECT_EQ(landscape.dimension(), layout.dimension());
    EXPECT_EQ(landscape.particles(), configuration.size());
  }
}

// The particles move too little for a rebuild of the list, which determines the order of sums.
TEST(PairLandscape, HandedOnToAnotherItGoesOnWithTheSameList) {
  const Configuration configuration = stored("ka_rattled_256.extxyz");
  const ParticleLayout layout(configuration.species, 2);
  PairLandscape whole(kob_andersen(), configuration.box, layout, choose_isa("auto"));
  PairLandscape resumed(kob_andersen(), configuration.box, layout, choose_isa("auto"));
  AlignedArray positions = layout.to_slots(configuration.positions), one(positions), other(positions);
  whole.energy(positions);
  for (std::size_t k = 0; k < 100; ++k) positions[layout.slot_of(k)] += k % 2 == 0 ? 0.05 : -0.05;
  testing::hand_on(whole, resumed);
  EXPECT_EQ(resumed.energy_and_gradient(positions, other), whole.energy_and_gradient(positions, one));
  EXPECT_EQ(other, one);
}

}  // namespace
}  // namespace lanescape
