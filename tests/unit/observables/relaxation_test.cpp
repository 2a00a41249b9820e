#include "observables/relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/hdf5_archive.hpp"
#include "test_files.hpp"

namespace lanescape {
namespace {

using testing::refusal;

ParticleLayout mixture(std::size_t first, std::size_t second) {
  std::vector<int> species(first, 0);
  species.insert(species.end(), second, 1);
  return ParticleLayout(species, 2);
}

RelaxationWindow window_of(std::uint64_t records, double interval = 0.5) { return {interval, records, {3.0, 5.0}, 0.3}; }

// Calls move(slot index, species) for every coordinate.
void for_coordinates(const ParticleLayout& layout, const std::function<void(std::size_t, std::size_t)>& move) {
  for (std::size_t s = 0; s < layout.blocks().size(); ++s)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < layout.blocks()[s].count; ++i) move(axis * layout.slots() + layout.blocks()[s].begin + i, s);
}

// One trajectory whose positions at record t are position(t).
void add_trajectory(RelaxationAccumulator& relaxation, const std::function<AlignedArray(std::uint64_t)>& position) {
  for (std::uint64_t t = 0; t < relaxation.window().records; ++t) relaxation.record(position(t));
}

// Particles that keep velocities, which are Gaussian with variance T per axis, from a new start in each trajectory.
void add_free_gas(RelaxationAccumulator& relaxation, const ParticleLayout& layout, double temperature, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  AlignedArray start(layout.dimension(), 0.0), velocity(layout.dimension(), 0.0);
  for_coordinates(layout, [&](std::size_t c, std::size_t) {
    start[c] = 10.0 * normal(random);
    velocity[c] = std::sqrt(temperature) * normal(random);
  });
  add_trajectory(relaxation, [&](std::uint64_t t) {
    AlignedArray now = start;
    for_coordinates(
        layout, [&](std::size_t c, std::size_t) { now[c] += velocity[c] * static_cast<double>(t) * relaxation.window().interval; });
    return now;
  });
}

// Positions at so many records, with values in the padding too.
std::vector<AlignedArray> random_walk(const ParticleLayout& layout, std::uint64_t records) {
  std::mt19937_64 random(records);
  std::normal_distribution<double> step(0.0, 0.1);
  AlignedArray position(layout.dimension(), 0.0);
  std::vector<AlignedArray> positions;
  for (std::uint64_t t = 0; t < records; ++t) {
    for (double& x : position) x += step(random);
    positions.push_back(position);
  }
  return positions;
}

TEST(Relaxation, LagsAreSpacedByFactorsAndOriginsAreAtMostAHundred) {
  for (const std::uint64_t records : {2, 3, 7, 100, 101, 11'000, 300'000}) {
    const RelaxationWindow window = window_of(records);
    const std::vector<std::uint64_t> lags = window.lags();
    ASSERT_FALSE(lags.empty());
    EXPECT_EQ(lags[0], 1u);
    EXPECT_LE(lags.back(), records / 2);
    EXPECT_GT(1.3 * static_cast<double>(lags.back()), static_cast<double>(records / 2));
    for (std::size_t k = 1; k < lags.size(); ++k) {
      EXPECT_GT(lags[k], lags[k - 1]);
      EXPECT_TRUE(lags[k] == lags[k - 1] + 1 || static_cast<double>(lags[k]) < 1.3 * static_cast<double>(lags[k - 1]));
    }
    EXPECT_LE((records - 1) / window.origin_spacing() + 1, 100u);
  }
}

TEST(Relaxation, WindowsThatCannotBeAreRefused) {
  const auto said = [](RelaxationWindow window) { return refusal([&] { RelaxationAccumulator(mixture(1, 1), window); }); };
  EXPECT_EQ(said({0.1, 1, {1.0, 1.0}, 0.3}), "1 records for relaxation are not allowed: from 2 to 1000000000000");
  EXPECT_NE(said({0.0, 9, {1.0, 1.0}, 0.3}).find("interval"), std::string::npos);
  EXPECT_EQ(said({0.1, 9, {1.0, 0.0}, 0.3}), "wave number 0 is not allowed: it must be finite and above 0");
  EXPECT_NE(said({0.1, 9, {-7.25, 1.0}, 0.3}).find("wave number -7.25"), std::string::npos);
  EXPECT_NE(said({0.1, 9, {std::numeric_limits<double>::quiet_NaN(), 1.0}, 0.3}).find("wave number"), std::string::npos);
  EXPECT_EQ(said({0.1, 9, {1.0}, 0.3}), "1 wave numbers are given for 2 species");
  for (const double length : {0.0, -0.3, std::numeric_limits<double>::infinity()})
    EXPECT_NE(said({0.1, 9, {1.0, 1.0}, length}).find("overlap length"), std::string::npos);
}

TEST(Relaxation, CurvesAreTheirDoubleSumsOnAnyMotion) {
  const ParticleLayout layout = mixture(3, 2);
  for (const std::uint64_t records : {2, 9, 250}) {  // at 250 every third record is an origin
    const RelaxationWindow window = window_of(records);
    RelaxationAccumulator relaxation(layout, window);
    const std::vector<AlignedArray> positions = random_walk(layout, records);
    for (const AlignedArray& position : positions) relaxation.record(position);
    ASSERT_EQ(relaxation.trajectories(), 1u);
    const std::vector<std::uint64_t> lags = window.lags();
    for (std::size_t s = 0; s < 2; ++s)
      for (std::size_t p = 0; p < relaxation.points(); ++p) {
        EXPECT_EQ(relaxation.time(p), static_cast<double>(lags[p]) * window.interval);
        const auto& block = layout.blocks()[s];
        double origins = 0.0, r2 = 0.0, r4 = 0.0, f = 0.0, q = 0.0, q2 = 0.0;
        for (std::uint64_t t = 0; t + lags[p] < records; t += window.origin_spacing(), ++origins) {
          double near = 0.0;
          for (std::size_t i = block.begin; i < block.begin + block.count; ++i) {
            double d2 = 0.0;
            for (std::size_t axis = 0; axis < 3; ++axis)
              d2 += std::pow(positions[t + lags[p]][axis * layout.slots() + i] - positions[t][axis * layout.slots() + i], 2);
            r2 += d2;
            r4 += d2 * d2;
            f += std::sin(window.wave_numbers[s] * std::sqrt(d2)) / (window.wave_numbers[s] * std::sqrt(d2));
            near += d2 < 0.09;
          }
          q += near;
          q2 += near * near;
        }
        const double n = static_cast<double>(block.count), samples = origins * n;
        EXPECT_NEAR(relaxation.squared_displacement(s, p).value, r2 / samples, 1e-13);
        EXPECT_NEAR(relaxation.intermediate_scattering(s, p).value, f / samples, 1e-13);
        EXPECT_NEAR(relaxation.non_gaussian(s, p).value, 0.6 * (r4 / samples) / std::pow(r2 / samples, 2) - 1.0, 1e-12);
        EXPECT_NEAR(relaxation.susceptibility(s, p).value, (q2 / origins - std::pow(q / origins, 2)) / n, 1e-12);
        EXPECT_FALSE(relaxation.non_gaussian(s, p).error.has_value());
      }
  }
}

// |dr| = v t for a share of the particles, 0 for the others: every quantity has a closed form.
TEST(Relaxation, ParticlesOfWhichHalfMoveHaveKnownScatteringAndNonGaussianParameter) {
  const ParticleLayout layout = mixture(8, 0);
  const RelaxationWindow window = window_of(40, 0.01);
  RelaxationAccumulator relaxation(layout, window);
  add_trajectory(relaxation, [&](std::uint64_t t) {
    AlignedArray now(layout.dimension(), 0.0);
    for (std::size_t i = 0; i < 4; ++i) now[layout.slots() + i] = 0.11 * static_cast<double>(t);  // along y
    return now;
  });
  for (std::size_t p = 0; p < relaxation.points(); ++p) {
    const double r = 0.11 * relaxation.time(p) / window.interval, kr = window.wave_numbers[0] * r;
    EXPECT_NEAR(relaxation.squared_displacement(0, p).value, r * r / 2.0, 1e-12 * r * r);
    EXPECT_NEAR(relaxation.non_gaussian(0, p).value, 0.2, 1e-12);  // (3/5) (1/2)/(1/2)^2 - 1
    EXPECT_NEAR(relaxation.intermediate_scattering(0, p).value, (1.0 + std::sin(kr) / kr) / 2.0, 1e-12);
    EXPECT_EQ(relaxation.susceptibility(0, p).value, 0.0);  // every origin sees the same
  }
  EXPECT_FALSE(relaxation.relaxation_time(0).has_value());  // half of them never leave
}

TEST(Relaxation, AFreeGasIsGaussianAndItsScatteringIsThatOfMaxwell) {
  const ParticleLayout layout = mixture(400, 200);
  const RelaxationWindow window = window_of(64, 0.02);
  RelaxationAccumulator relaxation(layout, window);
  std::mt19937_64 random(5);
  constexpr double temperature = 0.7;
  for (int k = 0; k < 40; ++k) add_free_gas(relaxation, layout, temperature, random);
  for (std::size_t s = 0; s < 2; ++s) {
    for (std::size_t p = 0; p < relaxation.points(); ++p) {
      const double t = relaxation.time(p), k = window.wave_numbers[s];
      const auto expect_near = [](const Estimate& estimate, double exact, double most_error) {
        ASSERT_TRUE(estimate.error.has_value());
        EXPECT_LT(*estimate.error, most_error);
        EXPECT_NEAR(estimate.value, exact, 4.0 * *estimate.error);
      };
      expect_near(relaxation.squared_displacement(s, p), 3.0 * temperature * t * t, 0.02 * t * t);
      expect_near(relaxation.non_gaussian(s, p), 0.0, 0.02);
      expect_near(relaxation.intermediate_scattering(s, p), std::exp(-0.5 * k * k * temperature * t * t), 0.01);
    }
    const Estimate tau = relaxation.relaxation_time(s).value();
    const double exact = std::sqrt(2.0 / temperature) / window.wave_numbers[s];
    EXPECT_LT(tau.error.value(), 0.01 * exact);
    EXPECT_NEAR(tau.value, exact, 4.0 * *tau.error + 2e-3 * exact);  // the second term: the line between two points
  }
}

TEST(Relaxation, RandomWalkersRelaxInOneOverKSquaredD) {
  const ParticleLayout layout = mixture(60, 0);
  RelaxationWindow window = window_of(4000, 0.1);
  window.wave_numbers = {2.0, 2.0};
  RelaxationAccumulator relaxation(layout, window);
  constexpr double diffusion = 0.05;
  std::mt19937_64 random(9);
  std::normal_distribution<double> step(0.0, std::sqrt(2.0 * diffusion * window.interval));
  AlignedArray position(layout.dimension(), 0.0);
  for (int k = 0; k < 20; ++k)
    add_trajectory(relaxation, [&](std::uint64_t) {
      for_coordinates(layout, [&](std::size_t c, std::size_t) { position[c] += step(random); });
      return position;
    });
  const Estimate tau = relaxation.relaxation_time(0).value();
  EXPECT_LT(tau.error.value(), 0.02 * 5.0);
  EXPECT_NEAR(tau.value, 5.0, 4.0 * *tau.error);
  for (std::size_t p = 0; p < relaxation.points(); p += 8) {
    const Estimate r2 = relaxation.squared_displacement(0, p), alpha = relaxation.non_gaussian(0, p);
    EXPECT_NEAR(r2.value, 6.0 * diffusion * relaxation.time(p), 4.0 * *r2.error);
    EXPECT_NEAR(alpha.value, 0.0, 4.0 * *alpha.error);
  }
}

TEST(Relaxation, SusceptibilityCountsParticlesThatStayOrLeaveTogether) {
  const ParticleLayout layout = mixture(8, 4);
  RelaxationAccumulator relaxation(layout, window_of(10));
  for (int trajectory = 0; trajectory < 4; ++trajectory)  // all stay, or all leave at once
    add_trajectory(relaxation,
                   [&](std::uint64_t t) { return AlignedArray(layout.dimension(), trajectory % 2 * static_cast<double>(t)); });
  for (std::size_t p = 0; p < relaxation.points(); ++p) {
    EXPECT_NEAR(relaxation.susceptibility(0, p).value, 8.0 / 4.0, 1e-12);  // (N^2/2 - (N/2)^2)/N
    EXPECT_NEAR(relaxation.susceptibility(1, p).value, 4.0 / 4.0, 1e-12);
  }
  EXPECT_FALSE(relaxation.susceptibility_peak(0).has_value());  // the largest value is the first
}

TEST(Relaxation, APeakInsideTheCurveIsFound) {
  const ParticleLayout layout = mixture(2, 0);
  RelaxationAccumulator relaxation(layout, window_of(60));
  for (int trajectory = 0; trajectory < 2; ++trajectory)  // at rest, or back and forth every ten records
    add_trajectory(relaxation,
                   [&](std::uint64_t t) { return AlignedArray(layout.dimension(), trajectory * static_cast<double>(t / 10 % 2)); });
  const std::size_t peak = relaxation.susceptibility_peak(0).value();
  EXPECT_EQ(relaxation.time(peak), 10 * relaxation.window().interval);
  EXPECT_NEAR(relaxation.susceptibility(0, peak).value, 2.0 / 4.0, 1e-12);  // N/4: Q is 0 or N, each in one trajectory
}

TEST(Relaxation, WhatDoesNotMoveDoesNotRelaxAndSpeciesWithoutParticlesAreZero) {
  const ParticleLayout layout = mixture(3, 0);
  RelaxationAccumulator relaxation(layout, window_of(10));
  add_trajectory(relaxation, [&](std::uint64_t) { return AlignedArray(layout.dimension(), 1.0); });
  for (std::size_t p = 0; p < relaxation.points(); ++p) {
    EXPECT_EQ(relaxation.intermediate_scattering(0, p).value, 1.0);
    EXPECT_EQ(relaxation.squared_displacement(0, p).value, 0.0);
    EXPECT_EQ(relaxation.non_gaussian(0, p).value, 0.0);
    EXPECT_EQ(relaxation.intermediate_scattering(1, p).value, 0.0);
    EXPECT_EQ(relaxation.susceptibility(1, p).value, 0.0);
  }
  EXPECT_FALSE(relaxation.relaxation_time(0).has_value());
  EXPECT_FALSE(relaxation.relaxation_time(1).has_value());
}

TEST(Relaxation, ResumedFromAnArchiveHasTheSameBits) {
  const ParticleLayout layout = mixture(30, 20);
  const RelaxationWindow window = window_of(20, 0.05);
  RelaxationAccumulator whole(layout, window), begun(layout, window), resumed(layout, window), other(layout, window_of(60));
  std::mt19937_64 first(2), second(2);
  for (int k = 0; k < 5; ++k) add_free_gas(whole, layout, 1.0, first);
  for (int k = 0; k < 2; ++k) add_free_gas(begun, layout, 1.0, second);
  const testing::TemporaryFolder folder;
  const std::string file = (folder.path() / "relaxation.h5").string();
  Hdf5Writer writer(file);
  begun.exchange(writer);
  writer.commit();
  Hdf5Reader reader(file);
  resumed.exchange(reader);
  for (int k = 0; k < 3; ++k) add_free_gas(resumed, layout, 1.0, second);
  ASSERT_EQ(resumed.trajectories(), 5u);
  for (std::size_t s = 0; s < 2; ++s)
    for (std::size_t p = 0; p < whole.points(); ++p) {
      EXPECT_EQ(resumed.intermediate_scattering(s, p).value, whole.intermediate_scattering(s, p).value);
      EXPECT_EQ(resumed.non_gaussian(s, p).error, whole.non_gaussian(s, p).error);
      EXPECT_EQ(resumed.susceptibility(s, p).value, whole.susceptibility(s, p).value);
    }
  Hdf5Reader again(file);
  EXPECT_THROW(other.exchange(again), Error);
}

}  // namespace
}  // namespace lanescape
