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
inline void store(double* p, Vector v) noexcept { v.store_aligned(p); }
inline Vector broadcast(double s) noexcept { return Vector(s); }
inline Vector absolute(Vector v) noexcept { return xsimd::abs(v); }
inline Vector maximum(Vector a, Vector b) noexcept { return xsimd::max(a, b); }
inline Vector minimum(Vector a, Vector b) noexcept { return xsimd::min(a, b); }
inline Mask less(Vector a, Vector b) noexcept { return a < b; }
inline Mask both(Mask a, Mask b) noexcept { return a & b; }
inline bool any(Mask m) noexcept { return xsimd::any(m); }

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
inline void store(double* p, Vector v) noexcept {
  for (std::size_t k = 0; k < lanes; ++k) p[k] = v.lane[k];
}
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
inline Mask both(Mask a, Mask b) noexcept {
  return lanewise_mask([&](std::size_t k) { return a.lane[k] && b.lane[k]; });
}
inline bool any(Mask m) noexcept {
  bool r = false;
  for (std::size_t k = 0; k < lanes; ++k) r = r || m.lane[k];
  return r;
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
inline Vector choose(Mask m, Vector a, Vector b) noexcept {
#if defined(LANESCAPE_X86)
  return xsimd::select(m, a, b);
#else
  return lanewise([&](std::size_t k) { return m.lane[k] ? a.lane[k] : b.lane[k]; });
#endif
}

// sum + 1 where the mask is set.
inline Vector count_up(Vector sum, Mask m) noexcept {
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

// The magnitude of a with the sign of s.
inline Vector with_sign_of(Vector a, Vector s) noexcept {
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
inline Mask excluding(Mask a, Mask b) noexcept {
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
inline double sum_lanes(Vector v) noexcept {
#if defined(LANESCAPE_X86)
  return xsimd::hadd(v);
#else
  return (v.lane[0] + v.lane[1]) + (v.lane[2] + v.lane[3]);
#endif
}

// Adds the lane sums of four vectors to four consecutive doubles, 32-byte aligned.
inline void add_lane_sums(double* out, Vector a, Vector b, Vector c, Vector d) noexcept {
#if defined(LANESCAPE_ISA_AVX512) || defined(LANESCAPE_ISA_AVX2)
#if defined(LANESCAPE_ISA_AVX512)
  const auto fold = [](Vector v) { return _mm256_add_pd(_mm512_castpd512_pd256(v), _mm512_extractf64x4_pd(v, 1)); };
#else
  const auto fold = [](Vector v) -> __m256d { return v; };
#endif
  const __m256d ab = _mm256_hadd_pd(fold(a), fold(b));  // a01 b01 a23 b23
  const __m256d cd = _mm256_hadd_pd(fold(c), fold(d));
  const __m256d crossed = _mm256_permute2f128_pd(ab, cd, 0x21);  // a23 b23 c01 d01
  const __m256d straight = _mm256_blend_pd(ab, cd, 0b1100);      // a01 b01 c23 d23
  _mm256_store_pd(out, _mm256_add_pd(_mm256_load_pd(out), _mm256_add_pd(crossed, straight)));
#else
  out[0] += sum_lanes(a);
  out[1] += sum_lanes(b);
  out[2] += sum_lanes(c);
  out[3] += sum_lanes(d);
#endif
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
