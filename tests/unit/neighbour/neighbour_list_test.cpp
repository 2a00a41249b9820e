#include "neighbour/neighbour_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <tuple>
#include <vector>

#include "core/error.hpp"
#include "core/padded.hpp"
#include "every_isa.hpp"
#include "neighbour/neighbour_rows.hpp"

namespace lanescape {
namespace {

struct Fluid {
  Box box;
  std::vector<int> species;
  std::vector<double> positions;
};

// Particles at random positions, some of them boxes away.
Fluid random_fluid(const std::array<double, 3>& length, std::size_t particles, std::size_t species, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> place(-1.5, 2.5);
  Fluid fluid{{length}, {}, {}};
  for (std::size_t i = 0; i < particles; ++i) {
    fluid.species.push_back(static_cast<int>(i % species));
    for (const double edge : length) fluid.positions.push_back(edge * place(engine));
  }
  return fluid;
}

const std::vector<double> cutoffs = {1.5, 1.2, 1.2, 0.9};  // of two species

// A neighbour of a row: its particle and the separation, rounded to units coarser than rounding errors.
using Neighbour = std::tuple<std::size_t, long, long, long>;
using Neighbours = std::vector<std::vector<Neighbour>>;  // by particle, sorted

Neighbour neighbour(std::size_t particle, const std::array<double, 3>& d) {
  return {particle, std::lround(d[0] * 1e6), std::lround(d[1] * 1e6), std::lround(d[2] * 1e6)};
}

// Every image of every other particle within the cutoff: brute force, to check the list.
Neighbours by_force(const Fluid& fluid, const std::vector<double>& cutoffs_of_pairs, std::size_t species) {
  const std::size_t n = fluid.species.size();
  Neighbours found(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j) continue;
      const double cutoff =
          cutoffs_of_pairs[static_cast<std::size_t>(fluid.species[i]) * species + static_cast<std::size_t>(fluid.species[j])];
      std::array<double, 3> nearest{};
      std::array<int, 3> shells{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        nearest[axis] = fluid.box.nearest_image(axis, fluid.positions[3 * j + axis] - fluid.positions[3 * i + axis]);
        shells[axis] = static_cast<int>(std::ceil(cutoff / fluid.box.length[axis]));
      }
      for (int a = -shells[0]; a <= shells[0]; ++a)
        for (int b = -shells[1]; b <= shells[1]; ++b)
          for (int c = -shells[2]; c <= shells[2]; ++c) {
            const std::array<double, 3> d = {nearest[0] + a * fluid.box.length[0], nearest[1] + b * fluid.box.length[1],
                                             nearest[2] + c * fluid.box.length[2]};
            if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < cutoff * cutoff) found[i].push_back(neighbour(j, d));
          }
    }
  for (auto& neighbours : found) std::sort(neighbours.begin(), neighbours.end());
  return found;
}

// The list's neighbours within `cutoffs_of_pairs`, or all of them if that is empty.
Neighbours of_list(const NeighbourList& list, const ParticleLayout& layout, const std::vector<double>& cutoffs_of_pairs) {
  std::map<std::size_t, std::size_t> particle_in;
  for (std::size_t i = 0; i < layout.size(); ++i) particle_in[layout.slot_of(i)] = i;
  Neighbours found(layout.size());
  for (std::size_t b = 0; b < list.block_count(); ++b) {
    const kernels::NeighbourRows rows = list.rows_of(b);
    for_each_neighbour(rows, [&](std::size_t k, std::size_t s, std::uint32_t offset) {
      const double *self = rows.points + rows.rows[k], *other = rows.points + offset;
      const std::array<double, 3> d = {other[0] - self[0], other[1] - self[1], other[2] - self[2]};
      const double cutoff = cutoffs_of_pairs.empty() ? 1e9 : cutoffs_of_pairs[list.species_of(b) * rows.species_count + s];
      if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < cutoff * cutoff)
        found[particle_in.at(list.slot_at(rows.rows[k]))].push_back(neighbour(particle_in.at(list.slot_at(offset)), d));
    });
  }
  for (auto& neighbours : found) std::sort(neighbours.begin(), neighbours.end());
  return found;
}

NeighbourList make_list(const Fluid& fluid, const ParticleLayout& layout, double skin, Isa isa, int threads = 1) {
  return NeighbourList(fluid.box, layout, cutoffs, skin, kernel_table(isa), threads);
}

