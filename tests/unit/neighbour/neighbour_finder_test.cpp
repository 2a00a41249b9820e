#include <lanescape/neighbours.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "allocations.hpp"
#include "every_isa.hpp"
#include "neighbour/pair_rows.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

using Options = NeighbourFinder::Options;
using Members = NeighbourFinder::Members;
using Order = NeighbourFinder::Order;
using Point = std::array<double, 3>;
using Row = std::tuple<std::int64_t, std::int64_t, std::array<int, 3>, Point, double>;  // i j S D d
using Bonds = std::vector<std::pair<std::int64_t, std::int64_t>>;

struct System {
  Point box{9.0, 9.0, 9.0};
  std::vector<double> positions;
  std::vector<std::int32_t> species;
};

System random_system(const Point& box, std::size_t particles, double boxes, unsigned seed, std::int32_t species = 1) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> place(-boxes, 1.0 + boxes);
  std::uniform_int_distribution<std::int32_t> kind(0, species - 1);
  System system{box, {}, {}};
  for (std::size_t k = 0; k < 3 * particles; ++k) system.positions.push_back(box[k % 3] * place(engine));
  for (std::size_t i = 0; i < particles; ++i) system.species.push_back(kind(engine));
  return system;
}

std::vector<Row> rows_of(const NeighbourFinder::Pairs& pairs) {
  EXPECT_TRUE(pairs.i.size() == pairs.count && pairs.j.size() == pairs.count && pairs.S.size() == 3 * pairs.count &&
              pairs.D.size() == 3 * pairs.count && pairs.d.size() == pairs.count);
  std::vector<Row> rows;
  for (std::size_t k = 0; k < pairs.count; ++k)
    rows.emplace_back(pairs.i[k], pairs.j[k], std::array<int, 3>{pairs.S[3 * k], pairs.S[3 * k + 1], pairs.S[3 * k + 2]},
                      Point{pairs.D[3 * k], pairs.D[3 * k + 1], pairs.D[3 * k + 2]}, pairs.d[k]);
  return rows;
}

double cutoff_of(const Options& options, const System& from, std::size_t i, const System& to, std::size_t j) {
  if (options.cutoffs.size() == 1) return options.cutoffs[0];
  const auto count = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(options.cutoffs.size()))));
  return options.cutoffs[static_cast<std::size_t>(from.species[i]) * count + static_cast<std::size_t>(to.species[j])];
}

// Appends the pairs of two particles, every shift that can matter in order.
void add_images(const Options& options, const System& from, std::size_t i, const System& to, std::size_t j, bool one_set,
                std::vector<Row>& rows) {
  const double cutoff = cutoff_of(options, from, i, to, j);
  Point apart{};
  std::array<int, 3> least{}, most{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    apart[axis] = to.positions[3 * j + axis] - from.positions[3 * i + axis];
    if (!options.periodic[axis]) continue;
    least[axis] = static_cast<int>(std::floor((-cutoff - apart[axis]) / to.box[axis])) - 1;
    most[axis] = static_cast<int>(std::ceil((cutoff - apart[axis]) / to.box[axis])) + 1;
  }
  const std::array<int, 3> none{};
  for (int a = least[0]; a <= most[0]; ++a)
    for (int b = least[1]; b <= most[1]; ++b)
      for (int c = least[2]; c <= most[2]; ++c) {
        const std::array<int, 3> shift{a, b, c};
        if (one_set && i == j && shift == none) continue;
        if (one_set && options.members == Members::half && (j < i || (i == j && shift < none))) continue;
        Point d{};
        for (std::size_t axis = 0; axis < 3; ++axis)
          d[axis] = apart[axis] + (options.periodic[axis] ? shift[axis] * to.box[axis] : 0.0);
        const double distance = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        if (distance < cutoff) rows.emplace_back(i, j, shift, d, distance);
      }
}

std::vector<Row> by_force(const Options& options, const System& system, const Bonds& bonds = {}) {
  std::vector<Row> rows;
  const std::size_t n = system.positions.size() / 3;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const auto joins = [&](const auto& bond) {
        const auto a = static_cast<std::size_t>(bond.first), b = static_cast<std::size_t>(bond.second);
        return (a == i && b == j) || (a == j && b == i);
      };
      if (std::none_of(bonds.begin(), bonds.end(), joins)) add_images(options, system, i, system, j, true, rows);
    }
  return rows;
}

