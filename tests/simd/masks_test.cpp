// Comparisons, masks and select, for doubles and floats.

#include <gtest/gtest.h>

#include "every_simd.hpp"

namespace lanescape::testing {
namespace {

using Masks = EverySimd;
INSTANTIATE_TEST_SUITE_P(Isa, Masks, all_isas(), isa_name);

template <class T, class Wanted>
void expect_compared(const VectorOperations<T>& v, typename VectorOperations<T>::Bits operation, Wanted wanted) {
  for_each_pair(awkward_numbers<T>(), v.lanes, [&](const Lanes<T>& a, const Lanes<T>& b) {
    unsigned expected = 0;
    for (std::size_t k = 0; k < v.lanes; ++k) expected |= (wanted(a[k], b[k]) ? 1U : 0U) << k;
    EXPECT_EQ(operation(a.data(), b.data()), expected);
  });
}

template <class T>
void expect_comparisons(const VectorOperations<T>& v) {
  expect_compared(v, v.less, [](T a, T b) { return a < b; });
  expect_compared(v, v.equal, [](T a, T b) { return a == b; });
}

TEST_P(Masks, CompareAsTheLanguageDoes) {
  expect_comparisons(of(1.0));
  expect_comparisons(of(1.0F));
}

template <class T>
void expect_logic(const VectorOperations<T>& v) {
  for_each_mask<T>(v.lanes, [&](unsigned m, const Lanes<T>& first) {
    EXPECT_EQ(v.any(first.data()), m != 0) << m;
    for_each_mask<T>(v.lanes, [&](unsigned n, const Lanes<T>& second) {
      EXPECT_EQ(v.both(first.data(), second.data()), m & n);
      EXPECT_EQ(v.either(first.data(), second.data()), m | n);
      EXPECT_EQ(v.and_not(first.data(), second.data()), m & ~n);
    });
  });
}

TEST_P(Masks, CombineBitByBit) {
  expect_logic(of(1.0));
  expect_logic(of(1.0F));
}

template <class T>
void expect_selection(const VectorOperations<T>& v) {
  const auto numbers = awkward_numbers<T>();
  for_each_mask<T>(v.lanes, [&](unsigned bits, const Lanes<T>& mask) {
    Lanes<T> a{}, b{}, chosen{}, quotient{}, reciprocal{}, sum{};
    for (std::size_t k = 0; k < v.lanes; ++k) {
      a[k] = numbers[(bits + 3 * k) % numbers.size()];
      b[k] = numbers[(5 * bits + 7 * k) % numbers.size()];
    }
    v.select(mask.data(), a.data(), b.data(), chosen.data());
    v.masked_quotient(mask.data(), a.data(), b.data(), quotient.data());
    v.masked_reciprocal(mask.data(), b.data(), reciprocal.data());
    v.masked_increment(mask.data(), a.data(), sum.data());
    for (std::size_t k = 0; k < v.lanes; ++k) {
      const bool set = bits >> k & 1U;
      EXPECT_TRUE(same<T>(chosen[k], set ? a[k] : b[k])) << a[k] << ' ' << b[k];
      EXPECT_TRUE(same<T>(quotient[k], set ? a[k] / b[k] : T(0))) << a[k] << ' ' << b[k];
      EXPECT_TRUE(same<T>(reciprocal[k], set ? T(1) / b[k] : T(0))) << b[k];
      EXPECT_EQ(std::isnan(sum[k]), std::isnan(a[k]));
      if (!std::isnan(a[k])) {
        EXPECT_EQ(sum[k], set ? a[k] + T(1) : a[k]);
      }
    }
  });
}

TEST_P(Masks, SelectDivideAndCountWhereTheyAreSet) {
  expect_selection(of(1.0));
  expect_selection(of(1.0F));
}

template <class T>
void expect_tails(const VectorOperations<T>& v) {
  const unsigned all = (1U << v.lanes) - 1U;
  for (std::size_t k = 0; k <= v.lanes; ++k) {
    EXPECT_EQ(v.lanes_below_unsigned(k), (1U << k) - 1U) << k;
    EXPECT_EQ(v.lanes_below(static_cast<std::ptrdiff_t>(k)), (1U << k) - 1U) << k;
  }
  for (const std::ptrdiff_t k : {std::ptrdiff_t{-1}, std::ptrdiff_t{-1000}, std::numeric_limits<std::ptrdiff_t>::min()})
    EXPECT_EQ(v.lanes_below(k), 0U) << k;
  for (const std::ptrdiff_t k : {std::ptrdiff_t{17}, std::ptrdiff_t{1000}, std::numeric_limits<std::ptrdiff_t>::max()}) {
    EXPECT_EQ(v.lanes_below(k), all) << k;
    EXPECT_EQ(v.lanes_below_unsigned(static_cast<std::size_t>(k)), all) << k;
  }
}

TEST_P(Masks, OfTailsHaveTheFirstLanesSet) {
  expect_tails(of(1.0));
  expect_tails(of(1.0F));
}

}  // namespace
}  // namespace lanescape::testing
