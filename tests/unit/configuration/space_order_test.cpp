#include "configuration/space_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "configuration/lattice.hpp"
#include "core/error.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "memory_archive.hpp"
#include "neighbour/neighbour_list.hpp"

namespace lanescape {
namespace {

// A mixture whose order has nothing to do with its places.
Configuration shuffled(std::size_t particles) {
  const Configuration start = fcc_start(kob_andersen(), particles, 1.2, 1);
  std::vector<std::size_t> order(particles);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937_64(1));
  Configuration mixed{start.box, {}, {}};
  for (const std::size_t i : order) {
    mixed.species.push_back(start.species[i]);
    for (const double x : start.position(i)) mixed.positions.push_back(x);
  }
  return mixed;
}

SpaceOrder order_of(const Configuration& c) { return {c.species, c.diameters, 2}; }

void displace(Configuration& c, double by, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> move(0.0, by);
  for (double& x : c.positions) x += move(engine);
}

TEST(SpaceOrder, SortsLargeSystemsAtTheFirstPositions) {
  const Configuration large = shuffled(4000), small = shuffled(1372);
  SpaceOrder order = order_of(large), none = order_of(small);
  EXPECT_EQ(order.layout().order(), ParticleLayout::in_users_order(large, 2).order());
  EXPECT_TRUE(order.renew(large.positions, large.box, 0));
  EXPECT_EQ(order.layout().order(), ParticleLayout::in_space_order(large, 2).order());
  EXPECT_FALSE(order.renew(large.positions, large.box, 1000));
  EXPECT_FALSE(none.renew(small.positions, small.box, 0));
}

TEST(SpaceOrder, SortsAgainOnlyOnceParticlesHaveDiffusedAndTheListWasRebuiltOften) {
  Configuration c = shuffled(4000);
  SpaceOrder order = order_of(c);
  order.renew(c.positions, c.box, 0);
  displace(c, 0.7, 2);
  EXPECT_FALSE(order.renew(c.positions, c.box, SpaceOrder::rebuilds_per_look));
  displace(c, 3.0, 3);
  EXPECT_FALSE(order.renew(c.positions, c.box, 2 * SpaceOrder::rebuilds_per_look - 1));
  EXPECT_TRUE(order.renew(c.positions, c.box, 2 * SpaceOrder::rebuilds_per_look));
  EXPECT_EQ(order.layout().order(), ParticleLayout::in_space_order(c, 2).order());
  // The next list counts from zero.
  displace(c, 3.0, 4);
  EXPECT_FALSE(order.renew(c.positions, c.box, SpaceOrder::rebuilds_per_look - 1));
  EXPECT_TRUE(order.renew(c.positions, c.box, SpaceOrder::rebuilds_per_look));
}

TEST(SpaceOrder, IsNotDisturbedByWrapping) {
  Configuration c = shuffled(4000);
  SpaceOrder order = order_of(c);
  order.renew(c.positions, c.box, 0);
  for (std::size_t k = 0; k < c.positions.size(); ++k) c.positions[k] += static_cast<double>(k % 5) * c.box.length[k % 3];
  EXPECT_FALSE(order.renew(c.positions, c.box, 100));
}

TEST(SpaceOrder, GivesTheSameEnergyAndForcesUpToRounding) {
  const Configuration c = shuffled(4000);
  SpaceOrder order = order_of(c);
  const auto forces = [&] {
    const ParticleLayout& layout = order.layout();
    PairInteraction interaction(kob_andersen(), c.box, layout, kernel_table(available_isas().back()));
    AlignedArray gradient(layout.dimension());
    std::vector<double> result(3 * c.size());
    interaction.gradient(layout.to_slots(c.positions), gradient);
    layout.put_user(gradient, result);
    result.push_back(interaction.energy(layout.to_slots(c.positions)));
    return result;
  };
  const std::vector<double> before = forces();
  ASSERT_TRUE(order.renew(c.positions, c.box, 0));
  const std::vector<double> after = forces();
  for (std::size_t k = 0; k < before.size(); ++k) EXPECT_NEAR(after[k], before[k], 1e-11 * (10.0 + std::fabs(before[k])));
}

TEST(SpaceOrder, IsArchivedSoThatACopyGoesOnAlike) {
  Configuration c = shuffled(4000);
  SpaceOrder order = order_of(c), copy = order_of(c), untouched = order_of(c);
  testing::hand_on(order, untouched);
  EXPECT_EQ(untouched.layout().order(), order.layout().order());
  order.renew(c.positions, c.box, 0);
  displace(c, 3.0, 5);
  order.renew(c.positions, c.box, 15);
  testing::hand_on(order, copy);
  EXPECT_EQ(copy.layout().order(), order.layout().order());
  for (const std::uint64_t rebuilds : {15U, 16U, 17U}) {
    EXPECT_EQ(copy.renew(c.positions, c.box, rebuilds), order.renew(c.positions, c.box, rebuilds)) << rebuilds;
    EXPECT_EQ(copy.layout().order(), order.layout().order());
  }
}

TEST(SpaceOrder, RefusesToSortWhatIsNotFinite) {
  Configuration c = shuffled(4000);
  SpaceOrder order = order_of(c);
  c.positions[7000] = std::nan("");
  EXPECT_THROW(order.renew(c.positions, c.box, 0), Error);
  c.positions[7000] = 1.0;
  EXPECT_TRUE(order.renew(c.positions, c.box, 0));
}

}  // namespace
}  // namespace lanescape
