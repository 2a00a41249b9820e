#include "neighbour/neighbour_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "every_isa.hpp"
#include "neighbour/pair_finder.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

using Pair = std::tuple<std::size_t, std::size_t, std::array<int, 3>, std::array<double, 3>, double>;

std::vector<Pair> as_rows(const OrderedPairs& pairs) {
  const std::size_t n = pairs.first.size();
  EXPECT_TRUE(pairs.second.size() == n && pairs.shift.size() == n && pairs.separation.size() == n && pairs.distance.size() == n);
  std::vector<Pair> rows;
  for (std::size_t k = 0; k < n; ++k)
    rows.emplace_back(pairs.first[k], pairs.second[k], pairs.shift[k], pairs.separation[k], pairs.distance[k]);
  return rows;
}

// Every relevant shift of every pair, in order: brute force, to check the pairs.
std::vector<Pair> by_force(const Box& box, const std::vector<double>& positions, double cutoff) {
  std::vector<Pair> rows;
  for (std::size_t i = 0; i < positions.size() / 3; ++i)
    for (std::size_t j = 0; j < positions.size() / 3; ++j) {
      std::array<double, 3> apart{};
      std::array<int, 3> least{}, most{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        apart[axis] = positions[3 * j + axis] - positions[3 * i + axis];
        least[axis] = static_cast<int>(std::floor((-cutoff - apart[axis]) / box.length[axis])) - 1;
        most[axis] = static_cast<int>(std::ceil((cutoff - apart[axis]) / box.length[axis])) + 1;
      }
      for (int a = least[0]; a <= most[0]; ++a)
        for (int b = least[1]; b <= most[1]; ++b)
          for (int c = least[2]; c <= most[2]; ++c) {
            if (i == j && a == 0 && b == 0 && c == 0) continue;
            const std::array<double, 3> d = {apart[0] + a * box.length[0], apart[1] + b * box.length[1],
                                             apart[2] + c * box.length[2]};
            const double distance = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            if (distance < cutoff) rows.emplace_back(i, j, std::array<int, 3>{a, b, c}, d, distance);
          }
    }
  return rows;
}

// Particles at random positions, up to `boxes` boxes away.
std::vector<double> random_positions(const Box& box, std::size_t particles, double boxes, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> place(-boxes, 1.0 + boxes);
  std::vector<double> positions;
  for (std::size_t k = 0; k < 3 * particles; ++k) positions.push_back(box.length[k % 3] * place(engine));
  return positions;
}

const kernels::KernelTable& best_kernels() { return kernel_table(available_isas().back()); }

using OrderedPairsOnEveryIsa = testing::EveryIsa;

INSTANTIATE_TEST_SUITE_P(EveryIsa, OrderedPairsOnEveryIsa, testing::all_isas(), testing::isa_name);

TEST_P(OrderedPairsOnEveryIsa, AreThoseOfAllPairsToTheLastBitInBoxesOfEverySize) {
  const std::vector<Box> boxes = {{{9.0, 9.0, 9.0}}, {{7.0, 5.5, 8.2}},  {{3.1, 3.0, 2.9}}, {{1.0, 1.1, 0.9}},
                                  {{0.7, 0.6, 6.0}}, {{12.0, 0.8, 5.0}}, {{1.5, 1.5, 1.5}}, {{0.3, 0.25, 0.4}}};
  unsigned seed = 0;
  for (const Box& box : boxes)
    for (const std::size_t particles : {0U, 1U, 2U, 3U, 17U, 64U, 90U}) {
      if (box.shortest() < 0.5 && particles > 17U) continue;
      for (const double away : {0.0, 1.5, 1e4, 9e7}) {
        const std::vector<double> positions = random_positions(box, particles, away, ++seed);
        ASSERT_EQ(as_rows(ordered_pairs(box, positions, 1.5, kernel_table(GetParam()))), by_force(box, positions, 1.5))
            << particles << " particles up to " << away << " boxes from one of " << box.length[0] << " x " << box.length[1] << " x "
            << box.length[2];
      }
    }
}

