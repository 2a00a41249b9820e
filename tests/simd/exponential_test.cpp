// The exponential compared with that of long double: error at most two units in the last place.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "every_simd.hpp"

namespace lanescape::testing {
namespace {

using Exponential = EverySimd;
INSTANTIATE_TEST_SUITE_P(Isa, Exponential, all_isas(), isa_name);

// In units of the last place of the exact result. Below the smallest normal number all these units are equal.
template <class T>
double error_in_ulp(T found, T v) {
  const long double exact = std::exp(static_cast<long double>(v));
  if (std::isinf(found) && exact > static_cast<long double>(std::numeric_limits<T>::max())) return 0.0;
  int exponent = 0;
  std::frexp(exact, &exponent);
  exponent = std::max(exponent, std::numeric_limits<T>::min_exponent);
  return static_cast<double>(std::fabs(static_cast<long double>(found) - exact) /
                             std::ldexp(1.0L, exponent - std::numeric_limits<T>::digits));
}

template <class T>
double worst_error(const VectorOperations<T>& vector, T begin, T end, int count) {
  double worst = 0.0;
  Lanes<T> v{}, out{};
  for (int k = 0; k < count; k += static_cast<int>(vector.lanes)) {
    for (std::size_t lane = 0; lane < vector.lanes; ++lane)
      v[lane] = begin + (end - begin) * ((static_cast<T>(k) + static_cast<T>(lane)) / static_cast<T>(count));
    vector.exponential(v.data(), out.data());
    for (std::size_t lane = 0; lane < vector.lanes; ++lane) worst = std::max(worst, error_in_ulp(out[lane], v[lane]));
  }
  return worst;
}

TEST_P(Exponential, IsWithinTwoUlpInDoublePrecision) {
  const auto& vector = of(1.0);
  const double worst = std::max({worst_error(vector, -760.0, 720.0, 200'000), worst_error(vector, -745.2, -708.0, 50'000),
                                 worst_error(vector, -1.0, 1.0, 100'000), worst_error(vector, -1e-9, 1e-9, 1000)});
  std::printf("%s, double: at most %.3f ulp off\n", simd().name, worst);
  EXPECT_LE(worst, 2.0);
}

TEST_P(Exponential, IsWithinTwoUlpInSinglePrecision) {
  const auto& vector = of(1.0F);
  const double worst = std::max({worst_error(vector, -110.0F, 95.0F, 200'000), worst_error(vector, -104.0F, -87.0F, 50'000),
                                 worst_error(vector, -1.0F, 1.0F, 100'000), worst_error(vector, -1e-5F, 1e-5F, 1000)});
  std::printf("%s, float: at most %.3f ulp off\n", simd().name, worst);
  EXPECT_LE(worst, 2.0);
}

template <class T>
void expect_ends(const VectorOperations<T>& vector, T largest, T smallest, T beyond) {
  const T infinity = std::numeric_limits<T>::infinity();
  const auto at = [&](T v) {
    Lanes<T> in{}, out{};
    in.fill(v);
    vector.exponential(in.data(), out.data());
    for (std::size_t k = 1; k < vector.lanes; ++k) EXPECT_TRUE(same<T>(out[k], out[0])) << v;
    return out[0];
  };
  EXPECT_EQ(at(0), T(1));
  EXPECT_EQ(at(-T(0)), T(1));
  EXPECT_EQ(at(infinity), infinity);
  EXPECT_EQ(at(-infinity), T(0));
  EXPECT_TRUE(std::isnan(at(std::numeric_limits<T>::quiet_NaN())));
  EXPECT_LT(at(largest), infinity);
  EXPECT_EQ(at(largest + beyond), infinity);
  EXPECT_GT(at(smallest), T(0));
  EXPECT_EQ(at(smallest - beyond), T(0));
  for (const T far : {T(1e4), T(1e30), std::numeric_limits<T>::max()}) {
    EXPECT_EQ(at(far), infinity);
    EXPECT_EQ(at(-far), T(0));
  }
}

TEST_P(Exponential, ReachesZeroAndInfinityWhereTheExactOneDoes) {
  // ln of the largest number, ln of half the smallest, and the distance beyond at which the result is infinity or zero.
  expect_ends(of(1.0), 709.78271, -745.13321, 1e-4);
  expect_ends(of(1.0F), 88.7228F, -103.9720F, 1e-3F);
}

}  // namespace
}  // namespace lanescape::testing