std::vector<Row> between_sets(const Options& options, const System& points, const System& system) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < points.positions.size() / 3; ++i)
    for (std::size_t j = 0; j < system.positions.size() / 3; ++j) add_images(options, points, i, system, j, false, rows);
  return rows;
}

std::vector<Row> found(const Options& options, const System& system, const Bonds& bonds = {}) {
  NeighbourFinder finder(options);
  finder.exclude(bonds);
  std::vector<Row> rows = rows_of(finder.find(system.positions, system.box, system.species));
  if (options.order == Order::any) std::sort(rows.begin(), rows.end());
  return rows;
}

constexpr std::array<bool, 3> axes(int bits) { return {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0}; }

using NeighbourFinderOnEveryIsa = testing::EveryIsa;
INSTANTIATE_TEST_SUITE_P(EveryIsa, NeighbourFinderOnEveryIsa, testing::all_isas(), testing::isa_name);

TEST_P(NeighbourFinderOnEveryIsa, FindsThePairsOfBruteForceWithEveryCombinationOfOptions) {
  const std::vector<Point> boxes = {{9.0, 8.0, 10.0}, {3.1, 5.0, 2.9}, {1.0, 1.1, 7.0}, {0.7, 0.6, 0.8}};
  unsigned seed = 0;
  for (const Point& box : boxes)
    for (const std::size_t particles : {0U, 1U, 2U, 40U})
      for (int periodic = 0; periodic < 8; ++periodic)
        for (const Members members : {Members::full, Members::half})
          for (const Order order : {Order::sorted, Order::any})
            for (const bool mixture : {false, true}) {
              ++seed;
              const System system = random_system(box, particles, seed % 3 == 0 ? 2.0 : 0.0, seed, mixture ? 2 : 1);
              Options options{.cutoffs = {1.5}, .periodic = axes(periodic), .origin = {-0.3, 0.0, 40.0}, .members = members};
              options.order = order;
              options.instruction_set = to_string(GetParam());
              if (mixture) options.cutoffs = {1.5, 0.9, 0.9, 0.0};
              const Bonds bonds = particles > 2 ? Bonds{{0, 1}, {5, 3}, {7, 7}, {0, 1}} : Bonds{};
              ASSERT_EQ(found(options, system, bonds), by_force(options, system, bonds))
                  << box[0] << " " << particles << " " << periodic << " " << (members == Members::half) << (order == Order::any)
                  << mixture;
            }
}

TEST_P(NeighbourFinderOnEveryIsa, FindsTheNeighboursOfOtherPoints) {
  unsigned seed = 100;
  for (const Point& box : {Point{9.0, 8.0, 10.0}, Point{1.0, 1.1, 7.0}, Point{300.0, 200.0, 5.0}})
    for (int periodic = 0; periodic < 8; ++periodic) {
      const System system = random_system(box, 50, 0.5, ++seed, 2), points = random_system(box, 30, 3.0, ++seed, 2);
      const Options options{.cutoffs = {1.5, 2.0, 2.0, 1.0}, .periodic = axes(periodic), .instruction_set = to_string(GetParam())};
      NeighbourFinder finder(options);
      finder.set_particles(system.positions, system.box, system.species);
      EXPECT_EQ(rows_of(finder.neighbours(points.positions, points.species)), between_sets(options, points, system)) << periodic;
      for (std::size_t i = 0; i < 30; ++i) {
        const System one{box, {&points.positions[3 * i], &points.positions[3 * i] + 3}, {points.species[i]}};
        const Point at{one.positions[0], one.positions[1], one.positions[2]};
        ASSERT_EQ(rows_of(finder.neighbours(at, one.species[0])), between_sets(options, one, system)) << periodic << " " << i;
      }
    }
}

