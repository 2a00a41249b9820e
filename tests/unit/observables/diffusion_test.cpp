#include "observables/diffusion.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/hdf5_archive.hpp"

namespace lanescape {
namespace {

ParticleLayout mixture(std::size_t first, std::size_t second) {
  std::vector<int> species(first, 0);
  species.insert(species.end(), second, 1);
  return ParticleLayout(species, 2);
}

// Writes value(particle axis) to every coordinate of a species.
void fill(AlignedArray& array, const ParticleLayout& layout, std::size_t species, const std::function<double(std::size_t)>& value) {
  const auto& block = layout.blocks()[species];
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t k = axis * layout.slots() + block.begin; k < axis * layout.slots() + block.begin + block.count; ++k)
      array[k] = value(k);
}

// Every particle of species s moves along (1, 1, 1) with speeds[s] sqrt(3).
TrajectoryRecord free_flight(const ParticleLayout& layout, const DiffusionWindow& window, const std::vector<double>& speeds) {
  TrajectoryRecord record(layout, window);
  AlignedArray velocity(layout.dimension(), 0.0), position(layout.dimension(), 0.0);
  for (std::uint64_t t = 0; t < window.records; ++t) {
    for (std::size_t s = 0; s < speeds.size(); ++s) {
      fill(velocity, layout, s, [&](std::size_t) { return speeds[s]; });
      fill(position, layout, s, [&](std::size_t) { return 10.0 + speeds[s] * window.interval * static_cast<double>(t); });
    }
    record.record(velocity, position);
  }
  return record;
}

// Langevin particles without forces. Velocities are an Ornstein-Uhlenbeck process with the given temperature and memory time, and
// positions are its exact integral (Gillespie, doi 10.1103/PhysRevE.54.2084). C(t) = 3 T exp(-t/tau), D = T tau.
class LangevinParticles {
 public:
  LangevinParticles(const ParticleLayout& layout, double interval, std::vector<double> temperatures, std::vector<double> times,
                    std::uint64_t seed)
      : layout_(&layout), random_(seed), velocity(layout.dimension(), 0.0), position(layout.dimension(), 0.0) {
    for (std::size_t s = 0; s < times.size(); ++s) {
      const double T = temperatures[s], tau = times[s], a = std::exp(-interval / tau);
      const double vv = T * (1.0 - a * a), xv = T * tau * std::pow(1.0 - a, 2);
      const double xx = T * tau * tau * (2.0 * interval / tau - 3.0 + 4.0 * a - a * a);
      const double kick = std::sqrt(vv);
      moves_.push_back({a, tau * (1.0 - a), kick, xv / kick, std::sqrt(xx - xv * xv / vv)});
      fill(velocity, layout, s, [&](std::size_t) { return std::sqrt(T) * normal_(random_); });
    }
  }

  void step() {
    for (std::size_t s = 0; s < moves_.size(); ++s)
      fill(velocity, *layout_, s, [&, move = moves_[s]](std::size_t k) {
        const double first = normal_(random_), second = normal_(random_);
        position[k] += move.drift * velocity[k] + move.shared * first + move.own * second;
        return move.decay * velocity[k] + move.kick * first;
      });
  }

  TrajectoryRecord run(const DiffusionWindow& window) {
    TrajectoryRecord record(*layout_, window);
    for (; !record.full(); step()) record.record(velocity, position);
    return record;
  }

 private:
  struct Move {
    double decay, drift, kick, shared, own;
  };
  const ParticleLayout* layout_;
  std::vector<Move> moves_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;

