#include "flow/compressible_solver.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "flow/lennard_jones_fluid.hpp"
#include "flow/simple_wave.hpp"
#include "ideal_gas.hpp"
#include "memory_archive.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

using namespace testing;
using Ends = CompressibleSolver::Ends;

const auto liquid = std::make_shared<const LennardJonesFluid>(3.0);
const auto gas = std::make_shared<const IdealGas>();
constexpr TransportCoefficients none{0.0, 0.0, 0.0};

FlowState at_rest(double density = 0.5, double temperature = 2.5) { return {liquid->at_temperature(density, temperature), {}}; }

// A wave that goes to the right; `width` is the standard deviation of the Gaussian.
FlowState small_wave(double x, double amplitude, double width) {
  return simple_wave(*liquid, at_rest(), 0.5 * (1.0 + amplitude * std::exp(-0.5 * x * x / (width * width))));
}

CompressibleSolver with_wave(std::size_t cells, const TransportCoefficients& transport, double amplitude, double width = 8.0) {
  return {liquid, {-100.0, 200.0 / static_cast<double>(cells), cells}, transport, [=](double x) {
            return small_wave(x, amplitude, width);
          }};
}

// The Fourier component of the density's change at a wave number.
std::complex<double> component(const CompressibleSolver& solver, double wave_number) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < solver.flow().size(); ++i)
    sum += (solver.flow()[i].fluid.density - 0.5) * std::polar(1.0, -wave_number * solver.grid().centre(i));
  return sum;
}

double mean_position(const CompressibleSolver& solver) {
  double sum = 0.0, moment = 0.0;
  for (std::size_t i = 0; i < solver.flow().size(); ++i) {
    const double change = solver.flow()[i].fluid.density - 0.5;
    sum += change;
    moment += change * solver.grid().centre(i);
  }
  return moment / sum;
}

TEST(CompressibleSolver, ASmallPulseTravelsAtTheSoundVelocity) {
  CompressibleSolver solver = with_wave(400, none, 1e-3);
  const double start = mean_position(solver);
  solver.advance(15.0, Ends{at_rest(), at_rest()});
  EXPECT_NEAR((mean_position(solver) - start) / 15.0 / at_rest().fluid.sound_velocity(), 1.0, 2e-3);
}

TEST(CompressibleSolver, SoundIsAttenuatedByViscosityAndHeatConduction) {
  const ThermodynamicState fluid = at_rest().fluid;
  // c_p/c_v = c^2/(dp/d rho)_T
  const double gamma = fluid.sound_velocity() * fluid.sound_velocity() / fluid.pressure_by_density;
  const double k = 2.0 * std::numbers::pi / 40.0;
  // Damping also makes a little of the wave turn back. Over whole periods of the sum of both waves this does not matter.
  const double start = 5.0, time = 2.0 * std::numbers::pi / (k * fluid.sound_velocity());
  const auto damping = [&](const TransportCoefficients& transport) {
    CompressibleSolver solver = with_wave(400, transport, 1e-3);
    solver.advance(start, Ends{at_rest(), at_rest()});
    const double before = std::abs(component(solver, k));
    solver.advance(time, Ends{at_rest(), at_rest()});
    return -std::log(std::abs(component(solver, k)) / before) / time;
  };
  EXPECT_NEAR(damping(none) * time, 0.0, 1e-3);
  const TransportCoefficients cases[] = {{0.3, 0.0, 0.0}, {0.0, 0.4, 0.0}, {0.0, 0.0, 1.0}, {0.2, 0.1, 0.5}};
  for (const TransportCoefficients& transport : cases) {
    // Stokes and Kirchhoff: [(4/3 eta + zeta)/rho + (gamma - 1) kappa/(rho c_p)]/2 k^2 is the rate.
    const double rate = 0.5 * k * k / 0.5 *
                        (4.0 / 3.0 * transport.shear_viscosity + transport.bulk_viscosity +
                         (gamma - 1.0) * transport.heat_conductivity / (gamma * fluid.heat_capacity));
    EXPECT_NEAR(damping(transport) / rate, 1.0, 0.01);
    EXPECT_GT(rate * time, 0.04);
  }
}

