#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "isa.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
using Architecture = xsimd::fma3<xsimd::avx2>;
}
#include "simd/x86.hpp"

// AVX2 with FMA: four doubles or eight floats; a mask is a vector of all bits or none.
namespace lanescape::kernels::LANESCAPE_ISA {

inline Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return _mm256_fmadd_pd(a, b, c); }
inline Vector subtract_product(Vector c, Vector a, Vector b) noexcept { return _mm256_fnmadd_pd(a, b, c); }
inline Vector nearest_whole(Vector v) noexcept { return _mm256_round_pd(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC); }
inline Vector reduce_to_nearest(Vector v) noexcept { return v - nearest_whole(v); }
inline Vector masked_quotient(Mask m, Vector a, Vector b) noexcept { return _mm256_and_pd(m, _mm256_div_pd(a, b)); }
inline Vector masked_increment(Vector sum, Mask m) noexcept { return _mm256_add_pd(sum, _mm256_and_pd(m, _mm256_set1_pd(1.0))); }
inline Mask and_not(Mask a, Mask b) noexcept { return _mm256_andnot_pd(b, a); }
inline unsigned bits(Mask m) noexcept { return static_cast<unsigned>(_mm256_movemask_pd(m)); }
// 1.5 x 2^52 leaves no bits for a fraction: the lowest bits of the sum are the number.
inline Vector power_of_two(Vector n) noexcept {
  const __m256i number = _mm256_castpd_si256(n + Vector(6755399441055744.0 + 1023.0));
  return _mm256_castsi256_pd(_mm256_slli_epi64(number, 52));
}

inline FloatVector multiply_add(FloatVector a, FloatVector b, FloatVector c) noexcept { return _mm256_fmadd_ps(a, b, c); }
inline FloatVector subtract_product(FloatVector c, FloatVector a, FloatVector b) noexcept { return _mm256_fnmadd_ps(a, b, c); }
inline FloatVector nearest_whole(FloatVector v) noexcept {
  return _mm256_round_ps(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
}
inline FloatVector masked_quotient(FloatMask m, FloatVector a, FloatVector b) noexcept {
  return _mm256_and_ps(m, _mm256_div_ps(a, b));
}
inline FloatVector masked_increment(FloatVector sum, FloatMask m) noexcept {
  return _mm256_add_ps(sum, _mm256_and_ps(m, _mm256_set1_ps(1.0F)));
}
inline FloatMask and_not(FloatMask a, FloatMask b) noexcept { return _mm256_andnot_ps(b, a); }
inline unsigned bits(FloatMask m) noexcept { return static_cast<unsigned>(_mm256_movemask_ps(m)); }
inline FloatVector power_of_two(FloatVector n) noexcept {
  const __m256i number = _mm256_castps_si256(n + FloatVector(12582912.0F + 127.0F));
  return _mm256_castsi256_ps(_mm256_slli_epi32(number, 23));
}

template <class V>
inline MaskOf<V> first_lanes(std::size_t k) noexcept {
  return load_first_lanes<V>(k);
}
inline __m256d fold_to_four(Vector v) noexcept { return v; }

// For each mask of eight lanes, which lanes are set, in order.
struct SetLanes {
  unsigned char of[256][8] = {};
  constexpr SetLanes() {
    for (int mask = 0; mask < 256; ++mask)
      for (int lane = 0, count = 0; lane < 8; ++lane)
        if (mask >> lane & 1) of[mask][count++] = static_cast<unsigned char>(lane);
  }
};
inline constexpr SetLanes set_lanes;

inline std::size_t compress_store_wide(std::uint32_t* p, std::uint32_t mask, const std::uint32_t* from) noexcept {
  const __m256i lanes_set = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(set_lanes.of[mask & 0xffU])));
  const __m256i numbers = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm256_permutevar8x32_epi32(numbers, lanes_set));
  return static_cast<std::size_t>(__builtin_popcount(mask));
}
inline std::size_t compress_store_offsets(std::uint32_t* p, std::uint32_t mask, std::uint32_t first) noexcept {
  const __m256i lanes_set = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(set_lanes.of[mask & 0xffU])));
  const __m256i offsets = _mm256_slli_epi32(_mm256_add_epi32(_mm256_set1_epi32(static_cast<std::int32_t>(first)), lanes_set), 2);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), offsets);
  return static_cast<std::size_t>(__builtin_popcount(mask));
}

inline Vector gather(const double* base, const std::int32_t* index) noexcept {
  return _mm256_set_pd(base[index[3]], base[index[2]], base[index[1]], base[index[0]]);
}

inline void gather_records(const double* base, const std::int32_t* index, Vector* out) noexcept {
#pragma GCC unroll 2
  for (int half = 0; half < 2; ++half) {
    const auto row = [&](int k) { return _mm256_load_pd(base + 8 * static_cast<std::ptrdiff_t>(index[k]) + 4 * half); };
    const __m256d r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
    const __m256d a = _mm256_unpacklo_pd(r0, r1), b = _mm256_unpackhi_pd(r0, r1);
    const __m256d c = _mm256_unpacklo_pd(r2, r3), d = _mm256_unpackhi_pd(r2, r3);
    out[4 * half + 0] = _mm256_permute2f128_pd(a, c, 0x20);
    out[4 * half + 1] = _mm256_permute2f128_pd(b, d, 0x20);
    out[4 * half + 2] = _mm256_permute2f128_pd(a, c, 0x31);
    out[4 * half + 3] = _mm256_permute2f128_pd(b, d, 0x31);
  }
}