using NeighbourListOnEveryIsa = testing::EveryIsa;

INSTANTIATE_TEST_SUITE_P(EveryIsa, NeighbourListOnEveryIsa, testing::all_isas(), testing::isa_name);

// Large boxes, boxes of one cell, boxes shorter than the cutoff, of every shape; from zero to many particles per cell.
TEST_P(NeighbourListOnEveryIsa, HoldsEveryImageWithinTheCutoffInBoxesOfEverySize) {
  const std::vector<std::array<double, 3>> boxes = {{9.0, 9.0, 9.0}, {7.0, 5.5, 8.2},  {3.1, 3.0, 2.9}, {1.0, 1.1, 0.9},
                                                    {0.7, 0.6, 6.0}, {12.0, 0.8, 5.0}, {1.5, 1.5, 1.5}};
  unsigned seed = 0;
  for (const auto& box : boxes)
    for (const std::size_t particles : {0U, 1U, 2U, 3U, 17U, 64U, 301U}) {
      const Fluid fluid = random_fluid(box, particles, 2, ++seed);
      const ParticleLayout layout(fluid.species, 2);
      NeighbourList list = make_list(fluid, layout, 0.2, GetParam());
      list.update(layout.to_slots(fluid.positions));
      EXPECT_EQ(of_list(list, layout, cutoffs), by_force(fluid, cutoffs, 2))
          << particles << " particles in a box of " << box[0] << " x " << box[1] << " x " << box[2];
    }
}

TEST_P(NeighbourListOnEveryIsa, MissesNoPairWhileParticlesWander) {
  Fluid fluid = random_fluid({6.0, 5.0, 4.0}, 200, 2, 7);
  const ParticleLayout layout(fluid.species, 2);
  NeighbourList list = make_list(fluid, layout, 0.3, GetParam());
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> move(-0.04, 0.04);
  for (int step = 0; step < 60; ++step) {
    for (double& x : fluid.positions) x += move(engine);
    list.update(layout.to_slots(fluid.positions));
    ASSERT_EQ(of_list(list, layout, cutoffs), by_force(fluid, cutoffs, 2)) << "step " << step;
  }
  EXPECT_GT(list.rebuilds(), 3U);
  EXPECT_LT(list.rebuilds(), 40U);
}

// A liquid, a box of less than one reach, and one so sparse that its gaps are narrowed.
const std::vector<std::array<double, 3>> boxes_of_every_kind = {{6.0, 5.0, 4.0}, {1.0, 7.0, 1.3}, {300.0, 250.0, 400.0}};

TEST(NeighbourList, LastsAsLongForParticlesThatAreWrappedInEveryStep) {
  for (const auto& edges : boxes_of_every_kind) {
    Fluid fluid = random_fluid(edges, 100, 2, 19);
    for (std::size_t k = 0; k < 30; k += 2) fluid.positions[k] = edges[k % 3] - 0.02 * static_cast<double>(k);  // near a face
    const ParticleLayout layout(fluid.species, 2);
    NeighbourList unwrapped = make_list(fluid, layout, 0.3, available_isas().back()),
                  wrapped = make_list(fluid, layout, 0.3, available_isas().back(), 2);
    std::mt19937_64 engine(5);
    std::uniform_real_distribution<double> move(-0.03, 0.03);
    std::size_t crossings = 0;
    std::vector<double> before;
    for (int step = 0; step < 40; ++step) {
      for (double& x : fluid.positions) x += move(engine) + 0.01;
      Fluid inside = fluid;
      for (std::size_t k = 0; k < inside.positions.size(); ++k) inside.positions[k] = fluid.box.wrapped(k % 3, inside.positions[k]);
      for (std::size_t k = 0; k < before.size(); ++k) crossings += std::abs(inside.positions[k] - before[k]) > 0.5 * edges[k % 3];
      before = inside.positions;
      unwrapped.update(layout.to_slots(fluid.positions));
      wrapped.update(layout.to_slots(inside.positions));
      ASSERT_EQ(of_list(wrapped, layout, cutoffs), by_force(inside, cutoffs, 2)) << "step " << step << ", edge " << edges[0];
    }
    EXPECT_GT(crossings, 0U);
    EXPECT_EQ(wrapped.rebuilds(), unwrapped.rebuilds()) << "edge " << edges[0];
    EXPECT_LT(wrapped.rebuilds(), 20U);
  }
}

