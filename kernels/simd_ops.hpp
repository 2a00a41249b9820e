#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "isa.hpp"

// The vector operations the kernels are written in, and the only file that knows how each instruction set spells them.
// xsimd 8.1 supplies the types; where it lacks an operation, is inexact or emulates it, the intrinsic stands here:
// it has no AVX-512 fma, its masks cannot zero a result for free, and `^` and `!=` are wrong on some of its masks.

#if defined(LANESCAPE_ISA_AVX512) || defined(LANESCAPE_ISA_AVX2) || defined(LANESCAPE_ISA_SSE2)
#define LANESCAPE_X86 1
#include <immintrin.h>

#include <xsimd/xsimd.hpp>
#endif

namespace lanescape::kernels::LANESCAPE_ISA {

#if defined(LANESCAPE_X86)

#if defined(LANESCAPE_ISA_AVX512)
using Arch = xsimd::avx512dq;
#elif defined(LANESCAPE_ISA_AVX2)
using Arch = xsimd::fma3<xsimd::avx2>;
#else
using Arch = xsimd::sse2;
#endif
using Vector = xsimd::batch<double, Arch>;
using Mask = xsimd::batch_bool<double, Arch>;
inline constexpr std::size_t lanes = Vector::size;

inline Vector load(const double* p) noexcept { return Vector::load_aligned(p); }
inline Vector load_anywhere(const double* p) noexcept { return Vector::load_unaligned(p); }
inline void store(double* p, Vector v) noexcept { v.store_aligned(p); }
inline void store_anywhere(double* p, Vector v) noexcept { v.store_unaligned(p); }
inline Vector broadcast(double s) noexcept { return Vector(s); }
inline Vector absolute(Vector v) noexcept { return xsimd::abs(v); }
inline Vector maximum(Vector a, Vector b) noexcept { return xsimd::max(a, b); }
inline Vector minimum(Vector a, Vector b) noexcept { return xsimd::min(a, b); }
inline Mask less(Vector a, Vector b) noexcept { return a < b; }
inline Mask equal(Vector a, Vector b) noexcept { return a == b; }
inline Mask both(Mask a, Mask b) noexcept { return a & b; }
inline Mask either(Mask a, Mask b) noexcept { return a | b; }
inline bool any(Mask m) noexcept { return xsimd::any(m); }
inline Vector square_root(Vector v) noexcept { return xsimd::sqrt(v); }

#else  // the portable leg: four doubles that the compiler may or may not put into vector registers

inline constexpr std::size_t lanes = 4;
struct alignas(32) Vector {
  double lane[lanes];
};
struct Mask {
  bool lane[lanes];
};
template <class F>
inline Vector lanewise(F f) noexcept {
  Vector r;
  for (std::size_t k = 0; k < lanes; ++k) r.lane[k] = f(k);
  return r;
}
inline Vector operator+(Vector a, Vector b) noexcept {
  return lanewise([&](std::size_t k) { return a.lane[k] + b.lane[k]; });
}
inline Vector operator-(Vector a, Vector b) noexcept {
  return lanewise([&](std::size_t k) { return a.lane[k] - b.lane[k]; });
}
inline Vector operator*(Vector a, Vector b) noexcept {
  return lanewise([&](std::size_t k) { return a.lane[k] * b.lane[k]; });
}
inline Vector operator/(Vector a, Vector b) noexcept {
  return lanewise([&](std::size_t k) { return a.lane[k] / b.lane[k]; });
}
inline Vector& operator+=(Vector& a, Vector b) noexcept { return a = a + b; }
inline Vector load(const double* p) noexcept {
  return lanewise([&](std::size_t k) { return p[k]; });
}
inline Vector load_anywhere(const double* p) noexcept { return load(p); }
inline void store(double* p, Vector v) noexcept {
  for (std::size_t k = 0; k < lanes; ++k) p[k] = v.lane[k];
}
inline void store_anywhere(double* p, Vector v) noexcept { store(p, v); }
inline Vector broadcast(double s) noexcept {
  return lanewise([&](std::size_t) { return s; });
}
inline Vector absolute(Vector v) noexcept {
  return lanewise([&](std::size_t k) { return std::fabs(v.lane[k]); });
}
inline Vector maximum(Vector a, Vector b) noexcept {
  return lanewise([&](std::size_t k) { return a.lane[k] < b.lane[k] ? b.lane[k] : a.lane[k]; });
}
inline Vector minimum(Vector a, Vector b) noexcept {
  return lanewise([&](std::size_t k) { return b.lane[k] < a.lane[k] ? b.lane[k] : a.lane[k]; });
}
template <class F>
inline Mask lanewise_mask(F f) noexcept {
  Mask r;
  for (std::size_t k = 0; k < lanes; ++k) r.lane[k] = f(k);
  return r;
}
inline Mask less(Vector a, Vector b) noexcept {
  return lanewise_mask([&](std::size_t k) { return a.lane[k] < b.lane[k]; });
}
inline Mask equal(Vector a, Vector b) noexcept {
  return lanewise_mask([&](std::size_t k) { return a.lane[k] == b.lane[k]; });
}
inline Mask both(Mask a, Mask b) noexcept {
  return lanewise_mask([&](std::size_t k) { return a.lane[k] && b.lane[k]; });
}
inline Mask either(Mask a, Mask b) noexcept {
  return lanewise_mask([&](std::size_t k) { return a.lane[k] || b.lane[k]; });
}
inline bool any(Mask m) noexcept {
  bool r = false;
  for (std::size_t k = 0; k < lanes; ++k) r = r || m.lane[k];
  return r;
}
inline Vector square_root(Vector v) noexcept {
  return lanewise([&](std::size_t k) { return std::sqrt(v.lane[k]); });
}

#endif

// a b + c in one rounding where the instruction set has it; SSE2 and the portable leg round the product too.
inline Vector multiply_add(Vector a, Vector b, Vector c) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  return _mm512_fmadd_pd(a, b, c);
#elif defined(LANESCAPE_ISA_AVX2)
  return _mm256_fmadd_pd(a, b, c);
#else
  return a * b + c;
#endif
}

