#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/traits.hpp"

// What AVX-512 has instructions for and all others do without. The header of an instruction set includes this at its end.
namespace lanescape::kernels::LANESCAPE_ISA {

// Every lane is written; only those whose bit is set move the end on.
template <std::size_t lane_count, class T, class Value>
inline std::size_t compress_by_lane(T* p, unsigned mask, Value value) noexcept {
  std::size_t count = 0;
  for (std::size_t k = 0; k < lane_count; ++k) {
    p[count] = value(k);
    count += mask >> k & 1U;
  }
  return count;
}

inline std::size_t compress_store_lanes(std::int32_t* p, unsigned mask, std::int32_t first) noexcept {
  return compress_by_lane<lanes_of<Vector>>(p, mask, [=](std::size_t k) { return first + static_cast<std::int32_t>(k); });
}

inline std::size_t compress_store(double* p, unsigned mask, Vector v) noexcept {
  alignas(64) double lane[lanes_of<Vector>];
  store(lane, v);
  return compress_by_lane<lanes_of<Vector>>(p, mask, [&](std::size_t k) { return lane[k]; });
}

inline std::size_t compress_store(std::uint32_t* p, unsigned mask, const std::uint32_t* from) noexcept {
  return compress_by_lane<lanes_of<Vector>>(p, mask, [=](std::size_t k) { return from[k]; });
}

inline double reduce_max(Vector v) noexcept {
  alignas(64) double lane[lanes_of<Vector>];
  store(lane, v);
  double greatest = lane[0];
  for (std::size_t k = 1; k < lanes_of<Vector>; ++k) greatest = greatest < lane[k] ? lane[k] : greatest;
  return greatest;
}

// Half of the exponent at a time: one factor would overflow where the product is finite or not yet zero. Only the second product
// can be rounded.
template <class V>
inline V scale_by_power_of_two(V v, V n) noexcept {
  const V half = nearest_whole(n * broadcast<V>(0.5));
  return (v * power_of_two(half)) * power_of_two(n - half);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