// The strain is up to 2 in 100, which uses up a fifth of the skin; particles follow the box, or stay where they are.
TEST_P(NeighbourListOnEveryIsa, MissesNoPairWhileTheBoxChanges) {
  for (const auto& edges : boxes_of_every_kind)
    for (const bool follow : {true, false}) {
      Fluid fluid = random_fluid(edges, 80, 2, 23);
      const ParticleLayout layout(fluid.species, 2);
      NeighbourList list = make_list(fluid, layout, 0.3, GetParam());
      std::mt19937_64 engine(29);
      std::uniform_real_distribution<double> move(-0.01, 0.01), stretch(-0.004, 0.004);
      for (int step = 0; step < 30; ++step) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double factor = 1.0 + stretch(engine);
          fluid.box.length[axis] *= factor;
          for (std::size_t k = axis; follow && k < fluid.positions.size(); k += 3) fluid.positions[k] *= factor;
        }
        for (double& x : fluid.positions) x += move(engine);
        list.set_box(fluid.box);
        list.update(layout.to_slots(fluid.positions));
        ASSERT_EQ(of_list(list, layout, cutoffs), by_force(fluid, cutoffs, 2)) << "step " << step << ", edge " << edges[0];
      }
      if (follow && edges[0] < 100.0) {
        EXPECT_LT(list.rebuilds(), 15U);
      }
    }
}

// A pair beyond the reach of the list and a box that carries it into range.
TEST(NeighbourList, IsMadeAnewBeforeAShrinkingBoxCanHaveBroughtAPairIntoRangeUnseen) {
  Fluid fluid{{{3.8, 1.9, 1.6}}, {0, 0}, {0.5, 0.5, 0.5, 0.5 + 1.5 + 0.3 + 1e-3, 0.5, 0.5}};
  const ParticleLayout layout(fluid.species, 2);
  NeighbourList list = make_list(fluid, layout, 0.3, available_isas().back());
  for (int step = 0; step < 100; ++step) {
    ASSERT_EQ((list.update(layout.to_slots(fluid.positions)), of_list(list, layout, cutoffs)), by_force(fluid, cutoffs, 2))
        << "step " << step;
    for (double& length : fluid.box.length) length *= 0.996;
    for (double& x : fluid.positions) x *= 0.996;
    list.set_box(fluid.box);
  }
  EXPECT_GT(list.rebuilds(), 1U);
  EXPECT_LT(list.rebuilds(), 10U);
}

TEST(NeighbourList, IsRebuiltOnceABoxHasUsedUpTheSkin) {
  Fluid fluid = random_fluid({6.0, 5.0, 4.0}, 50, 2, 31);
  const ParticleLayout layout(fluid.species, 2);
  NeighbourList list = make_list(fluid, layout, 0.3, available_isas().back());
  const auto rebuilds_at = [&](double factor) {
    Fluid scaled = fluid;
    for (double& length : scaled.box.length) length *= factor;
    for (double& x : scaled.positions) x *= factor;
    list.set_box(scaled.box);
    list.update(layout.to_slots(scaled.positions));
    return list.rebuilds();
  };
  EXPECT_EQ(rebuilds_at(1.0), 1U);
  EXPECT_EQ(rebuilds_at(1.0 - 0.99 * 0.3 / 1.8), 1U);
  EXPECT_EQ(rebuilds_at(1.0 + 0.99 * 0.3 / 1.8), 1U);
  EXPECT_EQ(rebuilds_at(1.0), 1U);
  EXPECT_EQ(rebuilds_at(1.0 - 1.01 * 0.3 / 1.8), 2U);
}

// Two particles that approach each other: the fastest way for a pair to come into range.
TEST(NeighbourList, IsMadeAnewBeforeTwoParticlesCanHaveComeIntoRangeUnseen) {
  Fluid fluid{{{20.0, 20.0, 20.0}}, {0, 0}, {5.0, 5.0, 5.0, 5.0 + 1.5 + 0.3 + 1e-3, 5.0, 5.0}};
  const ParticleLayout layout(fluid.species, 2);
  NeighbourList list = make_list(fluid, layout, 0.3, available_isas().back());
  list.update(layout.to_slots(fluid.positions));
  EXPECT_EQ(list.neighbours(), 0U);
  for (int step = 0; step < 400; ++step) {
    fluid.positions[0] += 1e-3;
    fluid.positions[3] -= 1e-3;
    list.update(layout.to_slots(fluid.positions));
    EXPECT_EQ(of_list(list, layout, cutoffs), by_force(fluid, cutoffs, 2)) << "step " << step;
  }
  EXPECT_LE(list.rebuilds(), 4U);
}