// Four records of four doubles as columns x, z and y, w, each still in pairs.
struct PairedColumns {
  __m256d xz_ab, xz_cd, yw_ab, yw_cd;
};
template <class Offsets>
inline PairedColumns paired_columns(const double* base, const Offsets& offset) noexcept {
  const auto one = [&](int k) __attribute__((always_inline)) { return _mm256_load_pd(base + offset[k]); };
  const __m256d a = one(0), b = one(1), c = one(2), d = one(3);
  return {_mm256_unpacklo_pd(a, b), _mm256_unpacklo_pd(c, d), _mm256_unpackhi_pd(a, b), _mm256_unpackhi_pd(c, d)};
}

template <class Offsets>
inline void gather_points(const double* base, const Offsets& offset, Vector& x, Vector& y, Vector& z) noexcept {
  const PairedColumns c = paired_columns(base, offset);
  x = _mm256_permute2f128_pd(c.xz_ab, c.xz_cd, 0x20);
  y = _mm256_permute2f128_pd(c.yw_ab, c.yw_cd, 0x20);
  z = _mm256_permute2f128_pd(c.xz_ab, c.xz_cd, 0x31);
}

template <class Offsets>
inline void gather_quads(const double* base, const Offsets& offset, Vector& x, Vector& y, Vector& z, Vector& w) noexcept {
  const PairedColumns c = paired_columns(base, offset);
  x = _mm256_permute2f128_pd(c.xz_ab, c.xz_cd, 0x20);
  y = _mm256_permute2f128_pd(c.yw_ab, c.yw_cd, 0x20);
  z = _mm256_permute2f128_pd(c.xz_ab, c.xz_cd, 0x31);
  w = _mm256_permute2f128_pd(c.yw_ab, c.yw_cd, 0x31);
}

inline FloatVector wrapped_difference(const std::int32_t* p, std::int32_t s) noexcept {
  return _mm256_cvtepi32_ps(_mm256_sub_epi32(_mm256_load_si256(reinterpret_cast<const __m256i*>(p)), _mm256_set1_epi32(s)));
}

inline void gather_differences(const std::int32_t* base, const std::uint32_t* offset, const std::int32_t* origin, FloatVector& x,
                               FloatVector& y, FloatVector& z) noexcept {
  const auto one = [&](int k) { return _mm_load_si128(reinterpret_cast<const __m128i*>(base + offset[k])); };
  const auto column = [&](int k) { return _mm256_inserti128_si256(_mm256_castsi128_si256(one(k)), one(k + 4), 1); };
  const __m256i a = column(0), b = column(1), c = column(2), d = column(3);
  const __m256i xy_ab = _mm256_unpacklo_epi32(a, b), xy_cd = _mm256_unpacklo_epi32(c, d);
  const __m256i z_ab = _mm256_unpackhi_epi32(a, b), z_cd = _mm256_unpackhi_epi32(c, d);
  const auto from = [&](__m256i v, int axis) { return _mm256_cvtepi32_ps(_mm256_sub_epi32(v, _mm256_set1_epi32(origin[axis]))); };
  x = from(_mm256_unpacklo_epi64(xy_ab, xy_cd), 0);
  y = from(_mm256_unpackhi_epi64(xy_ab, xy_cd), 1);
  z = from(_mm256_unpacklo_epi64(z_ab, z_cd), 2);
}

using FixedVector = __m256i;
inline FixedVector load_cluster(const std::int32_t* p) noexcept { return _mm256_load_si256(reinterpret_cast<const __m256i*>(p)); }
inline FixedVector load_rows(const std::int32_t* p) noexcept { return _mm256_set1_epi32(*p); }
inline FloatVector wrapped_difference(FixedVector a, FixedVector b) noexcept { return _mm256_cvtepi32_ps(_mm256_sub_epi32(a, b)); }
inline void subtract_from_cluster(float* p, FloatVector v) noexcept { _mm256_store_ps(p, _mm256_sub_ps(_mm256_load_ps(p), v)); }
inline void add_to_rows(float* p, const FloatVector* v) noexcept {
  const __m256 four = _mm256_hadd_ps(_mm256_hadd_ps(v[0], v[1]), _mm256_hadd_ps(v[2], v[3]));
  const __m128 rows = _mm_add_ps(_mm256_castps256_ps128(four), _mm256_extractf128_ps(four, 1));
  _mm_store_ps(p, _mm_add_ps(_mm_load_ps(p), rows));
}

inline Vector add_halves(FloatVector v) noexcept {
  return _mm256_add_pd(_mm256_cvtps_pd(_mm256_castps256_ps128(v)), _mm256_cvtps_pd(_mm256_extractf128_ps(v, 1)));
}
inline void store_truncated(std::int32_t* out, Vector v) noexcept {
  _mm_store_si128(reinterpret_cast<__m128i*>(out), _mm256_cvttpd_epi32(v));
}
inline void store_wrapped(std::int32_t* out, Vector v) noexcept {
  _mm_store_si128(reinterpret_cast<__m128i*>(out), _mm256_cvtpd_epi32(v));
}

}  // namespace lanescape::kernels::LANESCAPE_ISA

#include "simd/sums_256.hpp"
#include "simd/without_avx512.hpp"
