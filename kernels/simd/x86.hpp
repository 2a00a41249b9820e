#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <xsimd/xsimd.hpp>

#include "simd/traits.hpp"

// What xsimd spells in the same way on every x86 instruction set. The header of an instruction set defines `Architecture` first.
namespace lanescape::kernels::LANESCAPE_ISA {

using Vector = xsimd::batch<double, Architecture>;
using Mask = xsimd::batch_bool<double, Architecture>;
using FloatVector = xsimd::batch<float, Architecture>;
using FloatMask = xsimd::batch_bool<float, Architecture>;

inline Vector load(const double* p) noexcept { return Vector::load_aligned(p); }
inline Vector load_unaligned(const double* p) noexcept { return Vector::load_unaligned(p); }
inline void store(double* p, Vector v) noexcept { v.store_aligned(p); }
inline void store_unaligned(double* p, Vector v) noexcept { v.store_unaligned(p); }
inline Vector absolute(Vector v) noexcept { return xsimd::abs(v); }
inline Vector maximum(Vector a, Vector b) noexcept { return xsimd::max(a, b); }
inline Vector minimum(Vector a, Vector b) noexcept { return xsimd::min(a, b); }
inline Vector square_root(Vector v) noexcept { return xsimd::sqrt(v); }
inline Vector copy_sign(Vector a, Vector s) noexcept { return xsimd::copysign(a, s); }
inline Mask less(Vector a, Vector b) noexcept { return a < b; }
inline Mask equal(Vector a, Vector b) noexcept { return a == b; }
inline Mask both(Mask a, Mask b) noexcept { return a & b; }
inline Mask either(Mask a, Mask b) noexcept { return a | b; }
inline bool any(Mask m) noexcept { return xsimd::any(m); }
inline Vector select(Mask m, Vector a, Vector b) noexcept { return xsimd::select(m, a, b); }
inline double reduce_add(Vector v) noexcept { return xsimd::hadd(v); }

inline FloatVector load(const float* p) noexcept { return FloatVector::load_aligned(p); }
inline FloatVector load_unaligned(const float* p) noexcept { return FloatVector::load_unaligned(p); }
inline void store(float* p, FloatVector v) noexcept { v.store_aligned(p); }
inline void store_unaligned(float* p, FloatVector v) noexcept { v.store_unaligned(p); }
inline FloatVector absolute(FloatVector v) noexcept { return xsimd::abs(v); }
inline FloatVector maximum(FloatVector a, FloatVector b) noexcept { return xsimd::max(a, b); }
inline FloatVector minimum(FloatVector a, FloatVector b) noexcept { return xsimd::min(a, b); }
inline FloatVector square_root(FloatVector v) noexcept { return xsimd::sqrt(v); }
inline FloatVector copy_sign(FloatVector a, FloatVector s) noexcept { return xsimd::copysign(a, s); }
inline FloatMask less(FloatVector a, FloatVector b) noexcept { return a < b; }
inline FloatMask equal(FloatVector a, FloatVector b) noexcept { return a == b; }
inline FloatMask both(FloatMask a, FloatMask b) noexcept { return a & b; }
inline FloatMask either(FloatMask a, FloatMask b) noexcept { return a | b; }
inline bool any(FloatMask m) noexcept { return xsimd::any(m); }
inline FloatVector select(FloatMask m, FloatVector a, FloatVector b) noexcept { return xsimd::select(m, a, b); }

// The same number in every lane.
template <class V>
inline V broadcast(ScalarOf<V> s) noexcept {
  return V(s);
}

// Set in the first k lanes, k <= lanes_of<V>, where masks are vectors: ones followed by zeros, loaded from k before the zeros on.
template <class V>
inline MaskOf<V> load_first_lanes(std::size_t k) noexcept {
  using Bits = std::conditional_t<sizeof(ScalarOf<V>) == 8, std::int64_t, std::int32_t>;
  alignas(64) static constexpr Bits bits[16] = {-1, -1, -1, -1, -1, -1, -1, -1, 0, 0, 0, 0, 0, 0, 0, 0};
  return typename MaskOf<V>::register_type(V::load_unaligned(reinterpret_cast<const ScalarOf<V>*>(bits + 8 - k)));
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
