#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "every_isa.hpp"
#include "operations.hpp"

namespace lanescape::kernels {
#define LANESCAPE_ENTRY(name, supported)           \
  namespace name {                                 \
  extern const testing::SimdOperations operations; \
  }
LANESCAPE_BUILT_INSTRUCTION_SETS(LANESCAPE_ENTRY)
#undef LANESCAPE_ENTRY
}  // namespace lanescape::kernels

namespace lanescape::testing {

inline const SimdOperations& simd_operations(Isa isa) {
#define LANESCAPE_ENTRY(name, supported) \
  if (isa == Isa::name) return kernels::name::operations;
  LANESCAPE_BUILT_INSTRUCTION_SETS(LANESCAPE_ENTRY)
#undef LANESCAPE_ENTRY
  throw std::runtime_error("instruction set is not compiled in");
}

// A test for each instruction set, with its vector operations.
class EverySimd : public EveryIsa {
 protected:
  const SimdOperations& simd() const { return simd_operations(GetParam()); }
  const VectorOperations<double>& of(double) const { return simd().doubles; }
  const VectorOperations<float>& of(float) const { return simd().floats; }
};

// Space for eight vectors of any instruction set.
template <class T>
struct alignas(64) Lanes : std::array<T, 128> {};

// Ordinary numbers and numbers at which operations fail; every lane of every vector gets each of them.
template <class T>
std::vector<T> awkward_numbers() {
  using Limits = std::numeric_limits<T>;
  std::vector<T> numbers;
  for (const T v : {T(0), T(0.5), T(1), T(1.5), T(2.5), T(3), T(0.49999997), T(1.0 / 3.0), T(1e-3), T(12345.678), T(4096.5),
                    Limits::min(), Limits::denorm_min(), Limits::min() / 8, Limits::max(), Limits::epsilon(), Limits::infinity()}) {
    numbers.push_back(v);
    numbers.push_back(-v);
  }
  numbers.push_back(Limits::quiet_NaN());
  return numbers;
}

// The same bits, or both NaN.
template <class T>
bool same(T a, T b) {
  using Bits = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
  return (std::isnan(a) && std::isnan(b)) || std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

// Calls check(vector of a, vector of b) with every pair of numbers, rotated so that each pair is in each lane.
template <class T, class Check>
void for_each_pair(const std::vector<T>& numbers, std::size_t lanes, Check check) {
  const std::size_t n = numbers.size();
  for (std::size_t first = 0; first < n; ++first)
    for (std::size_t apart = 0; apart < n; ++apart) {
      Lanes<T> a{}, b{};
      for (std::size_t k = 0; k < lanes; ++k) {
        a[k] = numbers[(first + k) % n];
        b[k] = numbers[(first + k + apart) % n];
      }
      check(a, b);
    }
}

// The masks of `lanes` lanes (a selection if there are many), as bits and as numbers.
template <class T, class Check>
void for_each_mask(std::size_t lanes, Check check) {
  const unsigned count = 1U << lanes;
  for (unsigned bits = 0; bits < count; bits += count > 256 ? 37 : 1) {
    Lanes<T> mask{};
    for (std::size_t k = 0; k < lanes; ++k) mask[k] = static_cast<T>(bits >> k & 1U);
    check(bits, mask);
  }
}

}  // namespace lanescape::testing