// c - a b, rounded like multiply_add.
inline Vector subtract_product(Vector c, Vector a, Vector b) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  return _mm512_fnmadd_pd(a, b, c);
#elif defined(LANESCAPE_ISA_AVX2)
  return _mm256_fnmadd_pd(a, b, c);
#else
  return c - a * b;
#endif
}

// v minus its nearest whole number, ties to even: the nearest image of a separation given in box lengths. |v| < 2^51.
inline Vector reduce_to_nearest(Vector v) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  return _mm512_reduce_pd(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
#elif defined(LANESCAPE_ISA_AVX2)
  return v - Vector(_mm256_round_pd(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
#elif defined(LANESCAPE_ISA_SSE2)
  // Adding 1.5 x 2^52 leaves no bits for a fraction, so that the sum is rounded to a whole number; SSE2 cannot round.
  const Vector shifter(6755399441055744.0);
  return v - ((v + shifter) - shifter);
#else
  return lanewise([&](std::size_t k) { return v.lane[k] - std::nearbyint(v.lane[k]); });
#endif
}

// 1/v where the mask is set, 0 elsewhere.
inline Vector masked_reciprocal(Mask m, Vector v) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  return _mm512_maskz_div_pd(m, _mm512_set1_pd(1.0), v);
#elif defined(LANESCAPE_ISA_AVX2)
  return _mm256_and_pd(m, _mm256_div_pd(_mm256_set1_pd(1.0), v));
#elif defined(LANESCAPE_ISA_SSE2)
  return _mm_and_pd(m, _mm_div_pd(_mm_set1_pd(1.0), v));
#else
  return lanewise([&](std::size_t k) { return m.lane[k] ? 1.0 / v.lane[k] : 0.0; });
#endif
}

// a where the mask is set, b elsewhere.
inline Vector select(Mask m, Vector a, Vector b) noexcept {
#if defined(LANESCAPE_X86)
  return xsimd::select(m, a, b);
#else
  return lanewise([&](std::size_t k) { return m.lane[k] ? a.lane[k] : b.lane[k]; });
#endif
}

// sum + 1 where the mask is set.
inline Vector masked_increment(Vector sum, Mask m) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  return _mm512_mask_add_pd(sum, m, sum, _mm512_set1_pd(1.0));
#elif defined(LANESCAPE_ISA_AVX2)
  return _mm256_add_pd(sum, _mm256_and_pd(m, _mm256_set1_pd(1.0)));
#elif defined(LANESCAPE_ISA_SSE2)
  return _mm_add_pd(sum, _mm_and_pd(m, _mm_set1_pd(1.0)));
#else
  return lanewise([&](std::size_t k) { return sum.lane[k] + (m.lane[k] ? 1.0 : 0.0); });
#endif
}

inline void prefetch(const void* p) noexcept { __builtin_prefetch(p); }
inline void prefetch_for_write(void* p) noexcept { __builtin_prefetch(p, 1); }

// Bit k of the result is lane k of the mask.
inline unsigned bits(Mask m) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  return _cvtmask8_u32(m);
#elif defined(LANESCAPE_ISA_AVX2)
  return static_cast<unsigned>(_mm256_movemask_pd(m));
#elif defined(LANESCAPE_ISA_SSE2)
  return static_cast<unsigned>(_mm_movemask_pd(m));
#else
  unsigned r = 0;
  for (std::size_t k = 0; k < lanes; ++k) r |= (m.lane[k] ? 1U : 0U) << k;
  return r;
#endif
}

// Writes first + lane for every lane whose bit is set, one after the other from p on; up to a whole vector is overwritten. Their
// number.
inline std::size_t compress_store_lanes(std::int32_t* p, unsigned mask, std::int32_t first) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  const __m256i numbers = _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm256_maskz_compress_epi32(static_cast<__mmask8>(mask), numbers));
  return static_cast<std::size_t>(__builtin_popcount(mask));
#else
  // Every lane is written; only those that count move the end on.
  std::size_t count = 0;
  for (std::size_t k = 0; k < lanes; ++k) {
    p[count] = first + static_cast<std::int32_t>(k);
    count += mask >> k & 1U;
  }
  return count;
#endif
}

