#pragma once

#include <immintrin.h>

#include "isa.hpp"

// Sums of lanes to four consecutive doubles, in 256 bits. `fold_to_four` comes from the instruction set.
namespace lanescape::kernels::LANESCAPE_ISA {

inline void reduce_add_four(double* out, Vector a, Vector b, Vector c, Vector d) noexcept {
  const __m256d ab = _mm256_hadd_pd(fold_to_four(a), fold_to_four(b));  // a01 b01 a23 b23
  const __m256d cd = _mm256_hadd_pd(fold_to_four(c), fold_to_four(d));
  const __m256d crossed = _mm256_permute2f128_pd(ab, cd, 0x21);  // a23 b23 c01 d01
  const __m256d straight = _mm256_blend_pd(ab, cd, 0b1100);      // a01 b01 c23 d23
  _mm256_store_pd(out, _mm256_add_pd(_mm256_load_pd(out), _mm256_add_pd(crossed, straight)));
}

inline void store_point(double* out, Vector x, Vector y, Vector z) noexcept {
  const __m256d xy = _mm256_hadd_pd(fold_to_four(x), fold_to_four(y));            // x01 y01 x23 y23
  const __m256d z0 = _mm256_hadd_pd(fold_to_four(z), _mm256_setzero_pd());        // z01 0 z23 0
  const __m256d crossed = _mm256_permute2f128_pd(xy, z0, 0x21);                   // x23 y23 z01 0
  _mm256_store_pd(out, _mm256_add_pd(crossed, _mm256_blend_pd(xy, z0, 0b1100)));  // x01 y01 z23 0
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
