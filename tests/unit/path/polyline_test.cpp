#include "path/polyline.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dispatch/isa.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

const VectorAlgebra algebra(kernel_table(choose_isa("auto")));

// Nodes with two coordinates other than 0; arrays are whole vectors.
AlignedArray node(double x, double y) {
  AlignedArray result(48, 0.0);
  result[0] = x;
  result[17] = y;
  return result;
}
const Polyline corner = {node(0, 0), node(3, 0), node(3, 4), node(3, 5)};

TEST(Polyline, HasTheSumOfItsSegmentsAsLength) {
  EXPECT_EQ(polyline_length(algebra, corner), 8.0);
  EXPECT_EQ(polyline_length(algebra, {corner[0]}), 0.0);
}

TEST(Polyline, ResampledNodesAreEquallySpacedAlongTheLengthAndKeepTheEnds) {
  const Polyline nodes = resampled(algebra, corner, 9);
  ASSERT_EQ(nodes.size(), 9u);
  EXPECT_EQ(nodes.front(), corner.front());
  EXPECT_EQ(nodes.back(), corner.back());
  for (std::size_t k = 0; k < 9; ++k) {
    const double along = static_cast<double>(k);
    EXPECT_NEAR(algebra.distance(nodes[k], along <= 3.0 ? node(along, 0.0) : node(3.0, along - 3.0)), 0.0, 1e-14) << k;
  }
  EXPECT_EQ(resampled(algebra, corner, 2).size(), 2u);
}

TEST(Polyline, ResamplingPassesOverNodesThatCoincide) {
  const Polyline nodes = resampled(algebra, {corner[0], corner[0], corner[1], corner[1]}, 4);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(algebra.distance(nodes[k], node(static_cast<double>(k), 0.0)), 0.0, 1e-14);
}

TEST(Polyline, ReversedTwiceIsTheSame) {
  EXPECT_EQ(reversed(corner).front(), corner.back());
  EXPECT_EQ(reversed(reversed(corner)), corner);
}

TEST(Polyline, TangentsAreUnitVectorsAlongTheSegments) {
  const auto tangents = chord_tangents(algebra, corner);
  ASSERT_EQ(tangents.size(), 3u);
  EXPECT_EQ(tangents[0], node(1, 0));
  EXPECT_EQ(tangents[1], node(0, 1));
  EXPECT_EQ(tangents[2], node(0, 1));
}

TEST(Polyline, RefusesNodesOfDifferentSizesAndNumbersOfNodesThatMakeNoPath) {
  Polyline uneven = corner;
  uneven[2].resize(24);
  EXPECT_NE(testing::refusal([&] { check_polyline(algebra, uneven); }).find("node 2"), std::string::npos);
  testing::refusal([&] { check_polyline(algebra, {corner[0]}); });
  testing::refusal([&] { resampled(algebra, corner, 1); });
}

}  // namespace
}  // namespace lanescape
