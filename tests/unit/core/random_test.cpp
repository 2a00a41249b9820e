#include "core/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace lanescape {
namespace {

constexpr std::uint32_t sample = 200000;

double from_words(std::uint32_t high, std::uint32_t low) {
  return (std::ldexp(double(high), 20) + double(low >> 12) + 0.5) * 0x1p-52;
}

// Known answers of philox4x32-10, published with Random123 (kat_vectors): counter, key -> first two words. The stream is mixed into
// the last counter word, so `draw` removes it again.
TEST(CounterRandom, IsThePublishedPhilox) {
  const auto draw = [](std::uint32_t word) { return word ^ (std::uint32_t{1} << 24); };
  const RandomStream stream = RandomStream::species;
  EXPECT_EQ(CounterRandom(0, stream).uniform(0, 0, draw(0)), from_words(0x6627e8d5, 0xe169c58d));
  constexpr std::uint64_t ones = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(CounterRandom(ones, stream).uniform(ones, 0xffffffff, draw(0xffffffff)), from_words(0x408f276d, 0x41c83b0e));
  EXPECT_EQ(CounterRandom(0x299f31d0a4093822, stream).uniform(0x85a308d3243f6a88, 0x13198a2e, draw(0x03707344)),
            from_words(0xd16cfe09, 0x94fdcceb));
}

TEST(CounterRandom, KeepsNoState) {
  const CounterRandom random(7, RandomStream::velocities), again(7, RandomStream::velocities);
  const double uniform = random.uniform(3, 5, 2), normal = random.normal(3, 5, 2);
  for (std::uint32_t i = 0; i < 10; ++i) random.uniform(i, i);
  EXPECT_EQ(random.uniform(3, 5, 2), uniform);
  EXPECT_EQ(again.uniform(3, 5, 2), uniform);
  EXPECT_EQ(again.normal(3, 5, 2), normal);
}

TEST(CounterRandom, EveryPartOfTheAddressMatters) {
  const double origin = CounterRandom(7, RandomStream::species).uniform(3, 5, 2);
  EXPECT_NE(CounterRandom(8, RandomStream::species).uniform(3, 5, 2), origin);
  EXPECT_NE(CounterRandom(7 + (std::uint64_t{1} << 32), RandomStream::species).uniform(3, 5, 2), origin);
  EXPECT_NE(CounterRandom(7, RandomStream::species).uniform(4, 5, 2), origin);
  EXPECT_NE(CounterRandom(7, RandomStream::species).uniform(3 + (std::uint64_t{1} << 32), 5, 2), origin);
  EXPECT_NE(CounterRandom(7, RandomStream::species).uniform(3, 6, 2), origin);
  EXPECT_NE(CounterRandom(7, RandomStream::species).uniform(3, 5, 3), origin);
}

TEST(CounterRandom, StreamsDiffer) {
  constexpr std::array streams{RandomStream::species, RandomStream::velocities, RandomStream::sites, RandomStream::displacements};
  for (std::size_t a = 0; a < streams.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (std::uint32_t i = 0; i < 100; ++i)
        EXPECT_NE(CounterRandom(1, streams[a]).uniform(0, i), CounterRandom(1, streams[b]).uniform(0, i));
}

// The bounds below are five standard errors of the sample.
TEST(CounterRandom, UniformNumbersHaveTheirMeanAndVariance) {
  const CounterRandom random(1, RandomStream::sites);
  double sum = 0.0, squares = 0.0;
  for (std::uint32_t i = 0; i < sample; ++i) {
    const double x = random.uniform(i / 100, i % 100);
    ASSERT_GT(x, 0.0);
    ASSERT_LT(x, 1.0);
    sum += x;
    squares += (x - 0.5) * (x - 0.5);
  }
  EXPECT_NEAR(sum / sample, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / sample));
  EXPECT_NEAR(squares / sample, 1.0 / 12.0, 5.0 * std::sqrt(1.0 / 180.0 / sample));
}

TEST(CounterRandom, NormalNumbersHaveTheirFirstFourMoments) {
  const CounterRandom random(1, RandomStream::velocities);
  double first = 0.0, second = 0.0, third = 0.0, fourth = 0.0;
  for (std::uint32_t i = 0; i < sample; ++i) {
    const double x = random.normal(0, i);
    first += x;
    second += x * x;
    third += x * x * x;
    fourth += x * x * x * x;
  }
  const double n = sample;
  EXPECT_NEAR(first / n, 0.0, 5.0 * std::sqrt(1.0 / n));
  EXPECT_NEAR(second / n, 1.0, 5.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(third / n, 0.0, 5.0 * std::sqrt(15.0 / n));
  EXPECT_NEAR(fourth / n, 3.0, 5.0 * std::sqrt(96.0 / n));
}

TEST(CounterRandom, NeighbouringParticlesAndDrawsAreUncorrelated) {
  const CounterRandom random(1, RandomStream::velocities);
  double particles = 0.0, draws = 0.0, steps = 0.0;
  for (std::uint32_t i = 0; i < sample; ++i) {
    const double x = random.normal(0, i);
    particles += x * random.normal(0, i + 1);
    draws += x * random.normal(0, i, 1);
    steps += x * random.normal(1, i);
  }
  const double bound = 5.0 * std::sqrt(double(sample));
  EXPECT_NEAR(particles, 0.0, bound);
  EXPECT_NEAR(draws, 0.0, bound);
  EXPECT_NEAR(steps, 0.0, bound);
}

TEST(CounterRandom, IntegersBelowABoundAreEquallyLikely) {
  const CounterRandom random(1, RandomStream::sites);
  std::array<double, 7> counts{};
  for (std::uint32_t i = 0; i < sample; ++i) {
    const std::uint32_t k = random.below(7, 0, i);
    ASSERT_LT(k, 7u);
    counts[k] += 1.0;
  }
  const double p = 1.0 / 7.0;
  for (const double count : counts) EXPECT_NEAR(count, sample * p, 5.0 * std::sqrt(sample * p * (1.0 - p)));
}

TEST(CounterRandom, TheOnlyIntegerBelowOneIsZeroAndLargeBoundsAreReached) {
  const CounterRandom random(1, RandomStream::sites);
  std::uint32_t largest = 0;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    EXPECT_EQ(random.below(1, 0, i), 0u);
    largest = std::max(largest, random.below(0xffffffff, 0, i));
  }
  EXPECT_GT(largest, 0xf0000000u);
}

}  // namespace
}  // namespace lanescape