// The nearest whole number, ties to even. |v| < 2^51.
inline Vector nearest_whole(Vector v) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  return _mm512_roundscale_pd(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
#elif defined(LANESCAPE_ISA_AVX2)
  return _mm256_round_pd(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
#elif defined(LANESCAPE_ISA_SSE2)
  const Vector shifter(6755399441055744.0);
  return (v + shifter) - shifter;
#else
  return lanewise([&](std::size_t k) { return std::nearbyint(v.lane[k]); });
#endif
}

// base[index[0]], base[index[1]], ... One by one: Zen 4's gather instruction is slower.
inline Vector gather(const double* base, const std::int32_t* index) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  return _mm512_set_pd(base[index[7]], base[index[6]], base[index[5]], base[index[4]], base[index[3]], base[index[2]],
                       base[index[1]], base[index[0]]);
#elif defined(LANESCAPE_ISA_AVX2)
  return _mm256_set_pd(base[index[3]], base[index[2]], base[index[1]], base[index[0]]);
#elif defined(LANESCAPE_ISA_SSE2)
  return _mm_set_pd(base[index[1]], base[index[0]]);
#else
  return lanewise([&](std::size_t k) { return base[index[k]]; });
#endif
}

// Eight fields of `lanes` records of eight doubles each, 64-byte aligned: field f of record index[k] goes to lane k of out[f].
inline void gather_records(const double* base, const std::int32_t* index, Vector* out) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
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
#elif defined(LANESCAPE_ISA_AVX2)
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
#elif defined(LANESCAPE_ISA_SSE2)
  const double *first = base + 8 * static_cast<std::ptrdiff_t>(index[0]),
               *second = base + 8 * static_cast<std::ptrdiff_t>(index[1]);
  for (int pair = 0; pair < 4; ++pair) {
    const __m128d a = _mm_load_pd(first + 2 * pair), b = _mm_load_pd(second + 2 * pair);
    out[2 * pair] = _mm_unpacklo_pd(a, b);
    out[2 * pair + 1] = _mm_unpackhi_pd(a, b);
  }
#else
  for (std::size_t f = 0; f < 8; ++f)
    out[f] =
        lanewise([&](std::size_t k) { return base[8 * static_cast<std::ptrdiff_t>(index[k]) + static_cast<std::ptrdiff_t>(f)]; });
#endif
}

// x, y and z of `lanes` points (records of four doubles, 32-byte aligned); that of lane k is place[k] doubles from `base`.
template <class Places>
inline void gather_points(const double* base, const Places& place, Vector& x, Vector& y, Vector& z) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  const auto two = [&](int k) {
    return _mm512_mask_broadcast_f64x4(_mm512_castpd256_pd512(_mm256_load_pd(base + place[k])), 0xf0,
                                       _mm256_load_pd(base + place[k + 2]));
  };
  const __m512d a = two(0), b = two(1), c = two(4), d = two(5);
  const __m512d xz_ab = _mm512_unpacklo_pd(a, b), xz_cd = _mm512_unpacklo_pd(c, d);
  x = _mm512_shuffle_f64x2(xz_ab, xz_cd, 0x88);
  y = _mm512_shuffle_f64x2(_mm512_unpackhi_pd(a, b), _mm512_unpackhi_pd(c, d), 0x88);
  z = _mm512_shuffle_f64x2(xz_ab, xz_cd, 0xdd);
#elif defined(LANESCAPE_ISA_AVX2)
  const auto one = [&](int k) { return _mm256_load_pd(base + place[k]); };
  const __m256d a = one(0), b = one(1), c = one(2), d = one(3);
  const __m256d xz_ab = _mm256_unpacklo_pd(a, b), xz_cd = _mm256_unpacklo_pd(c, d);
  x = _mm256_permute2f128_pd(xz_ab, xz_cd, 0x20);
  y = _mm256_permute2f128_pd(_mm256_unpackhi_pd(a, b), _mm256_unpackhi_pd(c, d), 0x20);
  z = _mm256_permute2f128_pd(xz_ab, xz_cd, 0x31);
#elif defined(LANESCAPE_ISA_SSE2)
  const double *first = base + place[0], *second = base + place[1];
  const __m128d a = _mm_load_pd(first), b = _mm_load_pd(second);
  x = _mm_unpacklo_pd(a, b);
  y = _mm_unpackhi_pd(a, b);
  z = _mm_loadh_pd(_mm_load_sd(first + 2), second + 2);
#else
  x = lanewise([&](std::size_t k) { return base[place[k]]; });
  y = lanewise([&](std::size_t k) { return base[place[k] + 1]; });
  z = lanewise([&](std::size_t k) { return base[place[k] + 2]; });
#endif
}

// All four numbers of such records.
template <class Places>
inline void gather_quads(const double* base, const Places& place, Vector& x, Vector& y, Vector& z, Vector& w) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  const auto two = [&](int k) {
    return _mm512_mask_broadcast_f64x4(_mm512_castpd256_pd512(_mm256_load_pd(base + place[k])), 0xf0,
                                       _mm256_load_pd(base + place[k + 2]));
  };
  const __m512d a = two(0), b = two(1), c = two(4), d = two(5);
  const __m512d xz_ab = _mm512_unpacklo_pd(a, b), xz_cd = _mm512_unpacklo_pd(c, d);
  const __m512d yw_ab = _mm512_unpackhi_pd(a, b), yw_cd = _mm512_unpackhi_pd(c, d);
  x = _mm512_shuffle_f64x2(xz_ab, xz_cd, 0x88);
  y = _mm512_shuffle_f64x2(yw_ab, yw_cd, 0x88);
  z = _mm512_shuffle_f64x2(xz_ab, xz_cd, 0xdd);
  w = _mm512_shuffle_f64x2(yw_ab, yw_cd, 0xdd);
