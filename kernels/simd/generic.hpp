#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "simd/traits.hpp"

// The portable instruction set: four doubles or eight floats that the compiler may or may not put into vector registers.
namespace lanescape::kernels::LANESCAPE_ISA {

template <std::size_t lane_count>
struct MaskLanes {
  bool lane[lane_count];
};
template <class T, std::size_t lane_count>
struct alignas(32) VectorLanes {
  using value_type = T;
  using batch_bool_type = MaskLanes<lane_count>;
  static constexpr std::size_t size = lane_count;
  T lane[lane_count];
};
using Vector = VectorLanes<double, 4>;
using FloatVector = VectorLanes<float, 8>;
using Mask = MaskOf<Vector>;
using FloatMask = MaskOf<FloatVector>;

// What f(k) gives in lane k.
template <class V, class F>
inline V lanewise(F f) noexcept {
  V r;
  for (std::size_t k = 0; k < sizeof r.lane / sizeof r.lane[0]; ++k) r.lane[k] = f(k);
  return r;
}

// Operations on vectors of either kind, and on their masks.
template <class T, std::size_t n>
inline VectorLanes<T, n> operator+(VectorLanes<T, n> a, VectorLanes<T, n> b) noexcept {
  return lanewise<VectorLanes<T, n>>([&](std::size_t k) { return a.lane[k] + b.lane[k]; });
}
template <class T, std::size_t n>
inline VectorLanes<T, n> operator-(VectorLanes<T, n> a, VectorLanes<T, n> b) noexcept {
  return lanewise<VectorLanes<T, n>>([&](std::size_t k) { return a.lane[k] - b.lane[k]; });
}
template <class T, std::size_t n>
inline VectorLanes<T, n> operator*(VectorLanes<T, n> a, VectorLanes<T, n> b) noexcept {
  return lanewise<VectorLanes<T, n>>([&](std::size_t k) { return a.lane[k] * b.lane[k]; });
}
template <class T, std::size_t n>
inline VectorLanes<T, n> operator/(VectorLanes<T, n> a, VectorLanes<T, n> b) noexcept {
  return lanewise<VectorLanes<T, n>>([&](std::size_t k) { return a.lane[k] / b.lane[k]; });
}
template <class T, std::size_t n>
inline VectorLanes<T, n>& operator+=(VectorLanes<T, n>& a, VectorLanes<T, n> b) noexcept {
  return a = a + b;
}
template <class T, std::size_t n>
inline VectorLanes<T, n> absolute(VectorLanes<T, n> v) noexcept {
  return lanewise<VectorLanes<T, n>>([&](std::size_t k) { return std::fabs(v.lane[k]); });
}
template <class T, std::size_t n>
inline VectorLanes<T, n> maximum(VectorLanes<T, n> a, VectorLanes<T, n> b) noexcept {
  return lanewise<VectorLanes<T, n>>([&](std::size_t k) { return a.lane[k] > b.lane[k] ? a.lane[k] : b.lane[k]; });
}
template <class T, std::size_t n>
inline VectorLanes<T, n> minimum(VectorLanes<T, n> a, VectorLanes<T, n> b) noexcept {
  return lanewise<VectorLanes<T, n>>([&](std::size_t k) { return a.lane[k] < b.lane[k] ? a.lane[k] : b.lane[k]; });
}
template <class T, std::size_t n>
inline VectorLanes<T, n> square_root(VectorLanes<T, n> v) noexcept {
  return lanewise<VectorLanes<T, n>>([&](std::size_t k) { return std::sqrt(v.lane[k]); });
}
template <class T, std::size_t n>
inline VectorLanes<T, n> copy_sign(VectorLanes<T, n> a, VectorLanes<T, n> s) noexcept {
  return lanewise<VectorLanes<T, n>>([&](std::size_t k) { return std::copysign(a.lane[k], s.lane[k]); });
}
template <class T, std::size_t n>
inline VectorLanes<T, n> nearest_whole(VectorLanes<T, n> v) noexcept {
  return lanewise<VectorLanes<T, n>>([&](std::size_t k) { return std::nearbyint(v.lane[k]); });
}
template <class T, std::size_t n>
inline VectorLanes<T, n> multiply_add(VectorLanes<T, n> a, VectorLanes<T, n> b, VectorLanes<T, n> c) noexcept {
  return a * b + c;
}
template <class T, std::size_t n>
inline VectorLanes<T, n> subtract_product(VectorLanes<T, n> c, VectorLanes<T, n> a, VectorLanes<T, n> b) noexcept {
  return c - a * b;
}
template <class T, std::size_t n>
inline MaskLanes<n> less(VectorLanes<T, n> a, VectorLanes<T, n> b) noexcept {
  return lanewise<MaskLanes<n>>([&](std::size_t k) { return a.lane[k] < b.lane[k]; });
}
template <class T, std::size_t n>
inline MaskLanes<n> equal(VectorLanes<T, n> a, VectorLanes<T, n> b) noexcept {
  return lanewise<MaskLanes<n>>([&](std::size_t k) { return a.lane[k] == b.lane[k]; });
}
template <std::size_t n>
inline MaskLanes<n> both(MaskLanes<n> a, MaskLanes<n> b) noexcept {
  return lanewise<MaskLanes<n>>([&](std::size_t k) { return a.lane[k] && b.lane[k]; });
}
template <std::size_t n>
inline MaskLanes<n> either(MaskLanes<n> a, MaskLanes<n> b) noexcept {
  return lanewise<MaskLanes<n>>([&](std::size_t k) { return a.lane[k] || b.lane[k]; });
}
template <std::size_t n>
inline MaskLanes<n> and_not(MaskLanes<n> a, MaskLanes<n> b) noexcept {
  return lanewise<MaskLanes<n>>([&](std::size_t k) { return a.lane[k] && !b.lane[k]; });
}
template <std::size_t n>
inline unsigned bits(MaskLanes<n> m) noexcept {
  unsigned r = 0;
  for (std::size_t k = 0; k < n; ++k) r |= (m.lane[k] ? 1U : 0U) << k;
  return r;
}
template <std::size_t n>
inline bool any(MaskLanes<n> m) noexcept {
  return bits(m) != 0;
}
template <class T, std::size_t n>
inline VectorLanes<T, n> select(MaskLanes<n> m, VectorLanes<T, n> a, VectorLanes<T, n> b) noexcept {
  return lanewise<VectorLanes<T, n>>([&](std::size_t k) { return m.lane[k] ? a.lane[k] : b.lane[k]; });
}
template <class T, std::size_t n>
inline VectorLanes<T, n> masked_quotient(MaskLanes<n> m, VectorLanes<T, n> a, VectorLanes<T, n> b) noexcept {
  return lanewise<VectorLanes<T, n>>([&](std::size_t k) { return m.lane[k] ? a.lane[k] / b.lane[k] : T(0); });
}
template <class T, std::size_t n>
inline VectorLanes<T, n> masked_increment(VectorLanes<T, n> sum, MaskLanes<n> m) noexcept {
  return lanewise<VectorLanes<T, n>>([&](std::size_t k) { return sum.lane[k] + (m.lane[k] ? T(1) : T(0)); });
}
template <class V>
inline V broadcast(ScalarOf<V> s) noexcept {
  return lanewise<V>([&](std::size_t) { return s; });
}
template <class V>
inline MaskOf<V> first_lanes(std::size_t k) noexcept {
  return lanewise<MaskOf<V>>([&](std::size_t lane) { return lane < k; });
}

inline Vector load(const double* p) noexcept {
  return lanewise<Vector>([&](std::size_t k) { return p[k]; });
}
inline FloatVector load(const float* p) noexcept {
  return lanewise<FloatVector>([&](std::size_t k) { return p[k]; });
}
inline Vector load_unaligned(const double* p) noexcept { return load(p); }
inline FloatVector load_unaligned(const float* p) noexcept { return load(p); }
template <class T, std::size_t n>
inline void store(T* p, VectorLanes<T, n> v) noexcept {
  for (std::size_t k = 0; k < n; ++k) p[k] = v.lane[k];
}
template <class T, std::size_t n>
inline void store_unaligned(T* p, VectorLanes<T, n> v) noexcept {
  store(p, v);
}

inline Vector reduce_to_nearest(Vector v) noexcept { return v - nearest_whole(v); }
inline double reduce_add(Vector v) noexcept { return (v.lane[0] + v.lane[1]) + (v.lane[2] + v.lane[3]); }

// The number is the exponent: nothing else of a double's (a float's) bits is set.
inline Vector power_of_two(Vector n) noexcept {
  return lanewise<Vector>([&](std::size_t k) {
    return __builtin_bit_cast(double, static_cast<std::uint64_t>(static_cast<std::int64_t>(n.lane[k] + 1023.0)) << 52);
  });
}
inline FloatVector power_of_two(FloatVector n) noexcept {
  return lanewise<FloatVector>([&](std::size_t k) {
    return __builtin_bit_cast(float, static_cast<std::uint32_t>(static_cast<std::int32_t>(n.lane[k] + 127.0F)) << 23);
  });
}

inline Vector gather(const double* base, const std::int32_t* index) noexcept {
  return lanewise<Vector>([&](std::size_t k) { return base[index[k]]; });
}

inline void gather_records(const double* base, const std::int32_t* index, Vector* out) noexcept {
  for (int field = 0; field < 8; ++field)
    out[field] = lanewise<Vector>([&](std::size_t k) { return base[8 * static_cast<std::ptrdiff_t>(index[k]) + field]; });
}

template <class Offsets>
inline void gather_points(const double* base, const Offsets& offset, Vector& x, Vector& y, Vector& z) noexcept {
  x = lanewise<Vector>([&](std::size_t k) { return base[offset[k]]; });
  y = lanewise<Vector>([&](std::size_t k) { return base[offset[k] + 1]; });
  z = lanewise<Vector>([&](std::size_t k) { return base[offset[k] + 2]; });
}

template <class Offsets>
inline void gather_quads(const double* base, const Offsets& offset, Vector& x, Vector& y, Vector& z, Vector& w) noexcept {
  gather_points(base, offset, x, y, z);
  w = lanewise<Vector>([&](std::size_t k) { return base[offset[k] + 3]; });
}

// Unsigned arithmetic wraps around; what is signed must not.
inline float wrapped_difference(std::int32_t a, std::int32_t b) noexcept {
  return static_cast<float>(static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b)));
}
inline FloatVector wrapped_difference(const std::int32_t* p, std::int32_t s) noexcept {
  return lanewise<FloatVector>([&](std::size_t k) { return wrapped_difference(p[k], s); });
}

