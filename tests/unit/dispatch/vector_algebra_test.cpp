#include "dispatch/vector_algebra.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dispatch/isa.hpp"

namespace lanescape {
namespace {

AlignedArray waves(std::size_t length, double phase) {
  AlignedArray values(length);
  for (std::size_t k = 0; k < length; ++k) values[k] = std::sin(phase + 0.37 * static_cast<double>(k));
  return values;
}

// Less than one block, exactly one, several, and several with a remainder.
const std::size_t lengths[] = {24, 16'384, 3 * 16'384, 100'008};

TEST(VectorAlgebra, HasTheSameBitsOnAnyNumberOfThreads) {
  const auto& table = kernel_table(available_isas().back());
  for (const std::size_t n : lengths) {
    const AlignedArray a = waves(n, 0.1), b = waves(n, 0.2), c = waves(n, 0.3);
    const VectorAlgebra one(table);
    AlignedArray expected(n), out(n);
    for (const int threads : {2, 3, 8}) {
      const VectorAlgebra many(table, threads);
      EXPECT_EQ(many.dot(a, b), one.dot(a, b)) << n;
      EXPECT_EQ(many.distance(a, b), one.distance(a, b)) << n;
      one.difference(expected, a, b);
      many.difference(out, a, b);
      EXPECT_EQ(out, expected) << n;
      one.axpy(expected, a, 0.7, b);
      many.axpy(out, a, 0.7, b);
      EXPECT_EQ(out, expected) << n;
      one.combine(expected, a, 0.7, b, -0.2, c);
      many.combine(out, a, 0.7, b, -0.2, c);
      EXPECT_EQ(out, expected) << n;
      expected = out = c;
      one.add_scaled(expected, 0.3, a, 8, n - 16);
      many.add_scaled(out, 0.3, a, 8, n - 16);
      EXPECT_EQ(out, expected) << n;
    }
  }
}

TEST(VectorAlgebra, SumsOfManyBlocksAreThoseOfALongSum) {
  const VectorAlgebra algebra(kernel_table(available_isas().back()), 2);
  for (const std::size_t n : lengths) {
    const AlignedArray a = waves(n, 0.1), b = waves(n, 0.2);
    long double product = 0.0L, square = 0.0L;
    for (std::size_t k = 0; k < n; ++k) {
      product += static_cast<long double>(a[k]) * b[k];
      square += (static_cast<long double>(a[k]) - b[k]) * (static_cast<long double>(a[k]) - b[k]);
    }
    EXPECT_NEAR(algebra.dot(a, b), static_cast<double>(product), 1e-12 * static_cast<double>(n));
    EXPECT_NEAR(algebra.distance(a, b), std::sqrt(static_cast<double>(square)), 1e-12 * static_cast<double>(n));
  }
}

}  // namespace
}  // namespace lanescape
