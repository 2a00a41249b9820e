#include "configuration/lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "configuration/pair_model.hpp"
#include "core/error.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

using testing::refusal;

// FNV-1a hash over the bits of a complete start.
std::uint64_t fingerprint(const Configuration& c) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto take = [&](std::uint64_t bits) {
    for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (bits >> (8 * byte) & 0xff)) * 0x100000001b3u;
  };
  for (const double edge : c.box.length) take(std::bit_cast<std::uint64_t>(edge));
  for (const int s : c.species) take(static_cast<std::uint64_t>(s));
  for (const double x : c.positions) take(std::bit_cast<std::uint64_t>(x));
  return hash;
}

// The smallest r_ij / s_ij over all pairs and 27 images of each, including a sphere's own images.
double least_ratio(const Configuration& c) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t j = i; j < c.size(); ++j)
      for (int image = 0; image < 27; ++image) {
        if (i == j && image == 13) continue;
        const double shift[3] = {image % 3 - 1.0, image / 3 % 3 - 1.0, image / 9 - 1.0};
        double r2 = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis)
          r2 += std::pow(c.positions[3 * j + axis] - c.positions[3 * i + axis] + shift[axis] * c.box.length[axis], 2);
        least = std::min(least, std::sqrt(r2) / (c.radii[i] + c.radii[j]));
      }
  return least;
}

HardSphereModel ternary() {
  HardSphereModel model;
  model.name = "ternary";
  model.species = {{"Ar", 1.0, 0.7}, {"Xe", 1.0, 0.1}, {"Kr", 1.0, 0.2}};
  model.diameters = {0.5, 3.0, 1.1};
  return model;
}

TEST(FccStart, ASeedKeepsItsMeaning) {
  EXPECT_EQ(fingerprint(fcc_start(kob_andersen(), 108, 1.2, 1)), 0xe1193d6edf7ba23cu);
  EXPECT_EQ(fingerprint(fcc_start(kob_andersen(), 107, 1.2, 7)), 0x034e6310bae3ed7fu);
  EXPECT_EQ(fingerprint(fcc_start(lennard_jones(), 1000, 0.8, 3)), 0xd11a0f6c6e3d6350u);
}

struct Start {
  HardSphereModel model;
  std::size_t particles;
  Arrangement arrangement;
};

std::vector<Start> starts() {
  std::vector<Start> result;
  for (const auto& model : {hard_sphere(), hard_sphere_binary(), ternary()})
    for (const std::size_t n : {1U, 2U, 4U, 31U, 107U, 108U, 256U})
      for (const Arrangement arrangement : {Arrangement::random, Arrangement::halves}) result.push_back({model, n, arrangement});
  return result;
}

TEST(HardSphereStart, SpheresTouchButDoNotOverlapAtTheLargestPackingFraction) {
  for (const auto& [model, n, arrangement] : starts()) {
    const double largest = largest_lattice_packing_fraction(model, n, arrangement, 5);
    const double ratio = least_ratio(hard_sphere_start(model, n, largest, arrangement, 5));
    EXPECT_GE(ratio, 1.0) << model.name << ' ' << n;
    if (largest < 0.74) {
      EXPECT_LT(ratio, 1.0 + 1e-12) << model.name << ' ' << n;
    }
  }
}

TEST(HardSphereStart, ThePackingFractionIsExactWithTheSpheresThereAre) {
  for (const auto& [model, n, arrangement] : starts()) {
    const double asked = 0.9 * largest_lattice_packing_fraction(model, n, arrangement, 2);
    const Configuration start = hard_sphere_start(model, n, asked, arrangement, 2);
    EXPECT_NEAR(packing_fraction(start), asked, 1e-14) << model.name << ' ' << n;
    EXPECT_EQ(start.radii, model.radii_of(start.species));
    EXPECT_EQ(start.positions.size(), 3 * n);
  }
}

TEST(HardSphereStart, TheFirstSpeciesTakesTheRest) {
  for (const Arrangement arrangement : {Arrangement::random, Arrangement::halves}) {
    const Configuration start = hard_sphere_start(hard_sphere_binary(), 107, 0.3, arrangement, 1);
    EXPECT_EQ(std::count(start.species.begin(), start.species.end(), 0), 54);
    EXPECT_EQ(std::count(start.species.begin(), start.species.end(), 1), 53);
  }
}

