#include "reference/neighbours.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace lanescape::reference {
namespace {

// Two particles that are neighbours twice across the short edge; each is its own neighbour beyond the cutoff only.
TEST(ReferenceNeighbours, AreFoundFromBothEndsWithTheirShifts) {
  const auto pairs = neighbour_pairs(std::vector<double>{1.0, 1.0, 1.0, 11.0, 1.0, 2.0}, {10.0, 10.0, 2.5}, 2.0);
  ASSERT_EQ(pairs.size(), 4u);
  EXPECT_EQ(pairs[0].shift, (std::array<int, 3>{-1, 0, -1}));
  EXPECT_EQ(pairs[0].separation, (Vector{0.0, 0.0, -1.5}));
  EXPECT_EQ(pairs[1].shift, (std::array<int, 3>{-1, 0, 0}));
  EXPECT_EQ(pairs[1].distance, 1.0);
  EXPECT_EQ(pairs[2].first, 1u);
  EXPECT_EQ(pairs[3].shift, (std::array<int, 3>{1, 0, 1}));
}

TEST(ReferenceNeighbours, OfAParticleAreItsImagesNearerThanTheCutoff) {
  const auto pairs = neighbour_pairs(std::vector<double>{7.0, -1.0, 0.0}, {1.0, 5.0, 5.0}, 2.0);
  ASSERT_EQ(pairs.size(), 2u);  // at 2 boxes the distance is the cutoff itself
  EXPECT_EQ(pairs[0].shift, (std::array<int, 3>{-1, 0, 0}));
  EXPECT_EQ(pairs[1].separation, (Vector{1.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace lanescape::reference