// Points in the gaps between few particles, which the search narrows.
TEST_P(NeighbourFinderOnEveryIsa, FindsTheNeighboursOfPointsBetweenFewParticles) {
  unsigned seed = 500;
  for (int trial = 0; trial < 400; ++trial) {
    const int periodic = trial % 8;
    const Point box{3.0 + 3.5 * (trial % 3), 4.0, 5.0};
    const System system = random_system(box, 1 + static_cast<std::size_t>(trial % 12), 0.5, ++seed, 1);
    const System points = random_system(box, 4, 1.5, ++seed, 1);
    const Options options{
        .cutoffs = {0.3 + 0.01 * (trial % 120)}, .periodic = axes(periodic), .instruction_set = to_string(GetParam())};
    NeighbourFinder finder(options);
    finder.set_particles(system.positions, system.box, system.species);
    ASSERT_EQ(rows_of(finder.neighbours(points.positions, points.species)), between_sets(options, points, system)) << trial;
  }
}

// Droplets far apart, along open axes too; one is at a face.
TEST_P(NeighbourFinderOnEveryIsa, FindsThePairsOfClustersFarApart) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const double edge : {30.0, 1e4, 1e9, 1e12})
    for (int periodic = 0; periodic < 8; ++periodic) {
      System system{{edge, 2.0 * edge, 1.5 * edge}, {}, {}};
      for (int cluster = 0; cluster < 4; ++cluster)
        for (int k = 0; k < 20; ++k)
          for (const double length : system.box) system.positions.push_back(length * cluster / 4.0 + 3.0 * (unit(engine) - 0.5));
      const Options options{.cutoffs = {1.5}, .periodic = axes(periodic), .instruction_set = to_string(GetParam())};
      system.species.assign(80, 0);
      const std::vector<Row> expected = by_force(options, system);
      EXPECT_GT(expected.size(), 100U);
      ASSERT_EQ(found(options, system), expected) << edge << " " << periodic;
    }
}

TEST_P(NeighbourFinderOnEveryIsa, SortsListsOfEveryLength) {
  std::mt19937_64 engine(7);
  for (const std::size_t count : {0U, 1U, 2U, 15U, 16U, 31U, 32U, 33U, 64U, 65U, 255U, 256U, 257U, 1000U}) {
    std::vector<std::uint32_t> numbers(count), spare(count + 32);
    for (std::size_t k = 0; k < count; ++k) numbers[k] = static_cast<std::uint32_t>(2000000 * k);
    const std::vector<std::uint32_t> expected = numbers;
    std::shuffle(numbers.begin(), numbers.end(), engine);
    numbers.resize(count + 32, 5U);
    sort_numbers(numbers.data(), count, spare.data(), kernel_table(GetParam()));
    numbers.resize(count);
    EXPECT_EQ(numbers, expected) << count;
  }
}

TEST(NeighbourFinder, ReachesParticlesAtAnyFinitePlaceAlongOpenAxes) {
  const std::vector<double> positions = {-1.7e308, 0, 0, -1.7e308, 1, 0, 1.7e308, 0, 0, 1.7e308, 0, 1, 5, 0, 0, 5.5, 0, 0};
  const System system{{0.0, 0.0, 0.0}, positions, std::vector<std::int32_t>(6, 0)};
  const Options options{.cutoffs = {1.5}, .periodic = {false, false, false}};
  EXPECT_EQ(found(options, system).size(), 6U);
  EXPECT_EQ(found(options, system), by_force(options, system));
}

TEST(NeighbourFinder, GivesShiftsOfAThousandMillionBoxes) {
  const System system{{2.0, 2.0, 2.0}, {2e9, 0.0, 0.0, -2e9, 0.5, 0.0}, {0, 0}};
  const Options options{.cutoffs = {1.0}};
  const std::vector<Row> expected = {{0, 1, {2000000000, 0, 0}, {0.0, 0.5, 0.0}, 0.5},
                                     {1, 0, {-2000000000, 0, 0}, {0.0, -0.5, 0.0}, 0.5}};
  EXPECT_EQ(found(options, system), expected);
}

TEST(NeighbourFinder, ListsHalfOfTheFullPairs) {
  const System system = random_system({1.3, 4.0, 2.2}, 30, 1.0, 8);
  const std::size_t full = found({.cutoffs = {1.9}}, system).size();
  EXPECT_GT(full, 1000U);
  EXPECT_EQ(2 * found({.cutoffs = {1.9}, .members = Members::half}, system).size(), full);
}