// On a lattice with exactly representable distances, a change of the cutoff by its last digit includes or excludes a shell of
// neighbours.
TEST_P(OrderedPairsOnEveryIsa, OfClustersInLargeBoxesAreThoseOfAllPairs) {
  const kernels::KernelTable& table = kernel_table(GetParam());
  std::mt19937_64 engine(29);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const double edge : {20.0, 300.0, 1e5, 1e8})
    for (const double boxes : {0.0, 2.0}) {
      const Box box{{edge, 1.5 * edge, edge > 100.0 ? 3.0 : edge}};
      std::vector<double> positions;
      for (int cluster = 0; cluster < 4; ++cluster) {
        std::array<double, 3> centre{};  // some at a face
        for (std::size_t axis = 0; axis < 3; ++axis) centre[axis] = box.length[axis] * (cluster < 2 ? cluster : unit(engine));
        for (int k = 0; k < 15; ++k)
          for (std::size_t axis = 0; axis < 3; ++axis)
            positions.push_back(centre[axis] + 4.0 * (unit(engine) - 0.5) + std::floor(boxes * unit(engine)) * box.length[axis]);
      }
      const std::vector<Pair> expected = by_force(box, positions, 2.0);
      EXPECT_GT(expected.size(), 100U);
      EXPECT_EQ(as_rows(ordered_pairs(box, positions, 2.0, table)), expected) << edge << " " << boxes;
    }
}

TEST_P(OrderedPairsOnEveryIsa, EndBeforeTheCutoffToTheLastDigit) {
  const Box box{{4.0, 4.0, 4.0}};
  std::vector<double> positions;
  for (int k = 0; k < 64; ++k)
    for (const int x : {k / 16, k / 4 % 4, k % 4}) positions.push_back(x);
  const auto neighbours = [&](double cutoff) {
    return ordered_pairs(box, positions, cutoff, kernel_table(GetParam())).first.size() / 64;
  };
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(neighbours(1.0), 0U);
  EXPECT_EQ(neighbours(std::nextafter(1.0, infinity)), 6U);
  EXPECT_EQ(neighbours(std::sqrt(2.0)), 6U);
  EXPECT_EQ(neighbours(std::nextafter(std::sqrt(2.0), infinity)), 18U);
  EXPECT_EQ(neighbours(5.0), 484U);  // lattice points within 5, without those at exactly 5: (+-5,0,0) and (+-3,+-4,0)
  EXPECT_EQ(neighbours(std::nextafter(5.0, infinity)), 514U);
}

// Pairs at the cutoff, up to rounding, with one of each pair at a face of the box; far away from the box rounding is large.
TEST(OrderedPairs, AreDecidedAsTheFormulaRoundsHoweverFarParticlesAre) {
  const Box box{{9.1, 8.3, 7.7}};
  for (const double away : {1e2, 1e4, 1e6, 4e7}) {
    std::mt19937_64 engine(11);
    std::uniform_int_distribution<int> boxes(static_cast<int>(-away), static_cast<int>(away));
    std::vector<double> positions = random_positions(box, 90, away, 12);
    for (std::size_t k = 0; k < 90; ++k) {
      positions[3 * k + k % 3] = boxes(engine) * box.length[k % 3];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double apart = axis != k % 3 ? 0.0 : k < 45 ? 1.5 : -1.5;
        positions.push_back(positions[3 * k + axis] + apart + boxes(engine) * box.length[axis]);
      }
    }
    const std::vector<Pair> expected = by_force(box, positions, 1.5);
    EXPECT_EQ(as_rows(ordered_pairs(box, positions, 1.5, best_kernels())), expected) << away;
    const auto marginal = std::count_if(expected.begin(), expected.end(),
                                        [&](const Pair& pair) { return std::get<double>(pair) > 1.5 - 2e-14 * (1.0 + away); });
    EXPECT_GT(marginal, 20) << away;
  }
}

