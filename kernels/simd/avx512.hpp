#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "isa.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
using Architecture = xsimd::avx512dq;
}
#include "simd/x86.hpp"

// AVX-512: eight doubles or sixteen floats; a mask is a bit per lane in a register of its own. xsimd has no fma here, and its
// masks cannot zero a result for free.
namespace lanescape::kernels::LANESCAPE_ISA {

inline Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return _mm512_fmadd_pd(a, b, c); }
inline Vector subtract_product(Vector c, Vector a, Vector b) noexcept { return _mm512_fnmadd_pd(a, b, c); }
inline Vector nearest_whole(Vector v) noexcept { return _mm512_roundscale_pd(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC); }
inline Vector reduce_to_nearest(Vector v) noexcept { return _mm512_reduce_pd(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC); }
inline Vector masked_quotient(Mask m, Vector a, Vector b) noexcept { return _mm512_maskz_div_pd(m, a, b); }
inline Vector masked_increment(Vector sum, Mask m) noexcept { return _mm512_mask_add_pd(sum, m, sum, _mm512_set1_pd(1.0)); }
inline Mask and_not(Mask a, Mask b) noexcept { return _kandn_mask8(b, a); }
inline unsigned bits(Mask m) noexcept { return _cvtmask8_u32(m); }
inline Vector scale_by_power_of_two(Vector v, Vector n) noexcept { return _mm512_scalef_pd(v, n); }

inline FloatVector multiply_add(FloatVector a, FloatVector b, FloatVector c) noexcept { return _mm512_fmadd_ps(a, b, c); }
inline FloatVector subtract_product(FloatVector c, FloatVector a, FloatVector b) noexcept { return _mm512_fnmadd_ps(a, b, c); }
inline FloatVector nearest_whole(FloatVector v) noexcept {
  return _mm512_roundscale_ps(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
}
inline FloatVector masked_quotient(FloatMask m, FloatVector a, FloatVector b) noexcept { return _mm512_maskz_div_ps(m, a, b); }
inline FloatVector masked_increment(FloatVector sum, FloatMask m) noexcept {
  return _mm512_mask_add_ps(sum, m, sum, _mm512_set1_ps(1.0F));
}
inline FloatMask and_not(FloatMask a, FloatMask b) noexcept { return _kandn_mask16(b, a); }
inline unsigned bits(FloatMask m) noexcept { return _cvtmask16_u32(m); }
inline FloatVector scale_by_power_of_two(FloatVector v, FloatVector n) noexcept { return _mm512_scalef_ps(v, n); }

template <class V>
inline MaskOf<V> first_lanes(std::size_t k) noexcept {
  return static_cast<typename MaskOf<V>::register_type>(((1U << lanes_of<V>)-1U) >> (lanes_of<V> - k));
}

inline double reduce_max(Vector v) noexcept { return _mm512_reduce_max_pd(v); }
inline __m256d fold_to_four(Vector v) noexcept { return _mm256_add_pd(_mm512_castpd512_pd256(v), _mm512_extractf64x4_pd(v, 1)); }

inline std::size_t compress_store_lanes(std::int32_t* p, unsigned mask, std::int32_t first) noexcept {
  const __m256i numbers = _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm256_maskz_compress_epi32(static_cast<__mmask8>(mask), numbers));
  return static_cast<std::size_t>(__builtin_popcount(mask));
}
inline std::size_t compress_store(double* p, unsigned mask, Vector v) noexcept {
  _mm512_storeu_pd(p, _mm512_maskz_compress_pd(static_cast<__mmask8>(mask), v));
  return static_cast<std::size_t>(__builtin_popcount(mask));
}
inline std::size_t compress_store(std::uint32_t* p, unsigned mask, const std::uint32_t* from) noexcept {
  const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm256_maskz_compress_epi32(static_cast<__mmask8>(mask), all));
  return static_cast<std::size_t>(__builtin_popcount(mask));
}
inline std::size_t compress_store_wide(std::uint32_t* p, std::uint32_t mask, const std::uint32_t* from) noexcept {
  _mm512_storeu_si512(p, _mm512_maskz_compress_epi32(static_cast<__mmask16>(mask), _mm512_loadu_si512(from)));
  return static_cast<std::size_t>(__builtin_popcount(mask));
}
inline std::size_t compress_store_offsets(std::uint32_t* p, std::uint32_t mask, std::uint32_t first) noexcept {
  const __m512i offsets = _mm512_add_epi32(_mm512_set1_epi32(static_cast<std::int32_t>(4 * first)),
                                           _mm512_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28, 32, 36, 40, 44, 48, 52, 56, 60));
  _mm512_storeu_si512(p, _mm512_maskz_compress_epi32(static_cast<__mmask16>(mask), offsets));
  return static_cast<std::size_t>(__builtin_popcount(mask));
}