TEST(NeighbourFinder, GivesTheSegmentOfEachParticle) {
  const System system = random_system({20.0, 20.0, 20.0}, 200, 0.0, 9);
  for (const Members members : {Members::full, Members::half}) {
    NeighbourFinder finder({.cutoffs = {2.5}, .members = members, .quantities = {.segments = true}});
    const NeighbourFinder::Pairs pairs = finder.find(system.positions, system.box);
    ASSERT_EQ(pairs.segments.size(), 201U);
    EXPECT_EQ(pairs.segments[200], static_cast<std::int64_t>(pairs.count));
    for (std::size_t k = 0; k < pairs.count; ++k) {
      const auto i = static_cast<std::size_t>(pairs.i[k]);
      ASSERT_TRUE(pairs.segments[i] <= static_cast<std::int64_t>(k) && static_cast<std::int64_t>(k) < pairs.segments[i + 1]);
    }
  }
}

TEST(NeighbourFinder, WritesWhatIsWantedAndNothingElse) {
  const System system = random_system({5.0, 5.0, 5.0}, 100, 0.0, 10);
  NeighbourFinder all({.cutoffs = {1.5}});
  const NeighbourFinder::Pairs expected = all.find(system.positions, system.box);
  const auto same = [](auto part, auto whole, bool wanted) {
    return wanted ? std::equal(part.begin(), part.end(), whole.begin(), whole.end()) : part.empty();
  };
  for (int bits = 0; bits < 32; ++bits) {
    const auto wanted = [&](int bit) { return (bits >> bit & 1) != 0; };
    NeighbourFinder finder(
        {.cutoffs = {1.5}, .quantities = {.i = wanted(0), .j = wanted(1), .S = wanted(2), .D = wanted(3), .d = wanted(4)}});
    const NeighbourFinder::Pairs pairs = finder.find(system.positions, system.box);
    EXPECT_EQ(pairs.count, expected.count);
    EXPECT_TRUE(same(pairs.i, expected.i, wanted(0)) && same(pairs.j, expected.j, wanted(1)) &&
                same(pairs.S, expected.S, wanted(2)) && same(pairs.D, expected.D, wanted(3)) &&
                same(pairs.d, expected.d, wanted(4)) && pairs.segments.empty())
        << bits;
  }
}

TEST(NeighbourFinder, IsTheSameOnAnyNumberOfThreads) {
  const System system = random_system({20.0, 20.0, 20.0}, 3000, 0.0, 11);
  for (const Order order : {Order::sorted, Order::any}) {
    NeighbourFinder one({.cutoffs = {2.5}, .order = order});
    const std::vector<Row> expected = rows_of(one.find(system.positions, system.box));
    for (const int threads : {2, 3, 7}) {
      NeighbourFinder several({.cutoffs = {2.5}, .order = order, .threads = threads});
      EXPECT_EQ(rows_of(several.find(system.positions, system.box)), expected) << threads;
    }
  }
}

TEST(NeighbourFinder, FollowsCallsWithOtherSystems) {
  NeighbourFinder finder({.cutoffs = {1.5}, .order = Order::sorted});
  for (const std::size_t particles : {10U, 500U, 0U, 3U, 200U}) {
    const System system = random_system({5.0 + static_cast<double>(particles), 6.0, 4.0}, particles, 1.0, 12);
    EXPECT_EQ(rows_of(finder.find(system.positions, system.box)), by_force({.cutoffs = {1.5}}, system)) << particles;
  }
}

TEST(NeighbourFinder, AllocatesNothingAfterTheFirstCall) {
  for (const Order order : {Order::sorted, Order::any})
    for (const double edge : {10.0, 1000.0}) {  // the second is sparse
      System system = random_system({edge, edge, edge}, 1000, 0.0, 13);
      NeighbourFinder finder({.cutoffs = {2.5}, .order = order, .quantities = {.segments = order == Order::sorted}});
      finder.find(system.positions, system.box);
      finder.neighbours(Point{1.0, 2.0, 3.0});
      const std::size_t before = testing::allocations();
      for (int call = 0; call < 100; ++call) {
        finder.find(system.positions, system.box);
        finder.neighbours(Point{1.0, 2.0, 3.0});
      }
      EXPECT_EQ(testing::allocations(), before) << edge;
    }
}