#elif defined(LANESCAPE_ISA_AVX2)
  const auto one = [&](int k) { return _mm256_load_pd(base + place[k]); };
  const __m256d a = one(0), b = one(1), c = one(2), d = one(3);
  const __m256d xz_ab = _mm256_unpacklo_pd(a, b), xz_cd = _mm256_unpacklo_pd(c, d);
  const __m256d yw_ab = _mm256_unpackhi_pd(a, b), yw_cd = _mm256_unpackhi_pd(c, d);
  x = _mm256_permute2f128_pd(xz_ab, xz_cd, 0x20);
  y = _mm256_permute2f128_pd(yw_ab, yw_cd, 0x20);
  z = _mm256_permute2f128_pd(xz_ab, xz_cd, 0x31);
  w = _mm256_permute2f128_pd(yw_ab, yw_cd, 0x31);
#elif defined(LANESCAPE_ISA_SSE2)
  const double *first = base + place[0], *second = base + place[1];
  const __m128d a = _mm_load_pd(first), b = _mm_load_pd(second), c = _mm_load_pd(first + 2), d = _mm_load_pd(second + 2);
  x = _mm_unpacklo_pd(a, b);
  y = _mm_unpackhi_pd(a, b);
  z = _mm_unpacklo_pd(c, d);
  w = _mm_unpackhi_pd(c, d);
#else
  x = lanewise([&](std::size_t k) { return base[place[k]]; });
  y = lanewise([&](std::size_t k) { return base[place[k] + 1]; });
  z = lanewise([&](std::size_t k) { return base[place[k] + 2]; });
  w = lanewise([&](std::size_t k) { return base[place[k] + 3]; });
#endif
}

// Whole numbers that lanes are rounded to, one by one in memory: what takes them out of a vector register costs more.
struct WholeLanes {
  alignas(64) double shifted[lanes];
  std::uint32_t of(std::size_t lane) const noexcept {
    std::uint64_t bits;
    __builtin_memcpy(&bits, shifted + lane, sizeof bits);
    return static_cast<std::uint32_t>(bits);
  }
};

// The whole number nearest to each lane, ties to even. 0 <= v < 2^31.
inline Vector store_nearest_whole(WholeLanes& out, Vector v) noexcept {
  // 1.5 x 2^52 leaves no bits for a fraction: the lowest bits of the sum are the number.
  const Vector shifter = broadcast(6755399441055744.0), sum = v + shifter;
  store(out.shifted, sum);
  asm volatile("" : "+m"(out.shifted));
  return sum - shifter;
}

// The chosen lanes one after the other from p on; up to a whole vector is overwritten. Their number.
inline std::size_t compress_store(double* p, unsigned mask, Vector v) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  _mm512_storeu_pd(p, _mm512_maskz_compress_pd(static_cast<__mmask8>(mask), v));
  return static_cast<std::size_t>(__builtin_popcount(mask));
#else
  alignas(64) double lane[lanes];
  store(lane, v);
  std::size_t count = 0;
  for (std::size_t k = 0; k < lanes; ++k) {
    p[count] = lane[k];
    count += mask >> k & 1U;
  }
  return count;
#endif
}

// The same of numbers in memory, which may be those that are overwritten.
inline std::size_t compress_store(std::uint32_t* p, unsigned mask, const std::uint32_t* from) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  const __m256i chosen =
      _mm256_maskz_compress_epi32(static_cast<__mmask8>(mask), _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), chosen);
  return static_cast<std::size_t>(__builtin_popcount(mask));
#else
  std::size_t count = 0;
  for (std::size_t k = 0; k < lanes; ++k) {
    p[count] = from[k];
    count += mask >> k & 1U;
  }
  return count;
#endif
}

// Each lane without its fraction. |v| < 2^31.
inline void store_truncated(std::int32_t* out, Vector v) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  _mm256_store_si256(reinterpret_cast<__m256i*>(out), _mm512_cvttpd_epi32(v));
#elif defined(LANESCAPE_ISA_AVX2)
  _mm_store_si128(reinterpret_cast<__m128i*>(out), _mm256_cvttpd_epi32(v));
#elif defined(LANESCAPE_ISA_SSE2)
  _mm_storel_epi64(reinterpret_cast<__m128i*>(out), _mm_cvttpd_epi32(v));
#else
  for (std::size_t k = 0; k < lanes; ++k) out[k] = static_cast<std::int32_t>(v.lane[k]);
#endif
}

// first, first + 1, first + 2, ...
inline Vector count_from(double first) noexcept {
  alignas(64) static constexpr double whole[] = {0, 1, 2, 3, 4, 5, 6, 7};
  return load(whole) + broadcast(first);
}

inline double reduce_max(Vector v) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  return _mm512_reduce_max_pd(v);
#else
  alignas(64) double lane[lanes];
  store(lane, v);
  double greatest = lane[0];
  for (std::size_t k = 1; k < lanes; ++k) greatest = greatest < lane[k] ? lane[k] : greatest;
  return greatest;
#endif
}
// Taken from zero and not negated, so that zero stays +0.
inline double reduce_min(Vector v) noexcept { return 0.0 - reduce_max(broadcast(0.0) - v); }

// The magnitude of a with the sign of s.
inline Vector copy_sign(Vector a, Vector s) noexcept {
#if defined(LANESCAPE_X86)
  return xsimd::copysign(a, s);
#else
  return lanewise([&](std::size_t k) { return std::copysign(a.lane[k], s.lane[k]); });
#endif
}

