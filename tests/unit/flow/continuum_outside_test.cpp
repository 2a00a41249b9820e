#include "flow/continuum_outside.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "fluid_slab.hpp"
#include "memory_archive.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

using namespace testing;

ContinuumOptions with_pulse(double amplitude) {
  ContinuumOptions options;
  options.cutoff = 3.0;
  options.planes = {0.0, 30.0};
  options.area = 120.0;
  options.pulse = Pulse{amplitude, -50.0, 8.0};
  return options;
}

// Two regions and a fluid between them.
struct Coupled {
  explicit Coupled(const ContinuumOptions& options)
      : outside(options), slab(options), demands(outside.begin(slab.initial())), interval(0.9 * options.longest_interval()) {}
  void run(double time) {
    for (double t = 0.0; t < time; t += interval, elapsed += interval)
      demands = outside.advance(slab.run(demands, interval), interval);
  }
  std::vector<FlowState> flow() const {
    std::vector<FlowState> all = outside.left().flow();
    for (const auto* part : {&slab.solver().flow(), &outside.right().flow()}) all.insert(all.end(), part->begin(), part->end());
    return all;
  }

  ContinuumOutside outside;
  FluidSlab slab;
  Outside::Demands demands;
  double interval, elapsed = 0.0;
};

std::vector<FlowState> flow_alone(const ContinuumOptions& options, double time) {
  CompressibleSolver alone = solver_alone(options);
  alone.advance(time, {options.reservoir(), options.reservoir()});
  return alone.flow();
}

// The largest difference of densities of cells in [begin, end).
double difference(const std::vector<FlowState>& a, const std::vector<FlowState>& b, std::size_t begin, std::size_t end) {
  double largest = 0.0;
  for (std::size_t i = begin; i < end; ++i) largest = std::max(largest, std::abs(a[i].fluid.density - b[i].fluid.density));
  return largest;
}

// Height and place of the pulse: the extremum, and the first moment of what is above a fifth of it.
std::array<double, 2> height_and_place(const std::vector<FlowState>& flow) {
  double height = 0.0, sum = 0.0, moment = 0.0;
  for (const FlowState& cell : flow) {
    const double change = cell.fluid.density - 0.5;
    if (std::abs(change) > std::abs(height)) height = change;
  }
  for (std::size_t i = 0; i < flow.size(); ++i) {
    const double change = flow[i].fluid.density - 0.5;
    if (change / height < 0.2) continue;
    sum += change;
    moment += change * (static_cast<double>(i) - 99.5);
  }
  return {height, moment / sum};
}

TEST(ContinuumOutside, APulsePassesBothPlanesAsInTheSolverAlone) {
  for (const double amplitude : {0.01, 0.1, -0.05}) {
    const ContinuumOptions options = with_pulse(amplitude);
    Coupled coupled(options);
    // It is at the left plane, at the right one, and beyond.
    for (const double time : {12.0, 10.0, 10.0}) {
      coupled.run(time);
      const auto found = coupled.flow(), alone = flow_alone(options, coupled.elapsed);
      ASSERT_EQ(found.size(), alone.size());
      const auto [height, place] = height_and_place(alone);
      EXPECT_NEAR(height_and_place(found)[0] / height, 1.0, 0.015);
      EXPECT_NEAR(height_and_place(found)[1], place, 0.2);
      EXPECT_LT(difference(found, alone, 0, 230), 0.04 * std::abs(height));
    }
    // The echo in the left region, in the slab, and what has changed of the pulse.
    const auto found = coupled.flow(), alone = flow_alone(options, coupled.elapsed);
    const double height = std::abs(height_and_place(alone)[0]);
    EXPECT_LT(difference(found, alone, 0, 100), 0.001 * height);
    EXPECT_LT(difference(found, alone, 100, 130), 0.002 * height);
    EXPECT_LT(difference(found, alone, 130, 230), 0.002 * height);
  }
}

TEST(ContinuumOutside, FluidsAndSlabConserveMassMomentumAndEnergy) {
  ContinuumOptions options = with_pulse(0.1);
  options.velocity = 0.2;
  Coupled coupled(options);
  const auto total = [&] {
    Conserved sum{};
    for (const auto* solver : {&coupled.outside.left(), &coupled.slab.solver(), &coupled.outside.right()})
      for (std::size_t c = 0; c < 5; ++c) sum[c] += solver->total()[c];
    return sum;
  };
  const Conserved before = total(), left_before = coupled.outside.left().total();
  Conserved in{};
  for (int k = 0; k < 300; ++k) {
    coupled.run(coupled.interval / 2.0);
    for (std::size_t c = 0; c < 5; ++c) in[c] += coupled.outside.left().passed()[0][c] - coupled.outside.right().passed()[1][c];
  }
  const Conserved after = total();
  for (std::size_t c = 0; c < 5; ++c) EXPECT_NEAR(after[c] - before[c], in[c], 1e-10);
  EXPECT_GT(std::abs(coupled.outside.left().total()[4] - left_before[4]), 0.5);
  EXPECT_NEAR(coupled.elapsed, 300.0 * coupled.interval, 1e-9);
}

