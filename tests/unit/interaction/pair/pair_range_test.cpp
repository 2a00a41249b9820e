// What hosts do to the library: other units, other floating-point environments, positions that are not numbers.
#include <gtest/gtest.h>
#include <pthread.h>
#include <unistd.h>
#include <cfenv>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "every_isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/pair/probe_field.hpp"
#include "own_process.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

using testing::status_of;

// n x n x n particles on a simple lattice, in a box of this edge or one that they fill.
Configuration cubes(int n, double spacing, double edge = 0.0) {
  const double length = edge > 0.0 ? edge : n * spacing;
  Configuration c{{{length, length, length}}, {}, {}};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        for (const int at : {i, j, k}) c.positions.push_back((at + 0.5 + 0.03 * ((i + 2 * j + 3 * k) % 5)) * spacing);
        c.species.push_back((i + j + k) % 5 == 0);
      }
  return c;
}

PairModel scaled(PairModel model, double unit) {
  for (double& sigma : model.sigma) sigma *= unit;
  return model;
}

struct Result {
  PairInteraction::Evaluation sums;
  AlignedArray gradient;
  bool operator==(const Result& other) const {
    return sums.energy == other.sums.energy && sums.virial == other.sums.virial && gradient == other.gradient;
  }
};

Result evaluate(const PairModel& model, const Configuration& c, Isa isa, const PairSearchOptions& options = {}) {
  const ParticleLayout layout(c.species, model.species.size());
  PairInteraction interaction(model, c.box, layout, kernel_table(isa), options);
  Result result{{}, AlignedArray(layout.dimension(), 0.0)};
  result.sums = interaction.energy_and_gradient(layout.to_slots(c.positions), result.gradient);
  return result;
}

class PairRange : public testing::EveryIsa {};
INSTANTIATE_TEST_SUITE_P(EveryIsa, PairRange, testing::all_isas(), testing::isa_name);

TEST_P(PairRange, EnergiesDoNotDependOnTheUnitOfLength) {
  for (const int n : {3, 6}) {  // over all pairs, over a list
    const Result one = evaluate(kob_andersen(), cubes(n, 1.15), GetParam());
    for (const double unit : {1e-30, 1e-24, 1e-11, 3.405e-10, 1e-6, 0.1, 7.0, 1e4, 1e30}) {
      const Result other = evaluate(scaled(kob_andersen(), unit), cubes(n, 1.15 * unit), GetParam());
      EXPECT_NEAR(other.sums.energy / one.sums.energy, 1.0, 1e-13) << n << " " << unit;
      EXPECT_NEAR(other.sums.virial / one.sums.virial, 1.0, 1e-12) << n << " " << unit;
      for (std::size_t k = 0; k < one.gradient.size(); ++k) EXPECT_NEAR(other.gradient[k] * unit, one.gradient[k], 1e-10) << unit;
    }
  }
}

TEST_P(PairRange, UnitsThatArePowersOfTwoChangeNoBit) {
  for (const auto precision : {Precision::double_precision, Precision::mixed}) {
    const PairSearchOptions options{.precision = precision};
    const Result one = evaluate(kob_andersen(), cubes(6, 1.125), GetParam(), options);
    for (const double unit : {0x1p-90, 0x1p-20, 0x1p40}) {
      Result other = evaluate(scaled(kob_andersen(), unit), cubes(6, 1.125 * unit), GetParam(), options);
      for (double& g : other.gradient) g *= unit;
      EXPECT_EQ(other, one) << unit;
    }
  }
}

TEST_P(PairRange, HugeBoxesGiveWhatTheReferenceGives) {
  for (const int n : {2, 6})
    for (const double edge : {1e4, 1e7, 1e20, 1e30, 1e90})
      for (const double first : {0.0, -3.0}) {  // also across a face
        Configuration c = cubes(n, 1.15, edge);
        for (double& x : c.positions) x += first;
        const double expected = evaluate_reference(kob_andersen(), c).energy;
        EXPECT_NEAR(evaluate(kob_andersen(), c, GetParam()).sums.energy / expected, 1.0, 1e-12) << n << " " << edge;
        if (n == 2) continue;
        EXPECT_NEAR(evaluate(kob_andersen(), c, GetParam(), {.precision = Precision::mixed}).sums.energy / expected, 1.0, 1e-6)
            << edge;
      }
}

TEST_P(PairRange, PositionsThatAreNotFiniteAreRefused) {
  for (const int n : {2, 6})
    for (const auto precision : {Precision::double_precision, Precision::mixed}) {
      const Configuration sound = cubes(n, 1.15);
      const ParticleLayout layout(sound.species, 2);
      PairInteraction interaction(kob_andersen(), sound.box, layout, kernel_table(GetParam()), {.precision = precision});
      AlignedArray gradient(layout.dimension());
      for (const std::size_t coordinate : {std::size_t{0}, sound.positions.size() / 2, sound.positions.size() - 1})
        for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
          const double energy = interaction.energy(layout.to_slots(sound.positions));
          Configuration broken = sound;
          broken.positions[coordinate] = bad;
          const AlignedArray positions = layout.to_slots(broken.positions);
          EXPECT_THROW(interaction.energy(positions), Error) << n << " " << coordinate << " " << bad;
          EXPECT_THROW(interaction.gradient(positions, gradient), Error) << n << " " << coordinate << " " << bad;
          EXPECT_THROW(interaction.energy_and_gradient(positions, gradient), Error) << n << " " << coordinate << " " << bad;
          EXPECT_THROW(interaction.energy_and_stress(positions, gradient), Error) << n << " " << coordinate << " " << bad;
          EXPECT_EQ(interaction.energy(layout.to_slots(sound.positions)), energy) << "afterwards";
        }
    }
}