// Set in the lanes below k; k beyond the ends means all or none.
inline Mask lanes_below(std::ptrdiff_t k) noexcept {
  const std::ptrdiff_t width = lanes;
  k = k < 0 ? 0 : k > width ? width : k;
#if defined(LANESCAPE_ISA_AVX512)
  return static_cast<__mmask8>(0xffU >> (8 - k));
#elif defined(LANESCAPE_X86)
  alignas(32) static constexpr std::int64_t bits[] = {-1, -1, -1, -1, 0, 0, 0, 0};
  const double* start = reinterpret_cast<const double*>(bits + 4 - k);
#if defined(LANESCAPE_ISA_AVX2)
  return _mm256_loadu_pd(start);
#else
  return _mm_loadu_pd(start);
#endif
#else
  return lanewise_mask([&](std::size_t lane) { return static_cast<std::ptrdiff_t>(lane) < k; });
#endif
}

// a without b.
inline Mask and_not(Mask a, Mask b) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  return _kandn_mask8(b, a);
#elif defined(LANESCAPE_ISA_AVX2)
  return _mm256_andnot_pd(b, a);
#elif defined(LANESCAPE_ISA_SSE2)
  return _mm_andnot_pd(b, a);
#else
  return lanewise_mask([&](std::size_t k) { return a.lane[k] && !b.lane[k]; });
#endif
}

// The sum of all lanes, always in the same order.
inline double reduce_add(Vector v) noexcept {
#if defined(LANESCAPE_X86)
  return xsimd::hadd(v);
#else
  return (v.lane[0] + v.lane[1]) + (v.lane[2] + v.lane[3]);
#endif
}

#if defined(LANESCAPE_ISA_AVX512)
inline __m256d fold_to_four(Vector v) noexcept { return _mm256_add_pd(_mm512_castpd512_pd256(v), _mm512_extractf64x4_pd(v, 1)); }
#elif defined(LANESCAPE_ISA_AVX2)
inline __m256d fold_to_four(Vector v) noexcept { return v; }
#endif

// Adds the lane sums of four vectors to four consecutive doubles, 32-byte aligned.
inline void reduce_add_four(double* out, Vector a, Vector b, Vector c, Vector d) noexcept {
#if defined(LANESCAPE_ISA_AVX512) || defined(LANESCAPE_ISA_AVX2)
  const __m256d ab = _mm256_hadd_pd(fold_to_four(a), fold_to_four(b));  // a01 b01 a23 b23
  const __m256d cd = _mm256_hadd_pd(fold_to_four(c), fold_to_four(d));
  const __m256d crossed = _mm256_permute2f128_pd(ab, cd, 0x21);  // a23 b23 c01 d01
  const __m256d straight = _mm256_blend_pd(ab, cd, 0b1100);      // a01 b01 c23 d23
  _mm256_store_pd(out, _mm256_add_pd(_mm256_load_pd(out), _mm256_add_pd(crossed, straight)));
#else
  out[0] += reduce_add(a);
  out[1] += reduce_add(b);
  out[2] += reduce_add(c);
  out[3] += reduce_add(d);
#endif
}

// The lane sums of three vectors and a zero to four consecutive doubles, 32-byte aligned.
inline void store_point(double* out, Vector x, Vector y, Vector z) noexcept {
#if defined(LANESCAPE_ISA_AVX512) || defined(LANESCAPE_ISA_AVX2)
  const __m256d xy = _mm256_hadd_pd(fold_to_four(x), fold_to_four(y));            // x01 y01 x23 y23
  const __m256d z0 = _mm256_hadd_pd(fold_to_four(z), _mm256_setzero_pd());        // z01 0 z23 0
  const __m256d crossed = _mm256_permute2f128_pd(xy, z0, 0x21);                   // x23 y23 z01 0
  _mm256_store_pd(out, _mm256_add_pd(crossed, _mm256_blend_pd(xy, z0, 0b1100)));  // x01 y01 z23 0
#else
  out[0] = reduce_add(x);
  out[1] = reduce_add(y);
  out[2] = reduce_add(z);
  out[3] = 0.0;
#endif
}

// Single precision. For filters whose verdicts are checked again in double: coordinates as 32-bit fractions of the box, whose
// differences wrap around as the box does. For forces in mixed precision: coordinates as 32-bit integers in a unit so small that
// they wrap around many times in the box, while the difference of two points in reach of one another does not.
#if defined(LANESCAPE_ISA_AVX512)