inline Vector gather(const double* base, const std::int32_t* index) noexcept {
  return _mm512_set_pd(base[index[7]], base[index[6]], base[index[5]], base[index[4]], base[index[3]], base[index[2]],
                       base[index[1]], base[index[0]]);
}

inline void gather_records(const double* base, const std::int32_t* index, Vector* out) noexcept {
  __m512d r[8], s[8];
#pragma GCC unroll 8
  for (int k = 0; k < 8; ++k) r[k] = _mm512_load_pd(base + 8 * static_cast<std::ptrdiff_t>(index[k]));
#pragma GCC unroll 4
  for (int k = 0; k < 4; ++k) {  // s[2k], s[2k + 1]: even and odd fields of records 2k and 2k + 1
    s[2 * k] = _mm512_unpacklo_pd(r[2 * k], r[2 * k + 1]);
    s[2 * k + 1] = _mm512_unpackhi_pd(r[2 * k], r[2 * k + 1]);
  }
#pragma GCC unroll 2
  for (int odd = 0; odd < 2; ++odd) {
    const __m512d low = _mm512_shuffle_f64x2(s[odd], s[2 + odd], 0x88), high = _mm512_shuffle_f64x2(s[4 + odd], s[6 + odd], 0x88);
    const __m512d low2 = _mm512_shuffle_f64x2(s[odd], s[2 + odd], 0xdd), high2 = _mm512_shuffle_f64x2(s[4 + odd], s[6 + odd], 0xdd);
    out[0 + odd] = _mm512_shuffle_f64x2(low, high, 0x88);
    out[4 + odd] = _mm512_shuffle_f64x2(low, high, 0xdd);
    out[2 + odd] = _mm512_shuffle_f64x2(low2, high2, 0x88);
    out[6 + odd] = _mm512_shuffle_f64x2(low2, high2, 0xdd);
  }
}

// Eight records of four doubles as columns x, z and y, w, each still in pairs.
struct PairedColumns {
  __m512d xz_ab, xz_cd, yw_ab, yw_cd;
};
template <class Offsets>
inline PairedColumns paired_columns(const double* base, const Offsets& offset) noexcept {
  const auto two = [&](int k) __attribute__((always_inline)) {
    return _mm512_mask_broadcast_f64x4(_mm512_castpd256_pd512(_mm256_load_pd(base + offset[k])), 0xf0,
                                       _mm256_load_pd(base + offset[k + 2]));
  };
  const __m512d a = two(0), b = two(1), c = two(4), d = two(5);
  return {_mm512_unpacklo_pd(a, b), _mm512_unpacklo_pd(c, d), _mm512_unpackhi_pd(a, b), _mm512_unpackhi_pd(c, d)};
}

template <class Offsets>
inline void gather_points(const double* base, const Offsets& offset, Vector& x, Vector& y, Vector& z) noexcept {
  const PairedColumns c = paired_columns(base, offset);
  x = _mm512_shuffle_f64x2(c.xz_ab, c.xz_cd, 0x88);
  y = _mm512_shuffle_f64x2(c.yw_ab, c.yw_cd, 0x88);
  z = _mm512_shuffle_f64x2(c.xz_ab, c.xz_cd, 0xdd);
}

template <class Offsets>
inline void gather_quads(const double* base, const Offsets& offset, Vector& x, Vector& y, Vector& z, Vector& w) noexcept {
  const PairedColumns c = paired_columns(base, offset);
  x = _mm512_shuffle_f64x2(c.xz_ab, c.xz_cd, 0x88);
  y = _mm512_shuffle_f64x2(c.yw_ab, c.yw_cd, 0x88);
  z = _mm512_shuffle_f64x2(c.xz_ab, c.xz_cd, 0xdd);
  w = _mm512_shuffle_f64x2(c.yw_ab, c.yw_cd, 0xdd);
}