TEST(CompressibleSolver, ShearDiffusesWithTheKinematicViscosity) {
  const double k = 2.0 * std::numbers::pi / 40.0, viscosity = 0.68, velocity = 1e-3;
  // An odd multiple of half a wave lies in the grid, so that the velocity along y is 0 at both ends.
  CompressibleSolver solver(liquid, {0.0, 0.5, 80}, {viscosity, 0.3, 3.0}, [&](double x) {
    return FlowState{at_rest().fluid, {0.0, velocity * std::sin(k * x), -2.0 * velocity * std::sin(k * x)}};
  });
  solver.advance(8.0, Ends{at_rest(), at_rest()});
  const Point& found = solver.flow()[19].velocity;
  const double expected = velocity * std::sin(k * 9.75) * std::exp(-viscosity / 0.5 * k * k * 8.0);
  EXPECT_NEAR(found[1] / expected, 1.0, 0.01);
  EXPECT_NEAR(found[2] / found[1], -2.0, 1e-9);
}

// The exact solution of a Riemann problem of two ideal gases at rest, gamma = 5/3, higher pressure on the left: Toro, chapter 4.
class ShockTube {
 public:
  static constexpr double g = 5.0 / 3.0;
  ShockTube(double left_density, double left_pressure, double right_density, double right_pressure)
      : rl_(left_density), pl_(left_pressure), rr_(right_density), pr_(right_pressure) {
    double low = pr_, high = pl_;
    for (int k = 0; k < 200; ++k) {
      p_ = 0.5 * (low + high);
      (behind_fan(p_) > behind_shock(p_) ? low : high) = p_;
    }
    u_ = behind_shock(p_);
  }
  // Density, velocity and pressure at x/t.
  std::array<double, 3> at(double s) const {
    const double cl = std::sqrt(g * pl_ / rl_), c = cl * std::pow(p_ / pl_, (g - 1.0) / (2.0 * g)), q = p_ / pr_;
    const double shock = std::sqrt(g * pr_ / rr_) * std::sqrt((g + 1.0) / (2.0 * g) * q + (g - 1.0) / (2.0 * g));
    if (s < -cl) return {rl_, 0.0, pl_};
    if (s < u_ - c) {
      const double inside = 2.0 / (g + 1.0) - (g - 1.0) / (g + 1.0) * s / cl;
      return {rl_ * std::pow(inside, 2.0 / (g - 1.0)), 2.0 / (g + 1.0) * (cl + s), pl_ * std::pow(inside, 2.0 * g / (g - 1.0))};
    }
    if (s < u_) return {rl_ * std::pow(p_ / pl_, 1.0 / g), u_, p_};
    const double ratio = (g - 1.0) / (g + 1.0);
    if (s < shock) return {rr_ * (q + ratio) / (ratio * q + 1.0), u_, p_};
    return {rr_, 0.0, pr_};
  }

 private:
  double behind_fan(double p) const {
    return 2.0 * std::sqrt(g * pl_ / rl_) / (g - 1.0) * (1.0 - std::pow(p / pl_, (g - 1.0) / (2.0 * g)));
  }
  double behind_shock(double p) const { return (p - pr_) * std::sqrt(2.0 / ((g + 1.0) * rr_) / (p + (g - 1.0) / (g + 1.0) * pr_)); }
  double rl_, pl_, rr_, pr_, p_ = 0.0, u_ = 0.0;
};

// Mean absolute errors of density, velocity and pressure.
std::array<double, 3> shock_tube_errors(std::size_t cells) {
  const FlowState left = ideal_flow(1.0, 0.0, 1.0), right = ideal_flow(0.125, 0.0, 0.1);
  CompressibleSolver solver(gas, {-0.5, 1.0 / static_cast<double>(cells), cells}, none,
                            [&](double x) { return x < 0.0 ? left : right; });
  solver.advance(0.2, Ends{left, right});
  const ShockTube exact(1.0, 1.0, 0.125, 0.1);
  std::array<double, 3> errors{};
  for (std::size_t i = 0; i < cells; ++i) {
    const FlowState& cell = solver.flow()[i];
    const std::array<double, 3> found{cell.fluid.density, cell.velocity[0], cell.fluid.pressure};
    const std::array<double, 3> expected = exact.at(solver.grid().centre(i) / 0.2);
    for (std::size_t k = 0; k < 3; ++k) errors[k] += std::abs(found[k] - expected[k]) / static_cast<double>(cells);
  }
  return errors;
}

TEST(CompressibleSolver, ARiemannProblemHasItsExactSolution) {
  // At jumps any scheme is of first order; contacts converge slower.
  const auto coarse = shock_tube_errors(100), fine = shock_tube_errors(400);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LT(coarse[k], k == 1 ? 0.02 : 0.01);
    EXPECT_LT(fine[k], 0.4 * coarse[k]);
  }
}

