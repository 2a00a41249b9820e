#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "isa.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
using Architecture = xsimd::sse2;
}
#include "simd/x86.hpp"

// SSE2: two doubles or four floats; a mask is a vector of all bits or none. There is no fused multiply-add and no rounding.
namespace lanescape::kernels::LANESCAPE_ISA {

// Added to a number, 1.5 x 2^52 (2^23) leaves no bits for its fraction: the sum is rounded to a whole number, and its lowest bits
// are that number.
inline constexpr double shifter = 6755399441055744.0;
inline constexpr float float_shifter = 12582912.0F;

inline Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return a * b + c; }
inline Vector subtract_product(Vector c, Vector a, Vector b) noexcept { return c - a * b; }
inline Vector nearest_whole(Vector v) noexcept { return (v + Vector(shifter)) - Vector(shifter); }
inline Vector reduce_to_nearest(Vector v) noexcept { return v - nearest_whole(v); }
inline Vector masked_quotient(Mask m, Vector a, Vector b) noexcept { return _mm_and_pd(m, _mm_div_pd(a, b)); }
inline Vector masked_increment(Vector sum, Mask m) noexcept { return _mm_add_pd(sum, _mm_and_pd(m, _mm_set1_pd(1.0))); }
inline Mask and_not(Mask a, Mask b) noexcept { return _mm_andnot_pd(b, a); }
inline unsigned bits(Mask m) noexcept { return static_cast<unsigned>(_mm_movemask_pd(m)); }
inline Vector power_of_two(Vector n) noexcept {
  return _mm_castsi128_pd(_mm_slli_epi64(_mm_castpd_si128(n + Vector(shifter + 1023.0)), 52));
}

inline FloatVector multiply_add(FloatVector a, FloatVector b, FloatVector c) noexcept { return a * b + c; }
inline FloatVector subtract_product(FloatVector c, FloatVector a, FloatVector b) noexcept { return c - a * b; }
inline FloatVector nearest_whole(FloatVector v) noexcept { return (v + FloatVector(float_shifter)) - FloatVector(float_shifter); }
inline FloatVector masked_quotient(FloatMask m, FloatVector a, FloatVector b) noexcept { return _mm_and_ps(m, _mm_div_ps(a, b)); }
inline FloatVector masked_increment(FloatVector sum, FloatMask m) noexcept {
  return _mm_add_ps(sum, _mm_and_ps(m, _mm_set1_ps(1.0F)));
}
inline FloatMask and_not(FloatMask a, FloatMask b) noexcept { return _mm_andnot_ps(b, a); }
inline unsigned bits(FloatMask m) noexcept { return static_cast<unsigned>(_mm_movemask_ps(m)); }
inline FloatVector power_of_two(FloatVector n) noexcept {
  return _mm_castsi128_ps(_mm_slli_epi32(_mm_castps_si128(n + FloatVector(float_shifter + 127.0F)), 23));
}

template <class V>
inline MaskOf<V> first_lanes(std::size_t k) noexcept {
  return load_first_lanes<V>(k);
}

inline Vector gather(const double* base, const std::int32_t* index) noexcept { return _mm_set_pd(base[index[1]], base[index[0]]); }

inline void gather_records(const double* base, const std::int32_t* index, Vector* out) noexcept {
  const double *first = base + 8 * static_cast<std::ptrdiff_t>(index[0]),
               *second = base + 8 * static_cast<std::ptrdiff_t>(index[1]);
  for (int pair = 0; pair < 4; ++pair) {
    const __m128d a = _mm_load_pd(first + 2 * pair), b = _mm_load_pd(second + 2 * pair);
    out[2 * pair] = _mm_unpacklo_pd(a, b);
    out[2 * pair + 1] = _mm_unpackhi_pd(a, b);
  }
}