TEST(ContinuumOutside, AUniformFlowGoesOnForEver) {
  ContinuumOptions options = with_pulse(0.0);
  options.velocity = 0.3;
  Coupled coupled(options);
  coupled.run(20.0);
  const ThermodynamicState fluid = options.reservoir().fluid;
  for (const FaceDemand& demand : coupled.demands) {
    EXPECT_NEAR(demand.pressure, fluid.pressure, 1e-9);
    EXPECT_NEAR(demand.mass_flux, 0.15, 1e-9);
    EXPECT_NEAR(demand.velocity[0], 0.3, 1e-9);
    EXPECT_NEAR(demand.temperature, 2.5, 1e-9);
    EXPECT_NEAR(demand.energy.value(), fluid.excess_energy(), 1e-9);
    EXPECT_NEAR(demand.heat_flux, 0.0, 1e-9);
  }
  EXPECT_LT(difference(coupled.flow(), flow_alone(options, 1.0), 0, 230), 1e-9);
}

TEST(ContinuumOutside, ASlabThatSlidesOrIsHotIsSlowedAndCooledAtBothFaces) {
  const ContinuumOptions options = with_pulse(0.0);
  ContinuumOutside outside(options);
  Outside::Reports reports = FluidSlab(options).initial();
  for (FaceReport& report : reports) {
    report.velocity[1] = 0.4;
    report.velocity[2] = -0.2;
    report.energy_per_particle += 0.5 * (0.4 * 0.4 + 0.2 * 0.2);
  }
  for (const FaceDemand& demand : outside.begin(reports)) {
    EXPECT_NEAR(demand.shear[0], -0.68 * 0.4, 1e-12);  // over the distance of cell and slice, 1
    EXPECT_NEAR(demand.shear[1], 0.68 * 0.2, 1e-12);
  }
  reports = FluidSlab(options).initial();
  for (FaceReport& report : reports) report.energy_per_particle += 0.1;
  const Outside::Demands demands = outside.begin(reports);
  EXPECT_LT(demands[0].heat_flux, -0.1);
  EXPECT_GT(demands[1].heat_flux, 0.1);
  EXPECT_LT(demands[0].mass_flux, 0.0);  // its pressure is higher
  EXPECT_GT(demands[1].mass_flux, 0.0);
}

TEST(ContinuumOutside, ParticlesEnterWithTheStateUpwind) {
  ContinuumOptions options = with_pulse(0.0);
  options.velocity = 0.3;
  ContinuumOutside outside(options);
  Outside::Reports reports = FluidSlab(options).initial();
  for (FaceReport& report : reports) report.energy_per_particle += 1e-3;
  const Outside::Demands demands = outside.begin(reports);
  EXPECT_NEAR(demands[0].temperature, 2.5, 1e-12);
  EXPECT_GT(demands[1].temperature, 2.5 + 1e-4);
}

TEST(ContinuumOutside, WhatParticlesCarryInExcessIsMadeGood) {
  const ContinuumOptions options = with_pulse(0.0);
  Coupled coupled(options);
  coupled.slab.excess_momentum = 0.3;
  coupled.slab.excess_energy = -0.2;
  const Conserved before = coupled.slab.solver().total();
  coupled.run(30.0);
  for (const FaceDemand& demand : coupled.demands) {
    EXPECT_NEAR(demand.pressure, options.reservoir().fluid.pressure - 0.3, 2e-3);
    EXPECT_NEAR(demand.heat_flux, 0.2, 2e-3);
  }
  const Conserved after = coupled.slab.solver().total();
  for (std::size_t c = 0; c < 5; ++c) EXPECT_NEAR(after[c], before[c], 0.1);  // without memory 30 times the excess
}

TEST(ContinuumOutside, NoiseOfTheSlabLeavesMeansAlone) {
  ContinuumOptions options = with_pulse(0.0);
  options.velocity = 0.1;
  ContinuumOutside outside(options);
  FluidSlab slab(options);
  const CounterRandom random(7, RandomStream::langevin);
  const double interval = 0.5 * options.longest_interval();
  Outside::Demands demands = outside.begin(slab.initial());
  constexpr std::uint64_t intervals = 2000;
  double mass = 0.0, pressure = 0.0;
  for (std::uint64_t k = 0; k < intervals; ++k) {
    slab.excess_momentum = 0.2 * random.normal(k, 2, 0);
    Outside::Reports reports = slab.run(demands, interval);
    for (std::uint32_t face = 0; face < 2; ++face) {
      // As in a slice of a hundred particles.
      FaceReport& report = reports[face];
      report.density += 0.02 * random.normal(k, face, 0);
      report.energy_per_particle += 0.1 * random.normal(k, face, 1) - 0.5 * report.velocity[0] * report.velocity[0];
      report.velocity[0] += 0.15 * random.normal(k, face, 2);
      report.energy_per_particle += 0.5 * report.velocity[0] * report.velocity[0];
      mass += 0.5 * demands[face].mass_flux / intervals;
      pressure += 0.5 * demands[face].pressure / intervals;
    }
    demands = outside.advance(reports, interval);
  }
  EXPECT_NEAR(mass, 0.05, 0.005);
  EXPECT_NEAR(pressure, options.reservoir().fluid.pressure, 0.02);
  for (const FlowState& cell : slab.solver().flow()) EXPECT_NEAR(cell.fluid.density, 0.5, 0.02);
}