 public:
  AlignedArray velocity, position;
};

void expect_refused(const DiffusionWindow& window, const std::string& word) {
  try {
    TrajectoryRecord record(mixture(1, 1), window);
    ADD_FAILURE() << "accepted; expected was a refusal naming " << word;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
  EXPECT_THROW(DiffusionAccumulator(mixture(1, 1), window), Error);
}

TEST(Diffusion, WindowsThatCannotBeAreRefused) {
  EXPECT_NO_THROW((DiffusionWindow{0.1, 9, 10}.check()));
  expect_refused({0.0, 9, 10}, "interval");
  expect_refused({-0.1, 9, 10}, "interval");
  expect_refused({std::numeric_limits<double>::quiet_NaN(), 9, 10}, "interval");
  expect_refused({std::numeric_limits<double>::infinity(), 9, 10}, "interval");
  expect_refused({0.1, 0, 10}, "window of 0");
  expect_refused({0.1, 10, 10}, "too few");
  expect_refused({0.1, 11, 10}, "too few");
  expect_refused({0.1, 1009, 3000}, "multiple");  // a prime number
  expect_refused({0.1, 100, 2'000'000'000}, "at most");
}

TEST(Diffusion, CurvesHaveAtMostAThousandPointsAndEndAtTheLongestTime) {
  for (const std::uint64_t lags : {1, 7, 997, 999, 1000, 30'000, 40'000, 100'000}) {
    const DiffusionWindow window{0.5, lags, lags + 1};
    window.check();
    const DiffusionAccumulator diffusion(mixture(1, 1), window);
    EXPECT_LE(diffusion.points(), 1000u);
    EXPECT_GE(diffusion.points(), std::min<std::uint64_t>(lags, 100));
    EXPECT_EQ(diffusion.time(0), 0.0);
    EXPECT_EQ(diffusion.time(diffusion.points() - 1), window.longest_time());
  }
}

TEST(Diffusion, CurvesAreTheirDoubleSumsOnAnyMotion) {
  const ParticleLayout layout = mixture(3, 2);
  for (const DiffusionWindow window :
       {DiffusionWindow{0.2, 1, 2}, DiffusionWindow{0.2, 12, 40}, DiffusionWindow{0.2, 1200, 1301}}) {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    TrajectoryRecord record(layout, window);
    std::vector<AlignedArray> velocities, positions;  // unrelated to each other, and with values in the padding
    while (!record.full()) {
      for (auto* series : {&velocities, &positions}) {
        series->emplace_back(layout.dimension());
        for (double& value : series->back()) value = 0.1 + normal(random);
      }
      record.record(velocities.back(), positions.back());
    }
    DiffusionAccumulator diffusion(layout, window);
    diffusion.add_trajectory(record);
    for (std::size_t s = 0; s < 2; ++s) {
      const auto& block = layout.blocks()[s];
      const auto mean = [&](std::uint64_t every, const auto& value) {  // mean over origins and particles
        double sum = 0.0, samples = 0.0;
        for (std::uint64_t t = 0; t < window.origins(); t += every, samples += static_cast<double>(block.count))
          for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t k = axis * layout.slots() + block.begin; k < axis * layout.slots() + block.begin + block.count; ++k)
              sum += value(t, k);
        return sum / samples;
      };
      for (std::size_t p = 0; p < diffusion.points(); ++p) {
        const std::uint64_t lag = p * window.stride();
        const double c = mean(1, [&](std::uint64_t t, std::size_t k) { return velocities[t][k] * velocities[t + lag][k]; });
        const double d2 = mean(
            window.stride(), [&](std::uint64_t t, std::size_t k) { return std::pow(positions[t + lag][k] - positions[t][k], 2); });
        EXPECT_NEAR(diffusion.velocity_correlation(s, p).value, c, 2e-7);  // velocities are stored as floats
        EXPECT_NEAR(diffusion.squared_displacement(s, p).value, d2, 1e-12);
      }
    }
  }
}

TEST(Diffusion, LangevinParticlesDiffuseWithTemperatureTimesMemoryTime) {
  const ParticleLayout layout = mixture(14, 6);
  const std::vector<double> temperatures{1.0, 0.8}, times{1.0, 0.5};
  const DiffusionWindow window{0.008, 1200, 4800};  // t_max = 9.6
  DiffusionAccumulator diffusion(layout, window);
  LangevinParticles particles(layout, window.interval, temperatures, times, 6);
  for (int trajectory = 0; trajectory < 24; ++trajectory) diffusion.add_trajectory(particles.run(window));
  for (std::size_t s = 0; s < 2; ++s) {
    const double exact = temperatures[s] * times[s];
    const Estimate vacf = diffusion.vacf_diffusion(s), msd = diffusion.msd_diffusion(s), late = diffusion.long_time_diffusion(s);
    for (const Estimate& estimate : {vacf, msd, late}) {
      ASSERT_TRUE(estimate.error.has_value());
      EXPECT_LT(*estimate.error, 0.12 * exact);
      EXPECT_NEAR(estimate.value, exact, 4.0 * *estimate.error);
    }
    EXPECT_NEAR(vacf.value, msd.value, 2.0 * *vacf.error);  // both from the same trajectories
    EXPECT_EQ(diffusion.regime(s), DiffusionRegime::diffusive);
    const std::size_t middle = diffusion.points() / 10;  // about one memory time
    const Estimate c = diffusion.velocity_correlation(s, middle);
    EXPECT_NEAR(c.value, 3.0 * temperatures[s] * std::exp(-diffusion.time(middle) / times[s]), 4.0 * *c.error);
  }
}

TEST(Diffusion, BothRoutesAgreeWhereTheWindowEndsBeforeTheMemory) {
  const ParticleLayout layout = mixture(40, 0);
  const DiffusionWindow window{0.02, 50, 4000};  // t_max = tau
  DiffusionAccumulator diffusion(layout, window);
  LangevinParticles particles(layout, window.interval, {1.0}, {1.0}, 8);
  for (int trajectory = 0; trajectory < 20; ++trajectory) diffusion.add_trajectory(particles.run(window));
  const Estimate vacf = diffusion.vacf_diffusion(0), msd = diffusion.msd_diffusion(0);
  EXPECT_NEAR(vacf.value, 1.0 - std::exp(-1.0), 4.0 * *vacf.error);
  EXPECT_NEAR(msd.value, vacf.value, 2e-3);  // a line through the last tenth would be 0.018 below
  EXPECT_EQ(diffusion.regime(0), DiffusionRegime::ballistic);
}

TEST(Diffusion, InFreeFlightTheDisplacementGrowsWithTheSquareOfTime) {
  const ParticleLayout layout = mixture(3, 9);
  const std::vector<double> speeds{0.75, -2.0};
  for (const DiffusionWindow window : {DiffusionWindow{0.125, 40, 100}, DiffusionWindow{0.125, 2400, 5000}}) {
    DiffusionAccumulator diffusion(layout, window);
    diffusion.add_trajectory(free_flight(layout, window, speeds));
    for (std::size_t s = 0; s < 2; ++s) {
      const double v2 = 3.0 * speeds[s] * speeds[s], end = window.longest_time();
      for (std::size_t p = 0; p < diffusion.points(); ++p) {
        const double t = diffusion.time(p);
        EXPECT_NEAR(diffusion.velocity_correlation(s, p).value, v2, 1e-12);
        EXPECT_NEAR(diffusion.diffusion_integral(s, p).value, v2 * t / 3.0, 1e-12 * (1.0 + v2 * t));
        EXPECT_NEAR(diffusion.squared_displacement(s, p).value, v2 * t * t, 1e-12 * (1.0 + v2 * t * t));
      }
      EXPECT_NEAR(diffusion.msd_diffusion(s).value, v2 * end / 3.0, 1e-9 * v2 * end);
      EXPECT_NEAR(diffusion.long_time_diffusion(s).value, v2 * end / 4.0, 1e-9 * v2 * end);  // slope at 3/4 t_max
      EXPECT_NEAR(diffusion.displacement_exponent(s), 2.0, 1e-9);
      EXPECT_EQ(diffusion.regime(s), DiffusionRegime::ballistic);
    }
  }
}

TEST(Diffusion, ParticlesThatRattleAreCagedHoweverFar) {
  const ParticleLayout layout = mixture(2, 0);
  const DiffusionWindow window{0.05, 400, 2000};  // t_max = 20
  TrajectoryRecord record(layout, window);
  AlignedArray velocity(layout.dimension(), 0.0), position(layout.dimension(), 0.0);
  // The squared displacement varies as 1 - cos(w t); at t_max it is just below its maximum.
  const double frequency = (7.0 * std::numbers::pi - 0.0455) / window.longest_time();
  while (!record.full()) {
    const double time = window.interval * static_cast<double>(record.records());
    fill(position, layout, 0, [&](std::size_t) { return std::sin(frequency * time); });
    fill(velocity, layout, 0, [&](std::size_t) { return frequency * std::cos(frequency * time); });
    record.record(velocity, position);
  }
  DiffusionAccumulator diffusion(layout, window);
  diffusion.add_trajectory(record);
  EXPECT_GT(diffusion.squared_displacement(0, diffusion.points() - 1).value, 1.0);
  EXPECT_GT(diffusion.displacement_exponent(0), 0.2);
  EXPECT_LT(diffusion.displacement_exponent(0), 0.8);
  EXPECT_EQ(diffusion.regime(0), DiffusionRegime::caged);
}

TEST(Diffusion, ParticlesThatMovedLessThanAThirdOfTheirSizeAreCagedWhateverTheExponent) {
  const ParticleLayout layout = mixture(40, 40);
  const DiffusionWindow window{0.02, 480, 10'000};
  DiffusionAccumulator diffusion(layout, window);
  LangevinParticles particles(layout, window.interval, {1e-3, 1e-2}, {1.0, 1.0}, 13);
  diffusion.add_trajectory(particles.run(window));
  for (std::size_t s = 0; s < 2; ++s) EXPECT_NEAR(diffusion.displacement_exponent(s), 1.05, 0.1);
  EXPECT_NEAR(diffusion.squared_displacement(0, diffusion.points() - 1).value, 0.052, 0.01);
  EXPECT_EQ(diffusion.regime(0), DiffusionRegime::caged);
  EXPECT_EQ(diffusion.regime(1), DiffusionRegime::diffusive);
}

TEST(Diffusion, WhatDoesNotMoveIsCaged) {
  const ParticleLayout layout = mixture(2, 0);  // the second species has no particles
  const DiffusionWindow window{0.1, 20, 50};
  DiffusionAccumulator diffusion(layout, window);
  diffusion.add_trajectory(free_flight(layout, window, {0.0, 0.0}));
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_EQ(diffusion.vacf_diffusion(s).value, 0.0);
    EXPECT_EQ(diffusion.msd_diffusion(s).value, 0.0);
    EXPECT_EQ(diffusion.displacement_exponent(s), 0.0);
    EXPECT_EQ(diffusion.regime(s), DiffusionRegime::caged);
  }
}

TEST(Diffusion, ErrorsAreStandardErrorsOverTrajectories) {
  const ParticleLayout layout = mixture(2, 1);
  const DiffusionWindow window{0.5, 4, 10};  // t_max = 2
  DiffusionAccumulator diffusion(layout, window);
  EXPECT_EQ(diffusion.trajectories(), 0u);
  EXPECT_FALSE(diffusion.vacf_diffusion(0).error.has_value());
  for (int count = 1; count <= 16; ++count) {
    // D(t_max) = v^2 t_max/3 alternates between 2 and 8.
    diffusion.add_trajectory(free_flight(layout, window, {count % 2 == 1 ? 1.0 : 2.0, 0.5}));
    ASSERT_EQ(diffusion.trajectories(), static_cast<std::uint64_t>(count));
    EXPECT_EQ(diffusion.vacf_diffusion(0).error.has_value(), count > 1);
    if (count % 2 == 1) continue;
    for (const Estimate& estimate : {diffusion.vacf_diffusion(0), diffusion.msd_diffusion(0)}) {
      EXPECT_NEAR(estimate.value, 5.0, 1e-12);
      EXPECT_NEAR(estimate.error.value(), 3.0 / std::sqrt(count - 1.0), 1e-12);
    }
    EXPECT_NEAR(diffusion.vacf_diffusion(1).error.value(), 0.0, 1e-12);
  }
}

TEST(Diffusion, ARecordIsUsedAgainAfterItIsCleared) {
  const ParticleLayout layout = mixture(2, 1);
  const DiffusionWindow window{0.5, 4, 10};
  TrajectoryRecord record = free_flight(layout, window, {1.0, 2.0});
  const AlignedArray still(layout.dimension(), 0.0);
  EXPECT_THROW(record.record(still, still), Error);
  record.clear();
  DiffusionAccumulator diffusion(layout, window);
  EXPECT_THROW(diffusion.add_trajectory(record), Error);  // it is not full
  while (!record.full()) record.record(still, still);
  diffusion.add_trajectory(record);
  EXPECT_EQ(diffusion.vacf_diffusion(1).value, 0.0);
}

TEST(Diffusion, TrajectoriesOfAnotherWindowOrLayoutAreRefused) {
  const ParticleLayout layout = mixture(2, 1);
  const DiffusionWindow window{0.5, 4, 10};
  DiffusionAccumulator diffusion(layout, window);
  for (const DiffusionWindow other : {DiffusionWindow{0.25, 4, 10}, DiffusionWindow{0.5, 5, 10}, DiffusionWindow{0.5, 4, 11}})
    EXPECT_THROW(diffusion.add_trajectory(free_flight(layout, other, {1.0, 1.0})), Error);
  EXPECT_THROW(diffusion.add_trajectory(free_flight(mixture(1, 2), window, {1.0, 1.0})), Error);
  EXPECT_EQ(diffusion.trajectories(), 0u);
}

// A file that is deleted with the test.
struct ScratchFile {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("lanescape_diffusion_" + std::to_string(::getpid()) + ".h5");
  ~ScratchFile() { std::filesystem::remove(path); }
};

TEST(Diffusion, AnArchivedRunContinuesToTheSameBits) {
  const ParticleLayout layout = mixture(3, 2);
  const DiffusionWindow window{0.05, 30, 200};
  for (const int archived_after : {0, 1, 2}) {
    LangevinParticles particles(layout, window.interval, {1.0, 2.0}, {0.3, 0.2}, 11);
    DiffusionAccumulator whole(layout, window), resumed(layout, window);
    ScratchFile file;
    for (int trajectory = 0; trajectory < 3; ++trajectory) {
      if (trajectory == archived_after) {
        Hdf5Writer writer(file.path);
        whole.exchange(writer);
        writer.commit();
        Hdf5Reader reader(file.path);
        resumed.exchange(reader);
        EXPECT_EQ(resumed.trajectories(), static_cast<std::uint64_t>(trajectory));
      }
      const TrajectoryRecord record = particles.run(window);
      whole.add_trajectory(record);
      if (trajectory >= archived_after) resumed.add_trajectory(record);
    }
    for (std::size_t s = 0; s < 2; ++s) {
      EXPECT_EQ(resumed.msd_diffusion(s).error, whole.msd_diffusion(s).error);
      for (std::size_t p = 0; p < whole.points(); ++p) {
        EXPECT_EQ(resumed.velocity_correlation(s, p).value, whole.velocity_correlation(s, p).value);
        EXPECT_EQ(resumed.diffusion_integral(s, p).value, whole.diffusion_integral(s, p).value);
        EXPECT_EQ(resumed.squared_displacement(s, p).value, whole.squared_displacement(s, p).value);
      }
    }
  }
}

TEST(Diffusion, AnArchiveOfAnotherWindowIsRefused) {
  const ParticleLayout layout = mixture(3, 2);
  const DiffusionWindow window{0.05, 30, 200};
  DiffusionAccumulator diffusion(layout, window), other(layout, {0.05, 40, 200});
  diffusion.add_trajectory(free_flight(layout, window, {1.0, 1.0}));
  ScratchFile file;
  Hdf5Writer writer(file.path);
  diffusion.exchange(writer);
  writer.commit();
  Hdf5Reader reader(file.path);
  EXPECT_THROW(other.exchange(reader), Error);
}

}  // namespace
}  // namespace lanescape