TEST(CompressibleSolver, AContactAtRestStays) {
  const FlowState light = ideal_flow(0.25, 0.0, 1.0), heavy = ideal_flow(2.0, 0.0, 1.0);
  CompressibleSolver solver(gas, {-1.0, 0.1, 20}, none, [&](double x) { return x < 0.0 ? light : heavy; });
  solver.advance(1.0, Ends{light, heavy});
  for (std::size_t i = 0; i < 20; ++i) EXPECT_NEAR(solver.flow()[i].fluid.density, i < 10 ? 0.25 : 2.0, 1e-13);
}

TEST(CompressibleSolver, ErrorsFallWithTheSquareOfTheCellWidth) {
  const TransportCoefficients transport{0.2, 0.1, 0.5};
  const auto densities_of = [&](std::size_t cells) {
    CompressibleSolver solver = with_wave(cells, transport, 0.02);
    solver.advance(8.0, Ends{at_rest(), at_rest()});
    std::vector<double> found;
    for (std::size_t i = 0; i < cells; i += cells / 200) {
      double sum = 0.0;
      for (std::size_t j = i; j < i + cells / 200; ++j) sum += solver.flow()[j].fluid.density;
      found.push_back(sum * 200.0 / static_cast<double>(cells));
    }
    return found;
  };
  const auto coarse = densities_of(200), middle = densities_of(400), fine = densities_of(800);
  double first = 0.0, second = 0.0;
  for (std::size_t i = 0; i < 200; ++i) {
    first += std::abs(coarse[i] - middle[i]);
    second += std::abs(middle[i] - fine[i]);
  }
  EXPECT_GT(std::log2(first / second), 1.75);
}

TEST(CompressibleSolver, OnlyWhatPassesTheEndsChangesTheTotals) {
  CompressibleSolver solver = with_wave(50, {0.68, 0.3, 3.0}, 0.1);
  const Conserved given{0.02, 1.8, 0.01, -0.02, 0.05};
  const Conserved before = solver.total();
  Conserved in{};
  for (const Ends& ends : {Ends{given, at_rest()}, Ends{at_rest(), given}, Ends{at_rest(0.52), at_rest(0.5, 2.6)}})
    for (int k = 0; k < 20; ++k) {
      solver.advance(0.3, ends);
      for (std::size_t c = 0; c < 5; ++c) in[c] += solver.passed()[0][c] - solver.passed()[1][c];
      for (std::size_t side = 0; side < 2; ++side) {
        const auto* flux = std::get_if<Conserved>(&ends[side]);
        for (std::size_t c = 0; flux && c < 5; ++c) EXPECT_NEAR(solver.passed()[side][c], 0.3 * (*flux)[c], 1e-15);
      }
    }
  const Conserved after = solver.total();
  for (std::size_t c = 0; c < 5; ++c) EXPECT_NEAR(after[c] - before[c], in[c], 1e-11);
  EXPECT_GT(std::abs(in[0]) + std::abs(in[2]), 0.01);
}

TEST(CompressibleSolver, AReservoirAbsorbsAPulse) {
  CompressibleSolver solver = with_wave(200, none, 0.05);
  solver.advance(50.0, Ends{at_rest(), at_rest()});
  for (const FlowState& cell : solver.flow()) {
    EXPECT_NEAR(cell.fluid.density, 0.5, 0.05 * 0.5 * 0.01);
    EXPECT_NEAR(cell.velocity[0], 0.0, 0.05 * 4.12 * 0.01);
  }
}

TEST(CompressibleSolver, TheFluxBetweenEqualStatesIsThatOfTheState) {
  FlowState moving = at_rest();
  moving.velocity = {0.3, -0.1, 0.2};
  const CompressibleSolver solver(liquid, {0.0, 1.0, 3}, {}, [&](double) { return moving; });
  const Conserved amounts = densities(moving);
  for (const auto side : {CompressibleSolver::Side::left, CompressibleSolver::Side::right}) {
    const Conserved flux = solver.flux_between(side, moving, 0.7);
    for (std::size_t c = 0; c < 5; ++c) {
      const double pressure = c == 1 ? moving.fluid.pressure : (c == 4 ? 0.3 * moving.fluid.pressure : 0.0);
      EXPECT_NEAR(flux[c], 0.3 * amounts[c] + pressure, 1e-13);
    }
  }
}

