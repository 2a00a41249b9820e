#include "interaction/sphere/gap_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "core/random.hpp"
#include "dispatch/isa.hpp"
#include "memory_archive.hpp"

namespace lanescape {
namespace {

const kernels::KernelTable& best_table() { return kernel_table(available_isas().back()); }

// Spheres of two sizes at random places, which may overlap.
struct Cloud {
  Box box;
  std::vector<double> radii, positions;
  ParticleLayout layout;
  HardSphereOverlap spheres;

  Cloud(const Box& edges, std::size_t particles, std::uint64_t seed)
      : box(edges), radii(particles), positions(3 * particles), layout(std::vector<int>(particles, 0), 1), spheres(make(seed)) {}

  HardSphereOverlap make(std::uint64_t seed) {
    for (std::size_t j = 0; j < radii.size(); ++j) {
      radii[j] = j % 2 == 0 ? 0.5 : 0.7;
      for (std::size_t axis = 0; axis < 3; ++axis)
        positions[3 * j + axis] = 3.0 * box.length[axis] * (uniform(seed, 0, 3 * j + axis) - 0.5);
    }
    return {box, layout, radii, best_table()};
  }
  static double uniform(std::uint64_t seed, std::uint64_t step, std::uint64_t k) {
    return CounterRandom(seed, RandomStream::displacements).uniform(step, static_cast<std::uint32_t>(k));
  }
  AlignedArray slots() const { return layout.to_slots(positions); }
};

using Key = std::tuple<std::int32_t, std::int32_t, double>;

std::vector<Key> within(const std::vector<PairGap>& gaps, double reach) {
  std::vector<Key> keys;
  for (const PairGap& pair : gaps)
    if (pair.gap < reach) keys.emplace_back(pair.first, pair.second, pair.gap);
  std::sort(keys.begin(), keys.end());
  return keys;
}

// All images within four boxes.
std::vector<Key> brute_force(const Cloud& cloud, double reach) {
  std::vector<Key> keys;
  for (std::size_t i = 0; i < cloud.radii.size(); ++i)
    for (std::size_t j = i + 1; j < cloud.radii.size(); ++j)
      for (int cell = 0; cell < 729; ++cell) {
        const Point offset{cell % 9 - 4.0, cell / 9 % 9 - 4.0, cell / 81 - 4.0};
        double squared = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis)
          squared +=
              std::pow(cloud.positions[3 * j + axis] - cloud.positions[3 * i + axis] + offset[axis] * cloud.box.length[axis], 2);
        const double gap = std::sqrt(squared) - cloud.radii[i] - cloud.radii[j];
        if (gap < reach) keys.emplace_back(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), gap);
      }
  std::sort(keys.begin(), keys.end());
  return keys;
}

void expect_same(const std::vector<Key>& found, const std::vector<Key>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(std::get<0>(found[k]), std::get<0>(expected[k]));
    EXPECT_EQ(std::get<1>(found[k]), std::get<1>(expected[k]));
    EXPECT_NEAR(std::get<2>(found[k]), std::get<2>(expected[k]), 1e-13);
  }
}

// Particles drift, each its own way, so that the list is used and rebuilt.
void expect_all_pairs_while_moving(const Box& box, std::size_t particles) {
  Cloud cloud(box, particles, 7);
  GapList list(cloud.spheres, 0.3, 0.1);
  for (std::uint64_t step = 0; step < 60; ++step) {
    expect_same(within(list.at(cloud.slots()), list.reach()), brute_force(cloud, list.reach()));
    for (std::size_t k = 0; k < cloud.positions.size(); ++k) cloud.positions[k] += 0.02 * (Cloud::uniform(8, step / 10, k) - 0.5);
  }
  EXPECT_GT(list.rebuilds(), 2u);
  EXPECT_LT(list.rebuilds(), 40u);
}

TEST(GapList, HasEveryPairWithinItsReachWhileParticlesMove) { expect_all_pairs_while_moving({{5.0, 6.0, 7.0}}, 40); }

TEST(GapList, HasEveryImageOfAPairInABoxOfTwoDiameters) { expect_all_pairs_while_moving({{2.8, 2.8, 3.0}}, 7); }

TEST(GapList, ReducesItsReachInABoxThatCannotHoldIt) {
  Cloud cloud({{2.8, 2.8, 2.8}}, 3, 1);
  GapList list(cloud.spheres, 3.0, 1.0);
  EXPECT_DOUBLE_EQ(list.reach(), 3.0 * 1.4 / 4.0);
  expect_same(within(list.at(cloud.slots()), list.reach()), brute_force(cloud, list.reach()));
}

TEST(GapList, NormalsAreUnitVectorsFromTheFirstToTheSecond) {
  Cloud cloud({{5.0, 5.0, 5.0}}, 2, 1);
  cloud.positions = {0.5, 1.0, 1.0, 4.5 + 15.0, 1.0, 1.25};  // across a face, and three boxes away
  GapList list(cloud.spheres, 0.3, 0.1);
  const auto& gaps = list.at(cloud.slots());
  ASSERT_EQ(gaps.size(), 1u);
  const double r = std::hypot(1.0, 0.25);
  EXPECT_DOUBLE_EQ(gaps[0].gap, r - 1.2);
  EXPECT_DOUBLE_EQ(gaps[0].normal[0], -1.0 / r);
  EXPECT_DOUBLE_EQ(gaps[0].normal[1], 0.0);
  EXPECT_DOUBLE_EQ(gaps[0].normal[2], 0.25 / r);
}

TEST(GapList, GivesCentresAtOnePlaceAUnitNormal) {
  Cloud cloud({{5.0, 5.0, 5.0}}, 2, 1);
  cloud.positions = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  GapList list(cloud.spheres, 0.3, 0.1);
  ASSERT_EQ(list.at(cloud.slots()).size(), 1u);
  EXPECT_EQ(list.at(cloud.slots())[0].normal, (Point{1.0, 0.0, 0.0}));
}

TEST(GapList, ContinuesFromAnArchiveWithThePairsInTheSameOrder) {
  Cloud cloud({{5.0, 6.0, 7.0}}, 40, 3);
  GapList list(cloud.spheres, 0.3, 0.2), copy(cloud.spheres, 0.3, 0.2);
  list.at(cloud.slots());
  for (double& x : cloud.positions)
    x += 0.03 * (Cloud::uniform(4, 0, static_cast<std::uint64_t>(&x - cloud.positions.data())) - 0.5);
  testing::MemoryArchive archive;
  list.exchange(archive);
  archive.rewind();
  copy.exchange(archive);
  const auto expected = list.at(cloud.slots()), found = copy.at(cloud.slots());
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(found[k].first, expected[k].first);
    EXPECT_EQ(found[k].second, expected[k].second);
    EXPECT_EQ(found[k].gap, expected[k].gap);
  }
  EXPECT_EQ(copy.rebuilds(), list.rebuilds());
}

}  // namespace
}  // namespace lanescape
