// Arithmetic of vectors of doubles and floats, compared lane by lane with scalar arithmetic.

#include <gtest/gtest.h>

#include "every_simd.hpp"

namespace lanescape::testing {
namespace {

using Arithmetic = EverySimd;
INSTANTIATE_TEST_SUITE_P(Isa, Arithmetic, all_isas(), isa_name);

template <class T, class Wanted>
void expect_unary(const VectorOperations<T>& vector, typename VectorOperations<T>::Unary operation, const char* name,
                  const std::vector<T>& numbers, Wanted wanted) {
  for_each_pair(numbers, vector.lanes, [&](const Lanes<T>& a, const Lanes<T>&) {
    Lanes<T> out{};
    operation(a.data(), out.data());
    for (std::size_t k = 0; k < vector.lanes; ++k)
      EXPECT_TRUE(same<T>(out[k], wanted(a[k]))) << name << ' ' << a[k] << ": " << out[k];
  });
}

template <class T, class Wanted>
void expect_binary(const VectorOperations<T>& vector, typename VectorOperations<T>::Binary operation, const char* name,
                   Wanted wanted) {
  for_each_pair(awkward_numbers<T>(), vector.lanes, [&](const Lanes<T>& a, const Lanes<T>& b) {
    Lanes<T> out{};
    operation(a.data(), b.data(), out.data());
    for (std::size_t k = 0; k < vector.lanes; ++k)
      EXPECT_TRUE(same<T>(out[k], wanted(a[k], b[k]))) << name << ' ' << a[k] << ' ' << b[k] << ": " << out[k];
  });
}

template <class T>
void expect_arithmetic(const VectorOperations<T>& v) {
  expect_binary(v, v.add, "add", [](T a, T b) { return a + b; });
  expect_binary(v, v.add_to, "add_to", [](T a, T b) { return a + b; });
  expect_binary(v, v.subtract, "subtract", [](T a, T b) { return a - b; });
  expect_binary(v, v.multiply, "multiply", [](T a, T b) { return a * b; });
  expect_binary(v, v.divide, "divide", [](T a, T b) { return a / b; });
  expect_binary(v, v.maximum, "maximum", [](T a, T b) { return a > b ? a : b; });
  expect_binary(v, v.minimum, "minimum", [](T a, T b) { return a < b ? a : b; });
  expect_binary(v, v.copy_sign, "copy_sign", [](T a, T b) { return std::copysign(a, b); });
  const auto numbers = awkward_numbers<T>();
  expect_unary(v, v.copy, "copy", numbers, [](T a) { return a; });
  expect_unary(v, v.absolute, "absolute", numbers, [](T a) { return std::fabs(a); });
  expect_unary(v, v.square_root, "square_root", numbers, [](T a) { return std::sqrt(a); });
}

TEST_P(Arithmetic, IsThatOfTheLanguageInDoublePrecision) { expect_arithmetic(of(1.0)); }
TEST_P(Arithmetic, IsThatOfTheLanguageInSinglePrecision) { expect_arithmetic(of(1.0F)); }

template <class T>
void expect_whole_numbers(const VectorOperations<T>& v) {
  std::vector<T> numbers;
  for (int eighth = -40; eighth <= 40; ++eighth) numbers.push_back(static_cast<T>(eighth) / 8);
  const T largest = std::ldexp(T(1), std::numeric_limits<T>::digits - 2);
  for (const T below : {T(0.25), T(0.5), T(0.75), T(1), T(1.5)})
    for (const T sign : {T(-1), T(1)}) numbers.push_back(sign * (largest - below));
  for_each_pair(numbers, v.lanes, [&](const Lanes<T>& a, const Lanes<T>&) {
    Lanes<T> out{};
    v.nearest_whole(a.data(), out.data());
    // Equal, but the bits may differ: without a dedicated instruction -0 becomes +0.
    for (std::size_t k = 0; k < v.lanes; ++k) EXPECT_EQ(out[k], std::nearbyint(a[k])) << a[k];
  });
}

TEST_P(Arithmetic, RoundsHalvesToEvenInDoublePrecision) { expect_whole_numbers(of(1.0)); }
TEST_P(Arithmetic, RoundsHalvesToEvenInSinglePrecision) { expect_whole_numbers(of(1.0F)); }

// Products that are not exact: they show whether they are rounded before the sum.
template <class T>
void expect_fused_or_not(const VectorOperations<T>& v, bool fused) {
  using Limits = std::numeric_limits<T>;
  const std::vector<T> numbers{
      1 + Limits::epsilon(), 1 - Limits::epsilon(), T(1.0 / 3.0), -1, T(0.1), 7, -Limits::max(), Limits::infinity(), 0};
  for_each_pair(numbers, v.lanes, [&](const Lanes<T>& a, const Lanes<T>& b) {
    for (const T c : {T(0), T(-1), T(1.0 / 3.0), Limits::quiet_NaN(), -Limits::infinity()}) {
      Lanes<T> third{}, sum{}, difference{};
      third.fill(c);
      v.multiply_add(a.data(), b.data(), third.data(), sum.data());
      v.subtract_product(third.data(), a.data(), b.data(), difference.data());
      for (std::size_t k = 0; k < v.lanes; ++k) {
        const volatile T product = a[k] * b[k];
        EXPECT_TRUE(same<T>(sum[k], fused ? std::fma(a[k], b[k], c) : product + c)) << a[k] << ' ' << b[k] << ' ' << c;
        EXPECT_TRUE(same<T>(difference[k], fused ? std::fma(-a[k], b[k], c) : c - product)) << a[k] << ' ' << b[k] << ' ' << c;
      }
    }
  });
}

TEST_P(Arithmetic, FusesProductAndSumWhereTheInstructionSetCan) {
  const bool fused = GetParam() == Isa::avx2 || GetParam() == Isa::avx512;
  expect_fused_or_not(of(1.0), fused);
  expect_fused_or_not(of(1.0F), fused);
}

template <class T>
void expect_powers_of_two(const VectorOperations<T>& v, int largest) {
  Lanes<T> a{}, n{}, out{};
  for (const T factor : {T(1), T(-1), T(0.75), T(1.4142135), T(0)})
    for (int power = -largest; power <= largest; ++power) {
      a.fill(factor);
      n.fill(static_cast<T>(power));
      v.scale_by_power_of_two(a.data(), n.data(), out.data());
      for (std::size_t k = 0; k < v.lanes; ++k) EXPECT_TRUE(same<T>(out[k], std::ldexp(factor, power))) << factor << " 2^" << power;
    }
}

TEST_P(Arithmetic, ScalesByPowersOfTwoDownToDenormalsAndUpToInfinity) {
  expect_powers_of_two(of(1.0), 1090);
  expect_powers_of_two(of(1.0F), 180);
}

template <class T>
void expect_loads_and_stores(const VectorOperations<T>& v) {
  Lanes<T> from{}, to{};
  for (std::size_t k = 0; k < from.size(); ++k) from[k] = static_cast<T>(k) + T(0.5);
  for (std::size_t start = 0; start <= v.lanes; ++start) {
    to.fill(-1);
    v.copy_unaligned(from.data() + start, to.data() + start);
    for (std::size_t k = 0; k < to.size(); ++k) EXPECT_EQ(to[k], k >= start && k < start + v.lanes ? from[k] : T(-1));
  }
  for (const T s : {T(0), -T(0), T(1.25), std::numeric_limits<T>::infinity()}) {
    v.broadcast(s, to.data());
    for (std::size_t k = 0; k < v.lanes; ++k) EXPECT_TRUE(same(to[k], s));
  }
}

TEST_P(Arithmetic, LoadsAndStoresAnywhereAndNothingBeside) {
  expect_loads_and_stores(of(1.0));
  expect_loads_and_stores(of(1.0F));
}

TEST_P(Arithmetic, LeavesTheNearestImageOfASeparation) {
  std::vector<double> numbers;
  for (int eighth = -40; eighth <= 40; ++eighth) numbers.push_back(eighth / 8.0);
  for (const double v : {0.1, 1e6 + 0.3, -123456.789, 1e-300}) numbers.push_back(v);
  for_each_pair(numbers, simd().doubles.lanes, [&](const Lanes<double>& a, const Lanes<double>&) {
    Lanes<double> out{};
    simd().reduce_to_nearest(a.data(), out.data());
    for (std::size_t k = 0; k < simd().doubles.lanes; ++k) EXPECT_EQ(out[k], a[k] - std::nearbyint(a[k])) << a[k];
  });
}

}  // namespace
}  // namespace lanescape::testing
