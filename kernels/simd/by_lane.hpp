#pragma once

#include "simd/without_avx512.hpp"

// What SSE2 and the portable instruction set do lane by lane.
namespace lanescape::kernels::LANESCAPE_ISA {

inline void reduce_add_four(double* out, Vector a, Vector b, Vector c, Vector d) noexcept {
  out[0] += reduce_add(a);
  out[1] += reduce_add(b);
  out[2] += reduce_add(c);
  out[3] += reduce_add(d);
}

inline void store_point(double* out, Vector x, Vector y, Vector z) noexcept {
  out[0] = reduce_add(x);
  out[1] = reduce_add(y);
  out[2] = reduce_add(z);
  out[3] = 0.0;
}

inline std::size_t compress_store_wide(std::uint32_t* p, std::uint32_t mask, const std::uint32_t* from) noexcept {
  return compress_by_lane<lanes_of<FloatVector>>(p, mask, [=](std::size_t k) { return from[k]; });
}
inline std::size_t compress_store_offsets(std::uint32_t* p, std::uint32_t mask, std::uint32_t first) noexcept {
  return compress_by_lane<lanes_of<FloatVector>>(p, mask,
                                                 [=](std::size_t k) { return 4 * (first + static_cast<std::uint32_t>(k)); });
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
