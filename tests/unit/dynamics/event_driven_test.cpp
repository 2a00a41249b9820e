#include "dynamics/event_driven.hpp"

#include <gtest/gtest.h>

#include <cfenv>

#include "configuration/lattice.hpp"
#include "every_isa.hpp"
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

}  // namespace
}  // namespace lanescape