TEST(ContinuumOutside, AnArchivedOneGoesOnToTheSameBits) {
  const ContinuumOptions options = with_pulse(0.1);
  Coupled first(options), second(options);
  first.run(12.0);
  hand_on(first.outside, second.outside);
  hand_on(first.slab, second.slab);
  second.demands = first.demands;
  first.run(4.0);
  second.run(4.0);
  const auto found = first.flow(), again = second.flow();
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].fluid.density, again[i].fluid.density);
    EXPECT_EQ(found[i].fluid.temperature, again[i].fluid.temperature);
    EXPECT_EQ(found[i].velocity, again[i].velocity);
  }
  for (std::size_t face = 0; face < 2; ++face) {
    EXPECT_EQ(first.demands[face].pressure, second.demands[face].pressure);
    EXPECT_EQ(first.demands[face].heat_flux, second.demands[face].heat_flux);
  }
}

TEST(ContinuumOutside, TheSolverAloneHasCellsOfAboutTheSameWidth) {
  ContinuumOptions options = with_pulse(0.1);
  options.planes = {0.25, 30.65};
  const SolverGrid grid = solver_alone(options).grid();
  EXPECT_EQ(grid.left, -99.75);
  EXPECT_EQ(grid.cells, 230U);
  EXPECT_NEAR(grid.left + 230.0 * grid.cell_width, 130.65, 1e-9);
}

TEST(ContinuumOutside, OptionsOutOfRangeAreRefused) {
  const auto refused = [](auto change) {
    ContinuumOptions options = with_pulse(0.1);
    change(options);
    return refusal([&] { ContinuumOutside{options}; });
  };
  const auto names = [](const std::string& message, const char* what) { return message.find(what) != std::string::npos; };
  EXPECT_TRUE(names(refused([](auto& o) { o.density = -0.5; }), "density -0.5"));
  EXPECT_TRUE(names(refused([](auto& o) { o.temperature = std::nan(""); }), "temperature"));
  EXPECT_TRUE(names(refused([](auto& o) { o.density = 0.35, o.temperature = 1.0; }), "spinodal"));
  EXPECT_TRUE(names(refused([](auto& o) { o.velocity = 5.0; }), "velocity"));
  EXPECT_TRUE(names(refused([](auto& o) { o.velocity = std::nan(""); }), "velocity"));
  EXPECT_TRUE(names(refused([](auto& o) { o.cutoff = 0.5; }), "cutoff"));
  EXPECT_TRUE(names(refused([](auto& o) { o.transport.bulk_viscosity = -1.0; }), "bulk viscosity"));
  EXPECT_TRUE(names(refused([](auto& o) { o.planes = {3.0, 3.0}; }), "planes"));
  EXPECT_TRUE(names(refused([](auto& o) { o.area = 0.0; }), "area"));
  EXPECT_TRUE(names(refused([](auto& o) { o.cells = 0; }), "cells"));
  EXPECT_TRUE(names(refused([](auto& o) { o.cell_width = -1.0; }), "cell width"));
  EXPECT_TRUE(names(refused([](auto& o) { o.slice_distance = 0.0; }), "slice"));
  EXPECT_TRUE(names(refused([](auto& o) { o.memory = 0.5; }), "memory"));
  EXPECT_TRUE(names(refused([](auto& o) { o.pulse->width = 0.0; }), "width of the pulse"));
  EXPECT_TRUE(names(refused([](auto& o) { o.pulse->centre = std::nan(""); }), "centre"));
  EXPECT_TRUE(names(refused([](auto& o) { o.pulse->amplitude = -1.5; }), "amplitude"));
  EXPECT_TRUE(names(refused([](auto& o) { o.pulse->amplitude = 3.0; }), "density"));  // leaves the equation of state
}

TEST(ContinuumOutside, LongIntervalsAndSlabsBeyondTheFluidAreRefused) {
  const ContinuumOptions options = with_pulse(0.1);
  Coupled coupled(options);
  const Outside::Reports passed = coupled.slab.run(coupled.demands, coupled.interval);
  for (const double time : {0.0, -1.0, 1.01 * options.longest_interval()})
    EXPECT_NE(refusal([&] { coupled.outside.advance(passed, time); }).find("coupling interval"), std::string::npos);
  Outside::Reports strange = coupled.slab.initial();
  strange[1].density = 0.0;
  EXPECT_NE(refusal([&] { coupled.outside.begin(strange); }, ErrorCode::goal_not_reached).find("beside x = 30"), std::string::npos);
}

}  // namespace
}  // namespace lanescape