using FloatVector = __m512;
inline constexpr std::size_t float_lanes = 16;
inline FloatVector load(const float* p) noexcept { return _mm512_load_ps(p); }
inline FloatVector load_anywhere(const float* p) noexcept { return _mm512_loadu_ps(p); }
inline FloatVector subtract(FloatVector a, FloatVector b) noexcept { return _mm512_sub_ps(a, b); }
inline FloatVector broadcast_float(float s) noexcept { return _mm512_set1_ps(s); }
inline FloatVector multiply(FloatVector a, FloatVector b) noexcept { return _mm512_mul_ps(a, b); }
inline FloatVector add(FloatVector a, FloatVector b) noexcept { return _mm512_add_ps(a, b); }
inline FloatVector square_plus(FloatVector a, FloatVector c) noexcept { return _mm512_fmadd_ps(a, a, c); }
// p[k] - s in wrapping 32-bit arithmetic, as floating-point numbers.
inline FloatVector wrapped_difference(const std::int32_t* p, std::int32_t s) noexcept {
  return _mm512_cvtepi32_ps(_mm512_sub_epi32(_mm512_load_si512(p), _mm512_set1_epi32(s)));
}
inline std::uint32_t bits_less(FloatVector a, FloatVector b) noexcept { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
using FloatMask = __mmask16;
inline FloatMask less(FloatVector a, FloatVector b) noexcept { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
inline FloatMask both(FloatMask a, FloatMask b) noexcept { return _kand_mask16(a, b); }
inline FloatVector multiply_add(FloatVector a, FloatVector b, FloatVector c) noexcept { return _mm512_fmadd_ps(a, b, c); }
inline FloatVector masked_quotient(FloatMask m, FloatVector a, FloatVector b) noexcept { return _mm512_maskz_div_ps(m, a, b); }
inline FloatVector masked_increment(FloatVector sum, FloatMask m) noexcept {
  return _mm512_mask_add_ps(sum, m, sum, _mm512_set1_ps(1.0F));
}

#elif defined(LANESCAPE_ISA_AVX2)

using FloatVector = __m256;
inline constexpr std::size_t float_lanes = 8;
inline FloatVector load(const float* p) noexcept { return _mm256_load_ps(p); }
inline FloatVector load_anywhere(const float* p) noexcept { return _mm256_loadu_ps(p); }
inline FloatVector subtract(FloatVector a, FloatVector b) noexcept { return _mm256_sub_ps(a, b); }
inline FloatVector broadcast_float(float s) noexcept { return _mm256_set1_ps(s); }
inline FloatVector multiply(FloatVector a, FloatVector b) noexcept { return _mm256_mul_ps(a, b); }
inline FloatVector add(FloatVector a, FloatVector b) noexcept { return _mm256_add_ps(a, b); }
inline FloatVector square_plus(FloatVector a, FloatVector c) noexcept { return _mm256_fmadd_ps(a, a, c); }
inline FloatVector wrapped_difference(const std::int32_t* p, std::int32_t s) noexcept {
  return _mm256_cvtepi32_ps(_mm256_sub_epi32(_mm256_load_si256(reinterpret_cast<const __m256i*>(p)), _mm256_set1_epi32(s)));
}
inline std::uint32_t bits_less(FloatVector a, FloatVector b) noexcept {
  return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LT_OQ)));
}
struct FloatMask {
  __m256 lane;  // all bits or none
};
inline FloatMask less(FloatVector a, FloatVector b) noexcept { return {_mm256_cmp_ps(a, b, _CMP_LT_OQ)}; }
inline FloatMask both(FloatMask a, FloatMask b) noexcept { return {_mm256_and_ps(a.lane, b.lane)}; }
inline FloatVector multiply_add(FloatVector a, FloatVector b, FloatVector c) noexcept { return _mm256_fmadd_ps(a, b, c); }
inline FloatVector masked_quotient(FloatMask m, FloatVector a, FloatVector b) noexcept {
  return _mm256_and_ps(m.lane, _mm256_div_ps(a, b));
}
inline FloatVector masked_increment(FloatVector sum, FloatMask m) noexcept {
  return _mm256_add_ps(sum, _mm256_and_ps(m.lane, _mm256_set1_ps(1.0F)));
}

#elif defined(LANESCAPE_ISA_SSE2)

using FloatVector = __m128;
inline constexpr std::size_t float_lanes = 4;
inline FloatVector load(const float* p) noexcept { return _mm_load_ps(p); }
inline FloatVector load_anywhere(const float* p) noexcept { return _mm_loadu_ps(p); }
inline FloatVector subtract(FloatVector a, FloatVector b) noexcept { return _mm_sub_ps(a, b); }
inline FloatVector broadcast_float(float s) noexcept { return _mm_set1_ps(s); }
inline FloatVector multiply(FloatVector a, FloatVector b) noexcept { return _mm_mul_ps(a, b); }
inline FloatVector add(FloatVector a, FloatVector b) noexcept { return _mm_add_ps(a, b); }
inline FloatVector square_plus(FloatVector a, FloatVector c) noexcept { return _mm_add_ps(_mm_mul_ps(a, a), c); }
inline FloatVector wrapped_difference(const std::int32_t* p, std::int32_t s) noexcept {
  return _mm_cvtepi32_ps(_mm_sub_epi32(_mm_load_si128(reinterpret_cast<const __m128i*>(p)), _mm_set1_epi32(s)));
}
inline std::uint32_t bits_less(FloatVector a, FloatVector b) noexcept {
  return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmplt_ps(a, b)));
}
struct FloatMask {
  __m128 lane;  // all bits or none
};
inline FloatMask less(FloatVector a, FloatVector b) noexcept { return {_mm_cmplt_ps(a, b)}; }
inline FloatMask both(FloatMask a, FloatMask b) noexcept { return {_mm_and_ps(a.lane, b.lane)}; }
inline FloatVector multiply_add(FloatVector a, FloatVector b, FloatVector c) noexcept { return _mm_add_ps(_mm_mul_ps(a, b), c); }
inline FloatVector masked_quotient(FloatMask m, FloatVector a, FloatVector b) noexcept {
  return _mm_and_ps(m.lane, _mm_div_ps(a, b));
}
inline FloatVector masked_increment(FloatVector sum, FloatMask m) noexcept {
  return _mm_add_ps(sum, _mm_and_ps(m.lane, _mm_set1_ps(1.0F)));
}