TEST(CompressibleSolver, TheFluxToANeighbourIsThatInsideTheGrid) {
  // A whole grid, and its left part with the next cell as what lies beyond.
  const auto initial = [](double x) { return small_wave(x, 0.1, 16.0); };
  const TransportCoefficients transport{0.68, 0.3, 3.0};
  CompressibleSolver whole(liquid, {1.0, 1.0, 6}, transport, initial);
  const CompressibleSolver part(liquid, {1.0, 1.0, 3}, transport, initial);
  const Conserved flux = part.flux_between(CompressibleSolver::Side::right, whole.flow()[3], 0.5);
  const CompressibleSolver other(liquid, {4.0, 1.0, 3}, transport, initial);
  const Conserved back = other.flux_between(CompressibleSolver::Side::left, whole.flow()[2], 0.5);
  for (std::size_t c = 0; c < 5; ++c) EXPECT_NEAR(flux[c], back[c], 0.04);  // they differ in what is not reconstructed
  EXPECT_NE(flux[1], back[1]);
}

TEST(CompressibleSolver, WhatLeavesTheEquationOfStateEndsInATypedError) {
  CompressibleSolver solver = with_wave(20, none, 1e-3);
  const std::string drained = refusal(
      [&] {
        solver.advance(50.0, Ends{Conserved{-1.0, 0, 0, 0, 0}, at_rest()});
      },
      ErrorCode::goal_not_reached);
  EXPECT_NE(drained.find("the continuum at x = -95"), std::string::npos) << drained;
  CompressibleSolver strange = with_wave(20, none, 1e-3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refusal([&] { strange.advance(1.0, Ends{Conserved{0, 0, 0, 0, nan}, at_rest()}); }, ErrorCode::goal_not_reached);
}

TEST(CompressibleSolver, OptionsOutOfRangeAreRefused) {
  const auto make = [](SolverGrid grid, TransportCoefficients transport, double density = 0.5, double temperature = 2.5) {
    CompressibleSolver(liquid, grid, transport, [=](double) { return at_rest(density, temperature); });
  };
  EXPECT_NE(refusal([&] { make({0.0, 1.0, 0}, {}); }).find("0 cells"), std::string::npos);
  EXPECT_NE(refusal([&] { make({0.0, -1.0, 9}, {}); }).find("cell width"), std::string::npos);
  EXPECT_NE(refusal([&] { make({std::nan(""), 1.0, 9}, {}); }).find("left end"), std::string::npos);
  EXPECT_NE(refusal([&] { make({}, {-1.0, 0.0, 0.0}); }).find("shear viscosity"), std::string::npos);
  EXPECT_NE(refusal([&] { make({}, {0.0, -1.0, 0.0}); }).find("bulk viscosity"), std::string::npos);
  EXPECT_NE(refusal([&] { make({}, {0.0, 0.0, std::nan("")}); }).find("heat conductivity"), std::string::npos);
  EXPECT_NE(refusal([&] { make({}, {}, 0.35, 1.0); }).find("unstable"), std::string::npos);
  EXPECT_NE(refusal([&] { make({}, {}, -0.3, 0.9); }).find("density"), std::string::npos);
  CompressibleSolver solver = with_wave(20, none, 1e-3);
  for (const double time : {0.0, -1.0, std::nan("")})
    EXPECT_NE(refusal([&] { solver.advance(time, Ends{at_rest(), at_rest()}); }).find("time"), std::string::npos);
}

TEST(CompressibleSolver, AnArchivedSolverGoesOnToTheSameBits) {
  const Ends ends{at_rest(0.51), at_rest()};
  CompressibleSolver first = with_wave(40, {}, 0.1), second = with_wave(40, {}, 0.0);
  first.advance(3.0, ends);
  hand_on(first, second);
  EXPECT_EQ(first.passed(), second.passed());
  first.advance(3.0, ends);
  second.advance(3.0, ends);
  EXPECT_EQ(first.total(), second.total());
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(first.flow()[i].fluid.density, second.flow()[i].fluid.density);
    EXPECT_EQ(first.flow()[i].fluid.temperature, second.flow()[i].fluid.temperature);
  }
  CompressibleSolver other = with_wave(50, {}, 0.0);
  EXPECT_NE(refusal([&] { hand_on(first, other); }).find("40 cells: 50"), std::string::npos);
}

}  // namespace
}  // namespace lanescape
