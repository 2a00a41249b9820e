#include "dynamics/maxwell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace lanescape {
namespace {

// Two species of unequal numbers, in blocks that both need padding.
const std::vector<int> species = {0, 1, 0, 0, 1, 0, 0, 0, 1};
const std::vector<double> masses = {1.0, 4.0};

AlignedArray drawn(const ParticleLayout& layout, double temperature, std::uint64_t seed = 3) {
  AlignedArray velocity(layout.dimension(), 0.0);
  draw_maxwell_velocities(particles_of(layout, masses, velocity), [&](double mass) { return std::sqrt(temperature / mass); }, seed);
  return velocity;
}

TEST(Maxwell, ParticleKHasTheNormalNumbersOfParticleKTimesTheWidthOfItsMass) {
  const ParticleLayout layout(species, 2);
  const AlignedArray velocity = drawn(layout, 2.25);
  const CounterRandom random(3, RandomStream::velocities);
  std::uint32_t particle = 0;
  for (std::size_t s = 0; s < 2; ++s)
    for (std::size_t k = 0; k < layout.blocks()[s].count; ++k, ++particle)
      for (std::uint32_t axis = 0; axis < 3; ++axis)
        EXPECT_EQ(velocity[axis * layout.slots() + layout.blocks()[s].begin + k],
                  (s == 0 ? 1.5 : 0.75) * random.normal(0, particle, axis));
  EXPECT_EQ(particle, 9U);
}

TEST(Maxwell, PaddingStaysZero) {
  const ParticleLayout layout(species, 2);
  std::size_t moving = 0;
  for (const double v : drawn(layout, 1.0)) moving += v != 0.0 ? 1 : 0;
  EXPECT_EQ(moving, 27U);
}

TEST(Maxwell, SeedsDecideTheVelocities) {
  const ParticleLayout layout(species, 2);
  EXPECT_EQ(drawn(layout, 1.0, 5), drawn(layout, 1.0, 5));
  EXPECT_NE(drawn(layout, 1.0, 5), drawn(layout, 1.0, 6));
}

TEST(Maxwell, RemovingTheMomentumSubtractsTheVelocityOfTheCentreOfMassFromEveryParticle) {
  const ParticleLayout layout(species, 2);
  const AlignedArray before = drawn(layout, 1.0);
  AlignedArray after = before;
  const auto particles = particles_of(layout, masses, after);
  const Point momentum = total_momentum(particles);
  EXPECT_GT(std::abs(momentum[0]), 0.1);
  remove_momentum(particles);
  for (const double p : total_momentum(particles)) EXPECT_NEAR(p, 0.0, 1e-14);
  // Six particles of mass 1 and three of mass 4.
  const std::vector<double> from = layout.to_user(before), to = layout.to_user(after);
  for (std::size_t k = 0; k < from.size(); ++k) EXPECT_NEAR(from[k] - to[k], momentum[k % 3] / 18.0, 1e-14);
}

}  // namespace
}  // namespace lanescape