TEST(NeighbourList, IsTheSameWhateverTheNumberOfThreads) {
  for (const std::size_t particles : {1U, 40U, 700U}) {
    const Fluid fluid = random_fluid({8.0, 6.0, 7.0}, particles, 2, 11);
    const ParticleLayout layout(fluid.species, 2);
    const AlignedArray positions = layout.to_slots(fluid.positions);
    NeighbourList one = make_list(fluid, layout, 0.3, available_isas().back());
    one.update(positions);
    for (const int threads : {2, 3, 7}) {
      NeighbourList many = make_list(fluid, layout, 0.3, available_isas().back(), threads);
      many.update(positions);
      ASSERT_EQ(many.block_count(), one.block_count());
      for (std::size_t b = 0; b < one.block_count(); ++b) {
        const kernels::NeighbourRows x = one.rows_of(b), y = many.rows_of(b);
        ASSERT_EQ(x.row_count, y.row_count);
        EXPECT_TRUE(std::equal(x.rows, x.rows + x.row_count, y.rows));
        const std::size_t segments = x.row_count * x.species_count;
        ASSERT_TRUE(std::equal(x.lengths, x.lengths + segments, y.lengths));
        std::size_t offsets = 0;
        for (std::size_t k = 0; k < segments; ++k) offsets += padded(x.lengths[k]);
        EXPECT_TRUE(std::equal(x.neighbours, x.neighbours + offsets, y.neighbours));
      }
      // Exactly one part handles each block.
      EXPECT_EQ(many.first_block(0), 0U);
      EXPECT_EQ(many.first_block(many.parts()), many.block_count());
      for (std::size_t part = 0; part < many.parts(); ++part) EXPECT_LE(many.first_block(part), many.first_block(part + 1));
    }
  }
}

TEST(NeighbourList, HasAnEvenShareForEveryThread) {
  const Fluid fluid = random_fluid({14.0, 14.0, 14.0}, 4000, 2, 13);
  const ParticleLayout layout(fluid.species, 2);
  NeighbourList list = make_list(fluid, layout, 0.3, available_isas().back(), 4);
  list.update(layout.to_slots(fluid.positions));
  const std::size_t parts = list.parts();
  const auto work = [&](std::size_t thread) {
    std::size_t vectors = 0;  // counted in lanes
    for (std::size_t b = list.first_block(parts * thread / 4); b < list.first_block(parts * (thread + 1) / 4); ++b) {
      const kernels::NeighbourRows rows = list.rows_of(b);
      for_each_segment(rows, [&](std::size_t, std::size_t, auto offsets) { vectors += padded(offsets.size()); });
    }
    return static_cast<double>(vectors);
  };
  const double share = (work(0) + work(1) + work(2) + work(3)) / 4.0;
  for (std::size_t thread = 0; thread < 4; ++thread) EXPECT_NEAR(work(thread), share, 0.05 * share) << thread;
}

TEST(NeighbourList, RefusesCoordinatesThatAreNotFiniteOrTooFarAway) {
  for (const double edge : {5.0, 50.0})
    for (const Isa isa : available_isas()) {
      Fluid fluid = random_fluid({edge, edge, edge}, 50, 2, 17);
      const ParticleLayout layout(fluid.species, 2);
      const std::vector<double> sound = fluid.positions;
      for (const std::size_t coordinate : {0, 30, 149})
        for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -1e300}) {
          NeighbourList list = make_list(fluid, layout, 0.3, isa), moved = make_list(fluid, layout, 0.3, isa);
          fluid.positions = sound;
          moved.update(layout.to_slots(fluid.positions));
          fluid.positions[coordinate] = bad;
          const std::string where = std::string(to_string(isa)) + ", coordinate " + std::to_string(coordinate);
          EXPECT_THROW(list.update(layout.to_slots(fluid.positions)), Error) << where << " is " << bad;
          EXPECT_THROW(moved.update(layout.to_slots(fluid.positions)), Error) << where << " becomes " << bad;
        }
    }
}

}  // namespace
}  // namespace lanescape
