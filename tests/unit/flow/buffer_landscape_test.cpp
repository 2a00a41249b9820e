#include "flow/buffer_landscape.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "dynamics/velocity_verlet.hpp"
#include "open_slab.hpp"

namespace lanescape {
namespace {

struct Slab {
  PairModel model = lennard_jones();
  FluidState fluid = testing::slab_fluid(model);
  ParticleLayout layout = ParticleLayout::in_users_order(fluid.configuration, 1);
  PairLandscape pairs{model, fluid.configuration.box, layout, choose_isa("auto")};
  SlabGeometry geometry{fluid.configuration.box, 4.0, 2.0};
};

Outside::Demands sheared() {
  Outside::Demands demands = testing::slab_demands(0.0);
  demands[0].shear = {0.3, -0.2};
  demands[1].pressure = 1.5;
  return demands;
}

TEST(BufferLandscape, TheForceOnEachBufferIsThatOfTheOutsideInEveryStep) {
  Slab slab;
  BufferLandscape buffered(slab.pairs, slab.layout, slab.geometry, sheared(), 1.0, 0.002);
  VelocityVerlet verlet(buffered, slab.model, slab.layout, slab.layout.to_slots(slab.fluid.configuration.positions), 0.002);
  verlet.set_velocity(slab.layout.to_slots(slab.fluid.velocities));
  AlignedArray with(slab.layout.dimension(), 0.0), without(slab.layout.dimension(), 0.0);
  for (int step = 0; step < 20; ++step) {
    EXPECT_NEAR(buffered.force(0)[0], testing::slab_pressure * 64.0, 1e-11);
    EXPECT_NEAR(buffered.force(0)[1], 0.3 * 64.0, 1e-11);
    EXPECT_NEAR(buffered.force(0)[2], -0.2 * 64.0, 1e-11);
    EXPECT_NEAR(buffered.force(1)[0], -1.5 * 64.0, 1e-11);
    EXPECT_EQ(buffered.force(1)[1], 0.0);
    verlet.step();
  }
  // The gradients differ by these forces and by nothing else.
  BufferLandscape fresh(slab.pairs, slab.layout, slab.geometry, sheared(), 1.0, 0.002);
  fresh.energy_and_gradient(verlet.position(), with);
  slab.pairs.energy_and_gradient(verlet.position(), without);
  double total = 0.0;
  for (std::size_t slot = 0; slot < slab.layout.size(); ++slot) {
    const double x = verlet.position()[slot], force = without[slot] - with[slot];
    total += force;
    if (x > 4.0 && x < 20.0) {
      EXPECT_EQ(force, 0.0);
    }
    EXPECT_GE(x < 12.0 ? force : -force, 0.0) << x;
  }
  EXPECT_NEAR(total, (testing::slab_pressure - 1.5) * 64.0, 1e-10);
}

TEST(BufferLandscape, ImpulseAndWorkAreWhatTheParticlesGain) {
  Slab slab;
  BufferLandscape buffered(slab.pairs, slab.layout, slab.geometry, sheared(), 1.0, 0.0005);
  VelocityVerlet verlet(buffered, slab.model, slab.layout, slab.layout.to_slots(slab.fluid.configuration.positions), 0.0005);
  verlet.set_velocity(slab.layout.to_slots(slab.fluid.velocities));
  const auto momentum = [&](std::size_t axis) {
    const auto begin = verlet.velocity().begin() + static_cast<std::ptrdiff_t>(axis * slab.layout.slots());
    return std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(slab.layout.slots()), 0.0);
  };
  const Point before = {momentum(0), momentum(1), momentum(2)};
  const double energy = verlet.potential_energy() + verlet.kinetic_energy();
  for (int step = 0; step < 200; ++step) verlet.step();
  const Outside::Reports& reports = buffered.reports();
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(momentum(axis) - before[axis], reports[0].impulse[axis] - reports[1].impulse[axis], 1e-9);
  EXPECT_NEAR(reports[0].impulse[0], testing::slab_pressure * 64.0 * 200 * 0.0005, 1e-10);
  const double gained = verlet.potential_energy() + verlet.kinetic_energy() - energy, work = reports[0].energy - reports[1].energy;
  EXPECT_GT(std::abs(work), 1.0);
  EXPECT_NEAR(gained, work, 0.02);  // of the integrator
}

TEST(BufferLandscape, ForcesAcrossPlanesAreThoseOfThePairsThatTheySeparate) {
  const PairModel model = lennard_jones();
  const Configuration two{testing::slab_box(), {0, 0, 0}, {10.3, 4.0, 4.0, 11.5, 4.0, 4.0, 20.0, 4.0, 4.0}};
  const ParticleLayout layout = ParticleLayout::in_users_order(two, 1);
  PairLandscape pairs(model, two.box, layout, choose_isa("auto"));
  BufferLandscape buffered(pairs, layout, SlabGeometry(two.box, 4.0, 1.0), testing::slab_demands(0.0), 1.0, 0.002);
  AlignedArray gradient(layout.dimension(), 0.0);
  buffered.energy_and_gradient(layout.to_slots(two.positions), gradient);
  const double attraction = -24.0 * (2.0 * std::pow(1.2, -13) - std::pow(1.2, -7));
  ASSERT_GT(attraction, 0.0);
  for (std::size_t plane = 0; plane < 24; ++plane)  // plane k lies at k + 1
    EXPECT_NEAR(buffered.forces_across()[plane], plane == 10 ? -attraction : 0.0, 1e-12) << plane;
}

TEST(BufferLandscape, CountsWhatPassesPlanes) {
  const PairModel model = lennard_jones();
  const Configuration far{testing::slab_box(), {0, 0}, {9.95, 1.0, 1.0, 15.05, 5.0, 5.0}};
  const ParticleLayout layout = ParticleLayout::in_users_order(far, 1);
  PairLandscape pairs(model, far.box, layout, choose_isa("auto"));
  BufferLandscape buffered(pairs, layout, SlabGeometry(far.box, 4.0, 1.0), {}, 2.0, 0.01);
  VelocityVerlet verlet(buffered, model, layout, layout.to_slots(far.positions), 0.01);
  verlet.set_velocity(layout.to_slots(std::vector<double>{1.0, 0.0, 0.0, -3.0, 0.0, 0.0}));
  for (int step = 0; step < 10; ++step) verlet.step();
  for (std::size_t plane = 0; plane < 24; ++plane) {
    EXPECT_EQ(buffered.passages().particles[plane], plane == 9 ? 1.0 : plane == 14 ? -1.0 : 0.0) << plane;
    EXPECT_NEAR(buffered.passages().momentum[plane], plane == 9 ? 2.0 : plane == 14 ? 6.0 : 0.0, 1e-9) << plane;
  }
  EXPECT_TRUE(buffered.emptied());  // nobody bears the force
}

}  // namespace
}  // namespace lanescape