TEST(OrderedPairs, ComeFromBothEnds) {
  const Box box{{2.0, 1.3, 3.0}};
  const std::vector<Pair> rows = as_rows(ordered_pairs(box, random_positions(box, 20, 3.0, 5), 1.7, best_kernels()));
  std::vector<Pair> reversed;
  for (const auto& [i, j, s, d, distance] : rows)
    reversed.emplace_back(j, i, std::array<int, 3>{-s[0], -s[1], -s[2]}, std::array<double, 3>{-d[0], -d[1], -d[2]}, distance);
  std::sort(reversed.begin(), reversed.end());
  EXPECT_EQ(reversed, rows);
}

TEST(OrderedPairs, DoNotDependOnTheUnitOfLength) {
  const Box box{{2.0, 1.3, 3.0}};
  const std::vector<double> positions = random_positions(box, 20, 3.0, 6);
  const OrderedPairs expected = ordered_pairs(box, positions, 1.7, best_kernels());
  EXPECT_GT(expected.first.size(), 100U);
  for (const int power : {-300, -70, 70, 300}) {
    std::vector<double> scaled = positions;
    for (double& x : scaled) x = std::scalbn(x, power);
    const Box scaled_box{{std::scalbn(2.0, power), std::scalbn(1.3, power), std::scalbn(3.0, power)}};
    const OrderedPairs pairs = ordered_pairs(scaled_box, scaled, std::scalbn(1.7, power), best_kernels());
    EXPECT_EQ(pairs.second, expected.second) << power;
    EXPECT_EQ(pairs.shift, expected.shift) << power;
  }
}

TEST(OrderedPairs, CanBeOfParticlesInOnePlace) {
  const std::vector<double> positions = {0.5, 0.5, 0.5, 2.5, 0.5, -1.5};
  const std::vector<Pair> expected = {{0, 1, {-1, 0, 1}, {0.0, 0.0, 0.0}, 0.0}, {1, 0, {1, 0, -1}, {0.0, 0.0, 0.0}, 0.0}};
  EXPECT_EQ(as_rows(ordered_pairs({{2.0, 2.0, 2.0}}, positions, 1.0, best_kernels())), expected);
}

TEST(OrderedPairs, OfOneParticleAreItsImagesUpToTheSmallestBox) {
  const double edge = 1.0 / max_boxes_in_cutoff;
  const Box box{{edge, edge, edge}};
  const std::vector<double> positions = {0.3, -7.0, 0.01};
  EXPECT_EQ(as_rows(ordered_pairs(box, positions, 1.0, best_kernels())), by_force(box, positions, 1.0));
}

TEST(OrderedPairs, RefuseWhatIsNotFiniteOrOutOfRange) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> one = {0.5, 0.5, 0.5};
  const auto message = [](const Box& box, const std::vector<double>& positions, double cutoff) {
    return testing::refusal([&] { ordered_pairs(box, positions, cutoff, best_kernels()); });
  };
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text << " does not say " << part;
  };
  const Box box{{2.0, 2.0, 2.0}};
  for (const double cutoff : {0.0, -1.0, nan, infinity, -infinity, 1e101, 1e-101}) {
    says(message(box, one, cutoff), "must be from 1e-100 to 1e+100");
    says(message(box, {}, cutoff), "cutoff");
  }
  for (const double edge : {0.0, -2.0, nan, infinity, 1e101}) {
    says(message({{2.0, edge, 2.0}}, one, 1.0), "box edge");
    says(message({{2.0, 2.0, edge}}, {}, 1.0), "must be from 1e-100 to 1e+100");
  }
  for (const double x : {nan, infinity, -infinity, 2.1e9, -1e300}) says(message(box, {0, 0, 0, 0, x, 0}, 1.0), "y coordinate");
  says(message(box, {0, 0, 0, 0, 0, nan}, 1.0), "particle 1 (from 0)");
  says(message(box, {0, 0, 0, 0}, 1.0), "4 coordinates were given");
  says(message({{2.0, 1.0, 2.0}}, one, 32.5), "at most 32 is");
  says(message({{1.0, 1.0, 1.0}}, std::vector<double>(3 * 10000, 0.5), 32.0), "images within the cutoff");
}

}  // namespace
}  // namespace lanescape
