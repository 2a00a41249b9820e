#include "observables/radial_distribution.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "configuration/lattice.hpp"
#include "configuration/pair_model.hpp"
#include "core/random.hpp"

namespace lanescape {
namespace {

Configuration random_mixture(std::size_t n, const Box& box) {
  const CounterRandom random(3, RandomStream::displacements);
  Configuration mixture{box, {}, {}};
  for (std::uint32_t i = 0; i < n; ++i) {
    mixture.species.push_back(i % 5 == 0);
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      mixture.positions.push_back(box.length[axis] * (3.0 * random.uniform(0, i, axis) - 1.0));
  }
  return mixture;
}

// Pairs per bin by brute force over all pairs.
std::vector<double> pairs_per_bin(const Configuration& c, int a, int b, std::size_t bins, double range) {
  std::vector<double> counts(bins, 0.0);
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t j = i + 1; j < c.size(); ++j) {
      if (std::minmax(c.species[i], c.species[j]) != std::minmax(a, b)) continue;
      double r2 = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        r2 += std::pow(c.box.nearest_image(axis, c.positions[3 * j + axis] - c.positions[3 * i + axis]), 2);
      const double bin = std::floor(std::sqrt(r2) / (range / static_cast<double>(bins)));
      if (bin < static_cast<double>(bins)) ++counts[static_cast<std::size_t>(bin)];
    }
  return counts;
}

void expect_all_pairs(const Configuration& c, double range) {
  constexpr std::size_t bins = 40;
  const ParticleLayout layout(c.species, 2);
  RadialDistribution g(c.box, layout, bins, range);
  g.add(layout.to_slots(c.positions));
  const double n[2] = {static_cast<double>(layout.blocks()[0].count), static_cast<double>(layout.blocks()[1].count)};
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      const auto wanted = pairs_per_bin(c, a, b, bins, range);
      for (std::size_t bin = 0; bin < bins; ++bin) {
        const double inner = range / bins * static_cast<double>(bin), outer = inner + range / bins;
        const double pairs = a == b ? 0.5 * n[a] * (n[a] - 1.0) : n[a] * n[b];
        const double ideal = pairs * 4.0 / 3.0 * std::numbers::pi * (std::pow(outer, 3) - std::pow(inner, 3)) / c.box.volume();
        EXPECT_NEAR(g.value(static_cast<std::size_t>(a), static_cast<std::size_t>(b), bin) * ideal, wanted[bin], 1e-6)
            << a << b << " bin " << bin;
      }
    }
}

TEST(RadialDistribution, CountsEveryPairUpToHalfTheShortestEdge) {
  expect_all_pairs(random_mixture(300, {{8.0, 8.0, 8.0}}), 4.0);
  expect_all_pairs(random_mixture(300, {{8.0, 5.0, 20.0}}), 2.5);
}

TEST(RadialDistribution, CountsEveryPairWithinAShorterRange) {
  expect_all_pairs(random_mixture(2000, {{16.0, 15.0, 17.0}}), 5.0);
  expect_all_pairs(random_mixture(2000, {{16.0, 4.0, 17.0}}), 1.0);
}

TEST(RadialDistribution, ReachesToHalfTheBoxInSmallSystemsAndFiveSigmaInLargeOnes) {
  const Box box{{30.0, 24.0, 20.0}};
  EXPECT_EQ(RadialDistribution::default_range(box, 5'000), 10.0);
  EXPECT_EQ(RadialDistribution::default_range(box, 5'001), 5.0);
  EXPECT_EQ(RadialDistribution::default_range({{30.0, 24.0, 8.0}}, 100'000), 4.0);
  const ParticleLayout layout({0, 0}, 1);
  EXPECT_EQ(RadialDistribution(box, layout, 10).range(), 10.0);
  EXPECT_DOUBLE_EQ(RadialDistribution(box, layout, 10, 2.0).radius(9), 1.9);
}

}  // namespace
}  // namespace lanescape