TEST(NeighbourFinder, RefusesOptionsThatMakeNoSense) {
  const auto says = [](const Options& options, const std::string& part) {
    const std::string text = testing::refusal([&] { NeighbourFinder finder(options); });
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  const double nan = std::nan("");
  for (const double cutoff : {0.0, -1.0, nan, 1e101}) says({.cutoffs = {cutoff}}, "must be from 1e-100 to 1e+100");
  says({.cutoffs = {}}, "0 cutoffs were given");
  says({.cutoffs = {1.0, 1.0}}, "species x species");
  says({.cutoffs = {1.0, 2.0, 3.0, 1.0}}, "must be equal");
  says({.cutoffs = {1.0, -2.0, -2.0, 1.0}}, "or 0 for species");
  says({.cutoffs = {0.0, 0.0, 0.0, 0.0}}, "one must be above 0");
  says({.cutoffs = {1.0}, .origin = {0.0, nan, 0.0}}, "y coordinate nan of the box's origin");
  says({.cutoffs = {1.0}, .threads = 0}, "0 threads are not allowed: from 1 to 4096");
  says({.cutoffs = {1.0}, .instruction_set = "avx9"}, "avx9");
  says({.cutoffs = {1.0}, .order = Order::any, .quantities = {.segments = true}}, "only sorted pairs");
}

TEST(NeighbourFinder, RefusesInputThatCannotBeSearchedAndGoesOn) {
  NeighbourFinder finder({.cutoffs = {1.0, 1.0, 1.0, 1.0}, .periodic = {true, true, false}});
  const auto says = [&](const System& system, const std::string& part) {
    const std::string text = testing::refusal([&] { finder.find(system.positions, system.box, system.species); });
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  EXPECT_NE(testing::refusal([&] { finder.neighbours(Point{}); }).find("set first"), std::string::npos);
  const double nan = std::nan("");
  for (const double edge : {0.0, -1.0, nan, 1e101}) says({{2.0, edge, 2.0}, {0, 0, 0}, {0}}, "box edge");
  says({{2.0, 0.03, 2.0}, {0, 0, 0}, {0}}, "0.96 is, 32 edges");
  says({{2.0, 2.0, 2.0}, {0, 0, 0, 0}, {0}}, "4 coordinates were given");
  says({{2.0, 2.0, 2.0}, {0, 0, 0, 0, nan, 0}, {0, 0}}, "y coordinate nan of particle 1 (from 0)");
  says({{2.0, 2.0, 2.0}, {0, 2.1e9, 0}, {0}}, "at most 1000000000 boxes away");
  says({{2.0, 2.0, 2.0}, {0, 0, std::numeric_limits<double>::infinity()}, {0}}, "z coordinate inf");
  says({{2.0, 2.0, 2.0}, {0, 0, 0}, {0, 1}}, "2 species were given for 1 particles");
  says({{2.0, 2.0, 2.0}, {0, 0, 0}, {}}, "0 species were given");
  says({{2.0, 2.0, 2.0}, {0, 0, 0}, {2}}, "cutoffs for 0 to 1");
  says({{2.0, 2.0, 2.0}, {0, 0, 0}, {-1}}, "species -1");
  const Bonds negative = {{0, -1}}, beyond = {{0, 2}};
  EXPECT_NE(testing::refusal([&] { finder.exclude(negative); }).find("numbered from 0"), std::string::npos);
  finder.exclude(beyond);
  says({{2.0, 2.0, 2.0}, {0, 0, 0, 0, 0, 0}, {0, 1}}, "there are 2 particles");
  finder.exclude({});
  EXPECT_EQ(finder.find(std::vector<double>{0, 0, 0, 0, 0, 0.5}, {2.5, 2.5, 0.0}, std::vector<std::int32_t>{0, 1}).count, 2U);
}

}  // namespace
}  // namespace lanescape