TEST(HardSphereStart, HalvesHoldTheLargestSpheresFirstAlongX) {
  for (const std::size_t n : {31U, 108U, 256U}) {
    const Configuration start = hard_sphere_start(ternary(), n, 0.05, Arrangement::halves, 4);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (start.radii[i] > start.radii[j]) {
          EXPECT_LE(start.positions[3 * i], start.positions[3 * j]) << i << ' ' << j;
        }
  }
}

TEST(HardSphereStart, RandomPlacesDependOnTheSeedAndHalvesOfAFullLatticeDoNot) {
  const auto start = [](Arrangement arrangement, std::uint64_t seed) {
    return fingerprint(hard_sphere_start(hard_sphere_binary(), 108, 0.4, arrangement, seed));
  };
  EXPECT_EQ(start(Arrangement::random, 1), start(Arrangement::random, 1));
  EXPECT_NE(start(Arrangement::random, 1), start(Arrangement::random, 2));
  EXPECT_EQ(start(Arrangement::halves, 1), start(Arrangement::halves, 2));
}

TEST(HardSphereStart, LatticesReachWhatGeometrySays) {
  // Equal spheres: close packing exceeds the allowed 0.74; a single sphere touches its own images.
  EXPECT_EQ(largest_lattice_packing_fraction(hard_sphere(), 108, Arrangement::random, 1), 0.74);
  EXPECT_NEAR(largest_lattice_packing_fraction(hard_sphere(), 1, Arrangement::random, 1), std::numbers::pi / 6.0, 1e-11);
  // Neighbouring large spheres touch: 4 spheres in a cell of edge 1.4 sqrt 2.
  const double mean_cube = 0.5 * (1.4 * 1.4 * 1.4 + 1.0), cell = 1.4 * std::numbers::sqrt2;
  for (const Arrangement arrangement : {Arrangement::random, Arrangement::halves})
    EXPECT_NEAR(largest_lattice_packing_fraction(hard_sphere_binary(), 108, arrangement, 1),
                std::numbers::pi / 6.0 * 4.0 * mean_cube / (cell * cell * cell), 1e-11);
}

TEST(HardSphereStart, WhatTheLatticeCannotReachIsRefusedWithWhatItCan) {
  const std::string message = refusal([] { hard_sphere_start(hard_sphere_binary(), 108, 0.6, Arrangement::random, 1); });
  EXPECT_EQ(message, "packing fraction 0.6 is beyond what this arrangement on an fcc lattice can reach (0.505167)");
}

TEST(HardSphereStart, OptionsOutOfRangeAreRefused) {
  for (const double bad : {0.0, -0.1, 0.741, std::numeric_limits<double>::quiet_NaN()}) {
    const std::string message = refusal([&] { hard_sphere_start(hard_sphere(), 108, bad, Arrangement::random, 1); });
    EXPECT_NE(message.find("is not allowed: above 0 and at most 0.74"), std::string::npos) << message;
  }
  for (const std::size_t bad : {0U, 4'000'001U})
    for (const std::string& message : {refusal([&] { hard_sphere_start(hard_sphere(), bad, 0.3, Arrangement::random, 1); }),
                                       refusal([&] { fcc_start(kob_andersen(), bad, 1.2, 1); })})
      EXPECT_NE(message.find("particles are not allowed: from 1 to 4000000"), std::string::npos) << message;
  HardSphereModel broken = hard_sphere();
  broken.diameters.clear();
  refusal([&] { hard_sphere_start(broken, 108, 0.3, Arrangement::random, 1); });
}

TEST(FccStart, AMillionParticlesAreAllowed) {
  const Configuration start = fcc_start(kob_andersen(), 1'000'000, 1.2, 1);
  EXPECT_EQ(start.size(), 1'000'000u);
  EXPECT_EQ(std::count(start.species.begin(), start.species.end(), 1), 200'000);
}

TEST(HardSphereStart, AMillionSpheresAreAllowed) {
  const Configuration start = hard_sphere_start(hard_sphere_binary(), 1'000'000, 0.5, Arrangement::random, 1);
  EXPECT_EQ(start.size(), 1'000'000u);
  EXPECT_NEAR(packing_fraction(start), 0.5, 1e-10);
}

}  // namespace
}  // namespace lanescape