#else

inline constexpr std::size_t float_lanes = 8;
struct alignas(32) FloatVector {
  float lane[float_lanes];
};
template <class F>
inline FloatVector float_lanewise(F f) noexcept {
  FloatVector r;
  for (std::size_t k = 0; k < float_lanes; ++k) r.lane[k] = f(k);
  return r;
}
inline FloatVector load(const float* p) noexcept {
  return float_lanewise([&](std::size_t k) { return p[k]; });
}
inline FloatVector load_anywhere(const float* p) noexcept { return load(p); }
inline FloatVector subtract(FloatVector a, FloatVector b) noexcept {
  return float_lanewise([&](std::size_t k) { return a.lane[k] - b.lane[k]; });
}
inline FloatVector broadcast_float(float s) noexcept {
  return float_lanewise([&](std::size_t) { return s; });
}
inline FloatVector multiply(FloatVector a, FloatVector b) noexcept {
  return float_lanewise([&](std::size_t k) { return a.lane[k] * b.lane[k]; });
}
inline FloatVector add(FloatVector a, FloatVector b) noexcept {
  return float_lanewise([&](std::size_t k) { return a.lane[k] + b.lane[k]; });
}
inline FloatVector square_plus(FloatVector a, FloatVector c) noexcept {
  return float_lanewise([&](std::size_t k) { return a.lane[k] * a.lane[k] + c.lane[k]; });
}
inline FloatVector wrapped_difference(const std::int32_t* p, std::int32_t s) noexcept {
  return float_lanewise([&](std::size_t k) {
    return static_cast<float>(static_cast<std::int32_t>(static_cast<std::uint32_t>(p[k]) - static_cast<std::uint32_t>(s)));
  });
}
inline std::uint32_t bits_less(FloatVector a, FloatVector b) noexcept {
  std::uint32_t r = 0;
  for (std::size_t k = 0; k < float_lanes; ++k) r |= (a.lane[k] < b.lane[k] ? 1U : 0U) << k;
  return r;
}
struct FloatMask {
  bool lane[float_lanes];
};
template <class F>
inline FloatMask float_lanewise_mask(F f) noexcept {
  FloatMask r;
  for (std::size_t k = 0; k < float_lanes; ++k) r.lane[k] = f(k);
  return r;
}
inline FloatMask less(FloatVector a, FloatVector b) noexcept {
  return float_lanewise_mask([&](std::size_t k) { return a.lane[k] < b.lane[k]; });
}
inline FloatMask both(FloatMask a, FloatMask b) noexcept {
  return float_lanewise_mask([&](std::size_t k) { return a.lane[k] && b.lane[k]; });
}
inline FloatVector multiply_add(FloatVector a, FloatVector b, FloatVector c) noexcept {
  return float_lanewise([&](std::size_t k) { return a.lane[k] * b.lane[k] + c.lane[k]; });
}
inline FloatVector masked_quotient(FloatMask m, FloatVector a, FloatVector b) noexcept {
  return float_lanewise([&](std::size_t k) { return m.lane[k] ? a.lane[k] / b.lane[k] : 0.0F; });
}
inline FloatVector masked_increment(FloatVector sum, FloatMask m) noexcept {
  return float_lanewise([&](std::size_t k) { return sum.lane[k] + (m.lane[k] ? 1.0F : 0.0F); });
}

#endif

#if defined(LANESCAPE_ISA_AVX2)
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
#endif

// Set in the lanes below k, all of them from float_lanes on.
inline FloatMask float_lanes_below(std::size_t k) noexcept {
  k = k < float_lanes ? k : float_lanes;
#if defined(LANESCAPE_ISA_AVX512)
  return static_cast<__mmask16>(0xffffU >> (16 - k));
#elif defined(LANESCAPE_X86)
  alignas(64) static constexpr std::int32_t bits[] = {-1, -1, -1, -1, -1, -1, -1, -1, 0, 0, 0, 0, 0, 0, 0, 0};
  const float* start = reinterpret_cast<const float*>(bits + 8 - k);
#if defined(LANESCAPE_ISA_AVX2)
  return {_mm256_loadu_ps(start)};
#else
  return {_mm_loadu_ps(start)};
#endif
#else
  return float_lanewise_mask([&](std::size_t lane) { return lane < k; });
#endif
}

// Both halves in double precision, added lane by lane.
inline Vector add_halves(FloatVector v) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  return _mm512_add_pd(_mm512_cvtps_pd(_mm512_castps512_ps256(v)), _mm512_cvtps_pd(_mm512_extractf32x8_ps(v, 1)));
#elif defined(LANESCAPE_ISA_AVX2)
  return _mm256_add_pd(_mm256_cvtps_pd(_mm256_castps256_ps128(v)), _mm256_cvtps_pd(_mm256_extractf128_ps(v, 1)));
#elif defined(LANESCAPE_ISA_SSE2)
  return _mm_add_pd(_mm_cvtps_pd(v), _mm_cvtps_pd(_mm_movehl_ps(v, v)));
#else
  return lanewise([&](std::size_t k) { return static_cast<double>(v.lane[k]) + static_cast<double>(v.lane[k + lanes]); });
#endif
}