template <class Offsets>
inline void gather_points(const double* base, const Offsets& offset, Vector& x, Vector& y, Vector& z) noexcept {
  const double *first = base + offset[0], *second = base + offset[1];
  const __m128d a = _mm_load_pd(first), b = _mm_load_pd(second);
  x = _mm_unpacklo_pd(a, b);
  y = _mm_unpackhi_pd(a, b);
  z = _mm_loadh_pd(_mm_load_sd(first + 2), second + 2);
}

template <class Offsets>
inline void gather_quads(const double* base, const Offsets& offset, Vector& x, Vector& y, Vector& z, Vector& w) noexcept {
  const double *first = base + offset[0], *second = base + offset[1];
  const __m128d a = _mm_load_pd(first), b = _mm_load_pd(second), c = _mm_load_pd(first + 2), d = _mm_load_pd(second + 2);
  x = _mm_unpacklo_pd(a, b);
  y = _mm_unpackhi_pd(a, b);
  z = _mm_unpacklo_pd(c, d);
  w = _mm_unpackhi_pd(c, d);
}

inline FloatVector wrapped_difference(const std::int32_t* p, std::int32_t s) noexcept {
  return _mm_cvtepi32_ps(_mm_sub_epi32(_mm_load_si128(reinterpret_cast<const __m128i*>(p)), _mm_set1_epi32(s)));
}

inline void gather_differences(const std::int32_t* base, const std::uint32_t* offset, const std::int32_t* origin, FloatVector& x,
                               FloatVector& y, FloatVector& z) noexcept {
  const auto one = [&](int k) { return _mm_load_si128(reinterpret_cast<const __m128i*>(base + offset[k])); };
  const __m128i a = one(0), b = one(1), c = one(2), d = one(3);
  const __m128i xy_ab = _mm_unpacklo_epi32(a, b), xy_cd = _mm_unpacklo_epi32(c, d);
  const __m128i z_ab = _mm_unpackhi_epi32(a, b), z_cd = _mm_unpackhi_epi32(c, d);
  const auto from = [&](__m128i v, int axis) { return _mm_cvtepi32_ps(_mm_sub_epi32(v, _mm_set1_epi32(origin[axis]))); };
  x = from(_mm_unpacklo_epi64(xy_ab, xy_cd), 0);
  y = from(_mm_unpackhi_epi64(xy_ab, xy_cd), 1);
  z = from(_mm_unpacklo_epi64(z_ab, z_cd), 2);
}

using FixedVector = __m128i;
inline FixedVector load_cluster(const std::int32_t* p) noexcept { return _mm_load_si128(reinterpret_cast<const __m128i*>(p)); }
inline FixedVector load_rows(const std::int32_t* p) noexcept { return _mm_set1_epi32(*p); }
inline FloatVector wrapped_difference(FixedVector a, FixedVector b) noexcept { return _mm_cvtepi32_ps(_mm_sub_epi32(a, b)); }
inline void subtract_from_cluster(float* p, FloatVector v) noexcept { _mm_store_ps(p, _mm_sub_ps(_mm_load_ps(p), v)); }
inline void add_to_rows(float* p, const FloatVector* v) noexcept {
  __m128 a = v[0], b = v[1], c = v[2], d = v[3];
  _MM_TRANSPOSE4_PS(a, b, c, d);
  _mm_store_ps(p, _mm_add_ps(_mm_load_ps(p), _mm_add_ps(_mm_add_ps(a, b), _mm_add_ps(c, d))));
}

inline Vector add_halves(FloatVector v) noexcept { return _mm_add_pd(_mm_cvtps_pd(v), _mm_cvtps_pd(_mm_movehl_ps(v, v))); }
inline void store_truncated(std::int32_t* out, Vector v) noexcept {
  _mm_storel_epi64(reinterpret_cast<__m128i*>(out), _mm_cvttpd_epi32(v));
}
inline void store_wrapped(std::int32_t* out, Vector v) noexcept {
  _mm_storel_epi64(reinterpret_cast<__m128i*>(out), _mm_cvtpd_epi32(v));
}

}  // namespace lanescape::kernels::LANESCAPE_ISA

#include "simd/by_lane.hpp"
