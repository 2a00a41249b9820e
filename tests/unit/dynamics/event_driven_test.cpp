#include "dynamics/event_driven.hpp"

#include <gtest/gtest.h>

#include <cfenv>

#include "configuration/lattice.hpp"
#include "core/random.hpp"
#include "every_isa.hpp"
#include "memory_archive.hpp"
#include "own_process.hpp"

namespace lanescape {
namespace {

class EventDrivenInAnyHost : public testing::EveryIsa {
 protected:
  static EventDriven spheres() {
    const Configuration start = hard_sphere_start(hard_sphere_binary(), 64, 0.25, Arrangement::random, 1);
    EventDriven dynamics(start, std::vector<double>(start.size(), 1.0), kernel_table(GetParam()));
    dynamics.draw_velocities(1);
    return dynamics;
  }
  static std::vector<double> positions_after_collisions(EventDriven dynamics) {
    for (int k = 0; k < 500; ++k) dynamics.collide();
    dynamics.resynchronise();
    dynamics.advance_to(dynamics.time() + 0.1);
    return dynamics.positions();
  }
};
INSTANTIATE_TEST_SUITE_P(EveryIsa, EventDrivenInAnyHost, testing::all_isas(), testing::isa_name);

TEST_P(EventDrivenInAnyHost, NoTrapStrikes) {
  const std::vector<double> expected = positions_after_collisions(spheres());
  EXPECT_EQ(testing::status_of([&] {
              feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
              return positions_after_collisions(spheres()) == expected;
            }),
            0);
}

TEST_P(EventDrivenInAnyHost, BitsDoNotDependOnTheRoundingMode) {
  const std::vector<double> expected = positions_after_collisions(spheres());
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    EventDriven dynamics = spheres();
    std::fesetround(mode);
    for (int k = 0; k < 500; ++k) dynamics.collide();
    dynamics.resynchronise();
    std::fesetround(FE_TONEAREST);
    dynamics.advance_to(dynamics.time() + 0.1);
    EXPECT_EQ(dynamics.positions(), expected) << mode;
  }
}

// Large enough for an order of its own inside, with particles in random order.
struct LargeLiquid {
  static constexpr std::size_t particles = 10'976;
  Configuration start = hard_sphere_start(hard_sphere_binary(), particles, 0.3, Arrangement::random, 1);
  std::vector<double> masses, velocities;

  LargeLiquid() {
    const CounterRandom random(3, RandomStream::velocities);
    for (std::uint32_t i = 0; i < particles; ++i) {
      const Point v = random.velocity(1.0, 0, i);
      velocities.insert(velocities.end(), v.begin(), v.end());
      masses.push_back(i % 3 == 0 ? 2.5 : 0.7);
    }
  }
  EventDriven moving() const {
    EventDriven dynamics(start, masses, kernel_table(available_isas().back()));
    dynamics.set_velocities(velocities);
    return dynamics;
  }
  // Particle i becomes particle 7919 i mod N: the factor is a prime that does not divide N.
  static std::size_t renamed(std::size_t i) { return i * 7919 % particles; }
  template <class T>
  static std::vector<T> renamed(const std::vector<T>& values) {
    std::vector<T> out(values.size());
    const std::size_t width = values.size() / particles;
    for (std::size_t i = 0; i < values.size(); ++i) out[renamed(i / width) * width + i % width] = values[i];
    return out;
  }
};

void collide(EventDriven& dynamics, std::uint64_t collisions) {
  for (std::uint64_t k = 0; k < collisions; ++k) dynamics.collide();
}

TEST(EventDrivenInLargeSystems, ParticlesKeepTheirNumbersWhateverTheirOrder) {
  LargeLiquid liquid;
  EventDriven dynamics = liquid.moving();
  liquid.start.positions = LargeLiquid::renamed(liquid.start.positions);
  liquid.start.radii = LargeLiquid::renamed(liquid.start.radii);
  liquid.masses = LargeLiquid::renamed(liquid.masses);
  liquid.velocities = LargeLiquid::renamed(liquid.velocities);
  EventDriven renamed = liquid.moving();
  for (EventDriven* const both : {&dynamics, &renamed})
    for (int sorted = 0; sorted < 2; ++sorted) {
      collide(*both, 15'000);
      both->resynchronise();
    }
  const auto expected = LargeLiquid::renamed(dynamics.positions()), positions = renamed.positions();
  // Sums over all particles, as in the choice of the shells, differ by rounding.
  for (std::size_t c = 0; c < positions.size(); ++c) ASSERT_NEAR(positions[c], expected[c], 1e-6) << "coordinate " << c;
  for (std::size_t i = 0; i < LargeLiquid::particles; ++i)
    ASSERT_EQ(renamed.radius(LargeLiquid::renamed(i)), dynamics.radius(i)) << "particle " << i;
  EXPECT_NEAR(renamed.kinetic_energy(), dynamics.kinetic_energy(), 1e-9 * dynamics.kinetic_energy());
}

TEST(EventDrivenInLargeSystems, AStateReadAtAResynchronisationGoesOnWithTheSameBits) {
  const LargeLiquid liquid;
  EventDriven whole = liquid.moving(), resumed = liquid.moving();
  collide(whole, whole.resync_interval());
  ASSERT_TRUE(whole.at_resync());
  collide(resumed, 10'000);  // it has another order inside when it reads
  resumed.resynchronise();
  testing::hand_on(whole, resumed);
  for (EventDriven* const both : {&whole, &resumed}) collide(*both, 120'000);
  EXPECT_EQ(resumed.positions(), whole.positions());
  EXPECT_EQ(resumed.velocities(), whole.velocities());
  EXPECT_EQ(resumed.virial(), whole.virial());
  EXPECT_EQ(resumed.time(), whole.time());
}

}  // namespace
}  // namespace lanescape