// What x, y and z of `float_lanes` points (records of four integers, 16-byte aligned) differ by from those of `origin`, in wrapping
// 32-bit arithmetic, as floating-point numbers; the point of lane k is place[k] integers from `base`.
inline void gather_differences(const std::int32_t* base, const std::uint32_t* place, const std::int32_t* origin, FloatVector& x,
                               FloatVector& y, FloatVector& z) noexcept {
#if defined(LANESCAPE_X86)
  const auto one = [&](int k) { return _mm_load_si128(reinterpret_cast<const __m128i*>(base + place[k])); };
#endif
#if defined(LANESCAPE_ISA_AVX512)
  // Eight at a time: what puts 128 bits into a wider register is cheaper in the narrower one.
  struct Eight {
    __m256i x, y, z;
  };
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
#elif defined(LANESCAPE_ISA_AVX2)
  const auto column = [&](int k) { return _mm256_inserti128_si256(_mm256_castsi128_si256(one(k)), one(k + 4), 1); };
  const __m256i a = column(0), b = column(1), c = column(2), d = column(3);
  const __m256i xy_ab = _mm256_unpacklo_epi32(a, b), xy_cd = _mm256_unpacklo_epi32(c, d);
  const __m256i z_ab = _mm256_unpackhi_epi32(a, b), z_cd = _mm256_unpackhi_epi32(c, d);
  const auto from = [&](__m256i v, int axis) { return _mm256_cvtepi32_ps(_mm256_sub_epi32(v, _mm256_set1_epi32(origin[axis]))); };
  x = from(_mm256_unpacklo_epi64(xy_ab, xy_cd), 0);
  y = from(_mm256_unpackhi_epi64(xy_ab, xy_cd), 1);
  z = from(_mm256_unpacklo_epi64(z_ab, z_cd), 2);
#elif defined(LANESCAPE_ISA_SSE2)
  const __m128i a = one(0), b = one(1), c = one(2), d = one(3);
  const __m128i xy_ab = _mm_unpacklo_epi32(a, b), xy_cd = _mm_unpacklo_epi32(c, d);
  const __m128i z_ab = _mm_unpackhi_epi32(a, b), z_cd = _mm_unpackhi_epi32(c, d);
  const auto from = [&](__m128i v, int axis) { return _mm_cvtepi32_ps(_mm_sub_epi32(v, _mm_set1_epi32(origin[axis]))); };
  x = from(_mm_unpacklo_epi64(xy_ab, xy_cd), 0);
  y = from(_mm_unpackhi_epi64(xy_ab, xy_cd), 1);
  z = from(_mm_unpacklo_epi64(z_ab, z_cd), 2);
#else
  const auto from = [&](std::size_t axis) {
    return float_lanewise([&](std::size_t k) {
      return static_cast<float>(
          static_cast<std::int32_t>(static_cast<std::uint32_t>(base[place[k] + axis]) - static_cast<std::uint32_t>(origin[axis])));
    });
  };
  x = from(0);
  y = from(1);
  z = from(2);
#endif
}

// Writes 4 (first + lane) for every lane of single precision whose bit is set, one after the other from p on; up to a whole vector
// is overwritten. Their number.
inline std::size_t compress_store_offsets(std::uint32_t* p, std::uint32_t mask, std::uint32_t first) noexcept {
#if defined(LANESCAPE_ISA_AVX512)
  const __m512i places = _mm512_add_epi32(_mm512_set1_epi32(static_cast<std::int32_t>(4 * first)),
                                          _mm512_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28, 32, 36, 40, 44, 48, 52, 56, 60));
  _mm512_storeu_si512(p, _mm512_maskz_compress_epi32(static_cast<__mmask16>(mask), places));
  return static_cast<std::size_t>(__builtin_popcount(mask));
#elif defined(LANESCAPE_ISA_AVX2)
  const __m256i lanes_first = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(set_lanes.of[mask & 0xffU])));
  const __m256i places = _mm256_slli_epi32(_mm256_add_epi32(_mm256_set1_epi32(static_cast<std::int32_t>(first)), lanes_first), 2);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), places);
  return static_cast<std::size_t>(__builtin_popcount(mask));
#else
  std::size_t count = 0;
  for (std::size_t k = 0; k < float_lanes; ++k) {
    p[count] = 4 * (first + static_cast<std::uint32_t>(k));
    count += mask >> k & 1U;
  }
  return count;
#endif
}

// Whole boxes left out, what is left of a coordinate in box lengths as a 32-bit fraction; one half wraps to minus one half.
inline void store_fractions(std::int32_t* out, Vector box_lengths) noexcept {
  const Vector scaled = reduce_to_nearest(box_lengths) * broadcast(4294967296.0);
#if defined(LANESCAPE_ISA_AVX512)
  _mm256_store_si256(reinterpret_cast<__m256i*>(out), _mm512_cvtpd_epi32(scaled));
#elif defined(LANESCAPE_ISA_AVX2)
  _mm_store_si128(reinterpret_cast<__m128i*>(out), _mm256_cvtpd_epi32(scaled));
#elif defined(LANESCAPE_ISA_SSE2)
  _mm_storel_epi64(reinterpret_cast<__m128i*>(out), _mm_cvtpd_epi32(scaled));
#else
  for (std::size_t k = 0; k < lanes; ++k)
    out[k] = static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::int64_t>(std::nearbyint(scaled.lane[k]))));
#endif
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
