#include "interaction/sphere/segment_gaps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "every_isa.hpp"

namespace lanescape {
namespace {

// Spheres of three sizes at random in a small box, that may overlap.
struct Spheres {
  Box box{{4.0, 5.0, 6.0}};
  ParticleLayout layout;
  std::vector<double> radii, from, to;

  Spheres(std::size_t n, double largest_move, unsigned seed) : layout(std::vector<int>(n, 0), 1), from(3 * n), to(3 * n) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> anywhere(-10.0, 10.0), move(-largest_move, largest_move);
    for (std::size_t k = 0; k < n; ++k) radii.push_back(0.2 + 0.1 * static_cast<double>(k % 3));
    for (std::size_t k = 0; k < 3 * n; ++k) to[k] = (from[k] = anywhere(engine)) + move(engine);
  }
  // The smallest gap of i and j at a part of the move, all images.
  double gap(std::size_t i, std::size_t j, double t) const {
    double squared = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t a = 3 * i + axis, b = 3 * j + axis;
      const double d = from[b] + t * (to[b] - from[b]) - from[a] - t * (to[a] - from[a]);
      double least = std::numeric_limits<double>::infinity();
      for (int n = -20; n <= 20; ++n) least = std::min(least, std::abs(d + n * box.length[axis]));
      squared += least * least;
    }
    return std::sqrt(squared) - (radii[i] + radii[j]);
  }
  double sampled_gap(std::size_t i, std::size_t j) const {
    double least = std::numeric_limits<double>::infinity();
    for (int s = 0; s <= 2000; ++s) least = std::min(least, gap(i, j, s / 2000.0));
    return least;
  }
};

class SegmentGapsOn : public testing::EveryIsa {
 protected:
  std::vector<Approach> below(const Spheres& spheres, double reach) const {
    HardSphereOverlap overlap(spheres.box, spheres.layout, spheres.radii, kernel_table(GetParam()));
    return SegmentGaps(overlap).below(spheres.layout.to_slots(spheres.from), spheres.layout.to_slots(spheres.to), reach);
  }
};
INSTANTIATE_TEST_SUITE_P(EveryIsa, SegmentGapsOn, testing::all_isas(), testing::isa_name);

TEST_P(SegmentGapsOn, FindsTheClosestApproachOfEachPairThatSamplesFind) {
  for (const double move : {0.0, 0.05, 1.0, 9.0}) {  // up to several boxes
    const Spheres spheres(12, move, 3);
    const auto found = below(spheres, 0.3);
    for (std::size_t i = 0; i < 12; ++i)
      for (std::size_t j = i + 1; j < 12; ++j) {
        double least = std::numeric_limits<double>::infinity();
        for (const Approach& approach : found) {
          if (static_cast<std::size_t>(approach.first) == i && static_cast<std::size_t>(approach.second) == j)
            least = std::min(least, approach.gap);
        }
        const double sampled = spheres.sampled_gap(i, j);
        const double coarse = 2.0 * std::sqrt(12.0) * move / 2000.0;  // of the samples
        if (sampled < 0.3) {
          EXPECT_LE(least, sampled + 1e-12);
          EXPECT_GE(least, sampled - coarse - 1e-12);
        } else {
          EXPECT_GE(least, 0.3 - coarse);
        }
      }
  }
}

TEST_P(SegmentGapsOn, FractionAndSeparationAreThoseOfTheApproach) {
  const Spheres spheres(40, 1.0, 5);
  const auto found = below(spheres, 0.2);
  ASSERT_GT(found.size(), 5u);
  for (const Approach& approach : found) {
    const auto i = static_cast<std::size_t>(approach.first), j = static_cast<std::size_t>(approach.second);
    double squared = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t a = 3 * i + axis, b = 3 * j + axis;
      const double t = approach.fraction;
      const double d = spheres.from[b] + t * (spheres.to[b] - spheres.from[b]) - spheres.from[a] -
                       t * (spheres.to[a] - spheres.from[a]) + approach.image[axis] * spheres.box.length[axis];
      EXPECT_NEAR(approach.separation[axis], d, 1e-12);
      squared += d * d;
    }
    EXPECT_NEAR(approach.gap, std::sqrt(squared) - spheres.radii[i] - spheres.radii[j], 1e-12);
    EXPECT_GE(approach.fraction, 0.0);
    EXPECT_LE(approach.fraction, 1.0);
  }
}

TEST_P(SegmentGapsOn, SeesASphereThatPassesThroughAnotherAcrossTheFaceOfTheBox) {
  Spheres spheres(2, 0.0, 1);
  spheres.radii = {0.5, 0.5};
  spheres.from = {0.2, 1.0, 1.0, 3.0, 1.0, 1.0};
  spheres.to = {0.2, 1.0, 1.0, 5.5, 1.0, 1.0};  // through x = 4.2, the image of the first
  const auto found = below(spheres, 0.0);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].gap, -1.0);
  EXPECT_EQ(found[0].image, (std::array<std::int32_t, 3>{-1, 0, 0}));
  EXPECT_NEAR(found[0].fraction, 1.2 / 2.5, 1e-15);
}

}  // namespace
}  // namespace lanescape