TEST_P(PairRange, ProbesOutsideTheRangeOfNumbersAreRefused) {
  const ProbeField field(kob_andersen(), cubes(6, 1.15), 0, kernel_table(GetParam()));
  EXPECT_THROW(field.energy({std::nan(""), 1.0, 1.0}), Error);
  EXPECT_THROW(field.sample({1.0, 1.0, std::numeric_limits<double>::infinity()}), Error);
}

TEST_P(PairRange, TheEnergyOfParticlesInOnePlaceIsNotFinite) {
  Configuration c = cubes(6, 1.15);
  std::copy_n(c.positions.begin(), 3, c.positions.begin() + 3);
  for (const auto search : {PairSearch::all_pairs, PairSearch::list})
    EXPECT_FALSE(
        std::isfinite(evaluate(lennard_jones(), {c.box, std::vector<int>(c.size(), 0), c.positions}, GetParam(), {.search = search})
                          .sums.virial));
}

TEST_P(PairRange, NoTrapOfTheHostStrikes) {
  for (const int n : {2, 3, 6}) {
    const Configuration c = cubes(n, 1.15), sparse = cubes(n, 1.15, 1e6);
    const Result expected = evaluate(kob_andersen(), c, GetParam()), expected_sparse = evaluate(kob_andersen(), sparse, GetParam());
    EXPECT_EQ(status_of([&] {
                feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
                return evaluate(kob_andersen(), c, GetParam()) == expected &&
                       evaluate(kob_andersen(), sparse, GetParam()) == expected_sparse;
              }),
              0)
        << n;
  }
}

TEST_P(PairRange, NoTrapStrikesOnTheLibrarysThreads) {
  const Configuration c = cubes(8, 1.15);
  const Result expected = evaluate(kob_andersen(), c, GetParam());
  EXPECT_EQ(status_of([&] {
              feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
              return evaluate(kob_andersen(), c, GetParam(), {.threads = 2}) == expected;
            }),
            0);
}

TEST_P(PairRange, ForkedProcessesGiveTheSameBits) {
  const Configuration c = cubes(8, 1.15);
  const Result expected = evaluate(kob_andersen(), c, GetParam(), {.threads = 2});  // this process has threads from here on
  EXPECT_EQ(status_of([&] {
              alarm(30);  // a child that waits for threads it does not have
              return evaluate(kob_andersen(), c, GetParam()) == expected;
            }),
            0);
}

TEST_P(PairRange, ThreadsOfAHostNeedLittleStack) {
  struct Work {
    Isa isa;
    Result results[2];
  } work{GetParam(), {}};
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, 64 * 1024), 0);
  pthread_t thread{};
  const auto run = [](void* argument) -> void* {
    auto& work = *static_cast<Work*>(argument);
    for (int k = 0; k < 2; ++k) work.results[k] = evaluate(kob_andersen(), cubes(3 + 3 * k, 1.15), work.isa);
    return nullptr;
  };
  ASSERT_EQ(pthread_create(&thread, &attributes, run, &work), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  for (int k = 0; k < 2; ++k) EXPECT_EQ(work.results[k], evaluate(kob_andersen(), cubes(3 + 3 * k, 1.15), GetParam()));
}

TEST_P(PairRange, BitsDoNotDependOnTheHostsRounding) {
  for (const int n : {2, 3, 6})
    for (const auto precision : {Precision::double_precision, Precision::mixed}) {
      const PairSearchOptions options{.precision = precision};
      const Configuration c = cubes(n, 1.15);
      const Result expected = evaluate(kob_andersen(), c, GetParam(), options);
      for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        std::fesetround(mode);
        const bool same = evaluate(kob_andersen(), c, GetParam(), options) == expected;
        const int mode_after = std::fegetround();
        std::fesetround(FE_TONEAREST);
        EXPECT_TRUE(same) << n << " " << mode;
        EXPECT_EQ(mode_after, mode);
      }
    }
}

#if defined(__SSE2__)
TEST_P(PairRange, BitsDoNotDependOnFlushingToZero) {
  const Configuration c = cubes(6, 1.15);
  const Result expected = evaluate(kob_andersen(), c, GetParam());
  const unsigned before = __builtin_ia32_stmxcsr();
  __builtin_ia32_ldmxcsr(before | 0x8040U);  // flush to zero, denormals are zero
  const bool same = evaluate(kob_andersen(), c, GetParam()) == expected;
  __builtin_ia32_ldmxcsr(before);
  EXPECT_TRUE(same);
}
#endif

TEST(PairModelRange, NumbersThatOverflowAreRefused) {
  const auto refusal = [](PairModel model) {
    try {
      model.check();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  PairModel model = lennard_jones();
  model.cutoff = 1e-40;
  EXPECT_NE(refusal(model).find("cutoff 1e-40 is not allowed"), std::string::npos);
  EXPECT_NE(refusal(scaled(lennard_jones(), 1e-200)).find("sigma 1e-200"), std::string::npos);
  model = kob_andersen();
  model.sigma[3] = 1e-15;
  EXPECT_NE(refusal(model).find("at least 1e-12 of the largest"), std::string::npos);
  EXPECT_EQ(refusal(scaled(kob_andersen(), 1e-30)), "");
}

TEST(PairModelRange, MixedPrecisionRefusesSizesThatItDoesNotResolve) {
  PairModel model = kob_andersen();
  model.sigma[3] = 1e-5;
  const Configuration c = cubes(6, 1.15);
  EXPECT_THROW(evaluate(model, c, available_isas().back(), {.precision = Precision::mixed}), Error);
  EXPECT_NO_THROW(evaluate(model, c, available_isas().back()));
}

}  // namespace
}  // namespace lanescape
