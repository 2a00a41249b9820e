#include "flow/open_slab.hpp"

#include <gtest/gtest.h>

#include "flow/constant_outside.hpp"
#include "memory_archive.hpp"
#include "open_slab.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

using testing::refusal;

ConstantOutside flowing(double velocity) {
  ConstantOutsideOptions options;
  options.demands = testing::slab_demands(velocity);
  options.impedance = 2.06;
  options.area = 64.0;
  return ConstantOutside(options);
}

TEST(OpenSlab, ParticlesMomentumAndEnergyBalance) {
  const PairModel model = lennard_jones();
  ConstantOutside outside = flowing(0.3);
  OpenSlab slab(model, testing::slab_fluid(model), testing::slab_options(), outside);
  for (int k = 0; k < 60; ++k) ASSERT_EQ(slab.advance(), FlowOutcome::followed);
  const FlowBalance& balance = slab.balance();
  EXPECT_EQ(balance.now.particles - balance.start.particles, balance.passed.particles);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(balance.now.momentum[axis] - balance.start.momentum[axis], balance.passed.momentum[axis], 1e-9) << axis;
  EXPECT_NEAR(balance.energy_error(), 0.0, 1e-3);
  // The flux was followed: 0.15 * 64 * 6 = 57.6 particles at each face, but for the last interval and what the buffer kept.
  const auto net = [&](std::size_t face) {
    const FaceExchange::Counts& c = balance.faces[face];
    return static_cast<double>(c.put_in) - static_cast<double>(c.left) - static_cast<double>(c.taken_out);
  };
  EXPECT_NEAR(net(0), 57.6, 3.0);
  EXPECT_NEAR(net(1), -57.6, 20.0);
  EXPECT_GT(balance.now.momentum[0], 10.0);
}

TEST(OpenSlab, ThreadsAndInterruptionsChangeNoBit) {
  const PairModel model = lennard_jones();
  const FluidState start = testing::slab_fluid(model);
  ConstantOutside outside = flowing(0.3), other = flowing(0.3), third = flowing(0.3);
  OpenSlab whole(model, start, testing::slab_options(), outside);
  OpenSlabOptions threads = testing::slab_options();
  threads.threads = 2;
  OpenSlab first(model, start, threads, other);
  for (int k = 0; k < 4; ++k) {
    whole.advance();
    first.advance();
  }
  testing::MemoryArchive archive;
  first.exchange(archive);
  archive.rewind();
  OpenSlab resumed(model, start, testing::slab_options(), third);
  resumed.exchange(archive);
  for (int k = 0; k < 4; ++k) {
    whole.advance();
    resumed.advance();
  }
  EXPECT_EQ(whole.fluid().configuration.positions, resumed.fluid().configuration.positions);
  EXPECT_EQ(whole.fluid().velocities, resumed.fluid().velocities);
  EXPECT_EQ(whole.balance().passed.energy, resumed.balance().passed.energy);
  EXPECT_EQ(whole.sampler().profile().density, resumed.sampler().profile().density);
  EXPECT_EQ(whole.demands()[0].pressure, resumed.demands()[0].pressure);
}

TEST(OpenSlab, ProfilesAreThoseOfTheFluid) {
  const PairModel model = lennard_jones();
  ConstantOutside outside = flowing(0.0);
  OpenSlab slab(model, testing::slab_fluid(model), testing::slab_options(), outside);
  for (int k = 0; k < 40; ++k) ASSERT_EQ(slab.advance(), FlowOutcome::followed);
  const FlowProfile means = slab.sampler().profile();
  ASSERT_EQ(means.x.size(), 12u);
  double density = 0.0, temperature = 0.0, pressure = 0.0;
  for (std::size_t slice = 3; slice < 9; ++slice) {
    density += means.density[slice] / 6.0;
    temperature += means.temperature[slice] / 6.0;
    pressure += means.pressure[slice] / 6.0;
  }
  EXPECT_NEAR(density, testing::slab_density, 0.04);
  EXPECT_NEAR(temperature, testing::slab_temperature, 0.25);
  EXPECT_NEAR(pressure, testing::slab_pressure, 0.25);
  EXPECT_LT(means.density.front(), 0.9 * density);
}

TEST(OpenSlab, AFailureKeepsTheState) {
  const PairModel model = lennard_jones();
  ConstantOutside outside = flowing(2000.0);
  OpenSlab slab(model, testing::slab_fluid(model), testing::slab_options(), outside);
  while (slab.advance() == FlowOutcome::followed) ASSERT_LT(slab.steps(), 1000u);
  EXPECT_EQ(slab.outcome(), FlowOutcome::rate_too_high);
  const std::size_t particles = slab.fluid().configuration.size();
  EXPECT_GT(particles, 100u);
  EXPECT_EQ(slab.advance(), FlowOutcome::rate_too_high);
  EXPECT_EQ(slab.fluid().configuration.size(), particles);
}

TEST(OpenSlab, RefusesWhatItCannotUse) {
  const PairModel model = lennard_jones();
  const Box box = testing::slab_box();
  const auto refused = [&](auto change) {
    OpenSlabOptions options = testing::slab_options();
    options.check(model, box);
    change(options);
    return refusal([&] { options.check(model, box); });
  };
  EXPECT_NE(refused([](OpenSlabOptions& o) { o.buffer = 13.0; }).find("buffer width 13"), std::string::npos);
  EXPECT_NE(refused([](OpenSlabOptions& o) { o.slice = 0.0; }).find("slice"), std::string::npos);
  EXPECT_NE(refused([](OpenSlabOptions& o) { o.time_step = 0.1; }).find("time step"), std::string::npos);
  EXPECT_NE(refused([](OpenSlabOptions& o) { o.faces.nearest = 5.0; }).find("insertion from 5 to 2.5"), std::string::npos);
  EXPECT_NE(refused([](OpenSlabOptions& o) { o.faces.thermostat_rate = -1.0; }).find("thermostat"), std::string::npos);
  EXPECT_NE(refused([](OpenSlabOptions& o) { o.steps_per_exchange = 0; }).find("steps per exchange"), std::string::npos);
  EXPECT_NE(refusal([&] { testing::slab_options().check(model, {box.length}); }).find("open along x"), std::string::npos);
  EXPECT_NE(refusal([&] { testing::slab_options().check(kob_andersen(), box); }).find("one species"), std::string::npos);
  PairModel tail = model;
  tail.truncation = Truncation::tail;
  EXPECT_NE(refusal([&] { testing::slab_options().check(tail, box); }).find("tail"), std::string::npos);
}

}  // namespace
}  // namespace lanescape