inline FloatVector wrapped_difference(const std::int32_t* p, std::int32_t s) noexcept {
  return _mm512_cvtepi32_ps(_mm512_sub_epi32(_mm512_load_si512(p), _mm512_set1_epi32(s)));
}

inline void gather_differences(const std::int32_t* base, const std::uint32_t* offset, const std::int32_t* origin, FloatVector& x,
                               FloatVector& y, FloatVector& z) noexcept {
  // Eight at a time: what puts 128 bits into a wider register is cheaper in the narrower one.
  struct Eight {
    __m256i x, y, z;
  };
  const auto one = [&](int k) { return _mm_load_si128(reinterpret_cast<const __m128i*>(base + offset[k])); };
  const auto eight = [&](int k) -> Eight {
    const auto two = [&](int i) { return _mm256_inserti128_si256(_mm256_castsi128_si256(one(k + i)), one(k + i + 4), 1); };
    const __m256i a = two(0), b = two(1), c = two(2), d = two(3);
    const __m256i xy_ab = _mm256_unpacklo_epi32(a, b), xy_cd = _mm256_unpacklo_epi32(c, d);
    return {_mm256_unpacklo_epi64(xy_ab, xy_cd), _mm256_unpackhi_epi64(xy_ab, xy_cd),
            _mm256_unpacklo_epi64(_mm256_unpackhi_epi32(a, b), _mm256_unpackhi_epi32(c, d))};
  };
  const Eight low = eight(0), high = eight(8);
  const auto from = [&](__m256i l, __m256i h, int axis) {
    const __m512i both_halves = _mm512_inserti64x4(_mm512_castsi256_si512(l), h, 1);
    return _mm512_cvtepi32_ps(_mm512_sub_epi32(both_halves, _mm512_set1_epi32(origin[axis])));
  };
  x = from(low.x, high.x, 0);
  y = from(low.y, high.y, 1);
  z = from(low.z, high.z, 2);
}

using FixedVector = __m512i;
inline FixedVector load_cluster(const std::int32_t* p) noexcept {
  return _mm512_broadcast_i32x8(_mm256_load_si256(reinterpret_cast<const __m256i*>(p)));
}
inline FixedVector load_rows(const std::int32_t* p) noexcept {
  return _mm512_inserti64x4(_mm512_set1_epi32(p[0]), _mm256_set1_epi32(p[1]), 1);
}
inline FloatVector wrapped_difference(FixedVector a, FixedVector b) noexcept { return _mm512_cvtepi32_ps(_mm512_sub_epi32(a, b)); }
inline void subtract_from_cluster(float* p, FloatVector v) noexcept {
  const __m256 rows = _mm256_add_ps(_mm512_castps512_ps256(v), _mm512_extractf32x8_ps(v, 1));
  _mm256_store_ps(p, _mm256_sub_ps(_mm256_load_ps(p), rows));
}
inline void add_to_rows(float* p, const FloatVector* v) noexcept {
  // In each 128 bits: rows 0 and 2 twice in the first half, rows 1 and 3 twice in the second.
  const __m512 pairs = _mm512_add_ps(_mm512_unpacklo_ps(v[0], v[1]), _mm512_unpackhi_ps(v[0], v[1]));
  const __m512 sums = _mm512_add_ps(pairs, _mm512_shuffle_f32x4(pairs, pairs, 0xb1));
  const __m128 even = _mm512_castps512_ps128(sums), odd = _mm512_extractf32x4_ps(sums, 2);
  const __m128 rows = _mm_add_ps(_mm_unpacklo_ps(even, odd), _mm_unpackhi_ps(even, odd));
  _mm_store_ps(p, _mm_add_ps(_mm_load_ps(p), rows));
}

inline Vector add_halves(FloatVector v) noexcept {
  return _mm512_add_pd(_mm512_cvtps_pd(_mm512_castps512_ps256(v)), _mm512_cvtps_pd(_mm512_extractf32x8_ps(v, 1)));
}
inline void store_truncated(std::int32_t* out, Vector v) noexcept {
  _mm256_store_si256(reinterpret_cast<__m256i*>(out), _mm512_cvttpd_epi32(v));
}
inline void store_wrapped(std::int32_t* out, Vector v) noexcept {
  _mm256_store_si256(reinterpret_cast<__m256i*>(out), _mm512_cvtpd_epi32(v));
}

}  // namespace lanescape::kernels::LANESCAPE_ISA

#include "simd/sums_256.hpp"
