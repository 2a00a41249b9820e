#include <lanescape/lanescape.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "dispatch/isa.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

using testing::refusal;
constexpr std::array<double, 3> cube{10.0, 10.0, 10.0};

TEST(Facade, NamesItsVersion) { EXPECT_STREQ(version(), LANESCAPE_VERSION); }

TEST(Facade, ListsTheInstructionSetsOfThisProcessor) {
  std::vector<std::string> available;
  for (const Isa isa : available_isas()) available.emplace_back(to_string(isa));
  EXPECT_EQ(instruction_sets(), available);
}

TEST(Facade, ThrowsWhatHostsCanCatch) {
  EXPECT_THROW(Model::named("water"), std::runtime_error);
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