inline void gather_differences(const std::int32_t* base, const std::uint32_t* offset, const std::int32_t* origin, FloatVector& x,
                               FloatVector& y, FloatVector& z) noexcept {
  const auto from = [&](std::size_t axis) {
    return lanewise<FloatVector>([&](std::size_t k) { return wrapped_difference(base[offset[k] + axis], origin[axis]); });
  };
  x = from(0);
  y = from(1);
  z = from(2);
}

struct FixedVector {
  std::int32_t lane[lanes_of<FloatVector>];
};
inline FixedVector load_cluster(const std::int32_t* p) noexcept {
  return lanewise<FixedVector>([&](std::size_t k) { return p[k]; });
}
inline FixedVector load_rows(const std::int32_t* p) noexcept {
  return lanewise<FixedVector>([&](std::size_t) { return *p; });
}
inline FloatVector wrapped_difference(FixedVector a, FixedVector b) noexcept {
  return lanewise<FloatVector>([&](std::size_t k) { return wrapped_difference(a.lane[k], b.lane[k]); });
}
inline void subtract_from_cluster(float* p, FloatVector v) noexcept { store(p, load(p) - v); }
inline void add_to_rows(float* p, const FloatVector* v) noexcept {
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t k = 0; k < lanes_of<FloatVector>; ++k) p[row] += v[row].lane[k];
}

inline Vector add_halves(FloatVector v) noexcept {
  return lanewise<Vector>(
      [&](std::size_t k) { return static_cast<double>(v.lane[k]) + static_cast<double>(v.lane[k + lanes_of<Vector>]); });
}
inline void store_truncated(std::int32_t* out, Vector v) noexcept {
  for (std::size_t k = 0; k < lanes_of<Vector>; ++k) out[k] = static_cast<std::int32_t>(v.lane[k]);
}
inline void store_wrapped(std::int32_t* out, Vector v) noexcept {
  for (std::size_t k = 0; k < lanes_of<Vector>; ++k)
    out[k] = static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::int64_t>(std::nearbyint(v.lane[k]))));
}

}  // namespace lanescape::kernels::LANESCAPE_ISA

#include "simd/by_lane.hpp"
