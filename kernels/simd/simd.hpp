#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "isa.hpp"

// The vector operations that kernels are written in. Each instruction set has a header, simd/<name>.hpp: these headers are the only
// files that know xsimd and intrinsics. This one includes the header of the instruction set being compiled, says what it gives, and
// adds what can be written in terms of that. Kernels include this file and no other of this folder.
//
// Operations are `inline`. Forcing that with always_inline makes g++ 12 order the loops over lists worse: 4 % more instructions.
// clang-format off: it would put spaces into the path
#define LANESCAPE_SIMD_HEADER_(name) LANESCAPE_ISA_STRING_(simd/name.hpp)
// clang-format on
#define LANESCAPE_SIMD_HEADER(name) LANESCAPE_SIMD_HEADER_(name)
#include LANESCAPE_SIMD_HEADER(LANESCAPE_ISA)
#include "simd/traits.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

inline constexpr std::size_t lanes = lanes_of<Vector>;
inline constexpr std::size_t float_lanes = lanes_of<FloatVector>;

// What every instruction set gives, for V = Vector (doubles) and V = FloatVector (floats), with masks M = MaskOf<V>:
//
//   V + - * / V, V += V
//   V load(const ScalarOf<V>*), load_unaligned; store(ScalarOf<V>*, V), store_unaligned      aligned to the vector unless said
//   V broadcast<V>(s)                    s in every lane
//   V multiply_add(a, b, c)              a b + c, subtract_product(c, a, b): c - a b; one rounding, but two on SSE2 and generic
//   V absolute(v), square_root(v), maximum(a, b), minimum(a, b)      b where one of the two is not a number or both are zero
//   V copy_sign(a, s)                    the magnitude of a with the sign of s
//   V nearest_whole(v)                   ties to even; |v| < 2^51 (2^22 for floats)
//   M less(a, b), equal(a, b)            false where one of the two is not a number
//   M both(a, b), either(a, b), and_not(a, b)      and_not: a without b
//   bool any(M); unsigned bits(M)        bit k is lane k
//   V select(m, a, b)                    a where the mask is set, b elsewhere
//   V masked_quotient(m, a, b)           a / b where the mask is set, 0 elsewhere
//   V masked_increment(sum, m)           sum + 1 where the mask is set, sum elsewhere
//   V scale_by_power_of_two(v, n)        v 2^n, rounded once; n whole, |n| <= 1090 (180 for floats)
//   V exponential(v)                     e^v, at most 2 ulp off (simd/exponential.hpp)
//
// For doubles:
//   reduce_to_nearest(v)                 v - nearest_whole(v): the nearest image of a separation in box lengths
//   reduce_add(v), reduce_max(v)         over the lanes; sums always in the same order
//   reduce_add_four(p, a, b, c, d)       adds the lane sums of four vectors to four doubles, 32-byte aligned
//   store_point(p, x, y, z)              the lane sums of three vectors and a zero to four doubles, 32-byte aligned
//   gather(base, index)                  base[index[0]], ..., one by one: the gather instruction of Zen 4 is slower
//   gather_records(base, index, V* out)  records of eight doubles, 64-byte aligned: field f of record index[k] to lane k of out[f]
//   gather_points(base, offset, x, y, z), gather_quads(base, offset, x, y, z, w)      three (all four) numbers of records of four
//                                        doubles, 32-byte aligned; that of lane k is offset[k] doubles from base
//   compress_store(p, bits, v)           the lanes whose bits are set, one after the other from p on; returns their number. Up to a
//                                        whole vector is overwritten, here and below
//   compress_store(p, bits, from)        the same of 32-bit numbers in memory, which may be those that are overwritten
//   compress_store_lanes(p, bits, first) the same of the numbers first + lane
//   store_truncated(p, v)                each lane without its fraction as a 32-bit integer; |v| < 2^31
//   store_wrapped(p, v)                  the nearest whole number as a 32-bit integer; |v| <= 2^31, which becomes -2^31
//
// For floats. Filters in single precision take coordinates as 32-bit fractions of the box, whose differences wrap around as the box
// does. Forces in mixed precision take them as integers in a unit so small that they wrap around many times in the box, while the
// difference of two points in reach of one another does not.
//   wrapped_difference(p, s)             p[k] - s in wrapping 32-bit arithmetic
//   gather_differences(base, offset, origin, x, y, z)      the same of records of four integers, 16-byte aligned, with those of
//                                        `origin`; the record of lane k is offset[k] integers from base
//   FixedVector load_cluster(p)          integers p[0 ... 7] in the lanes of each row of a vector: AVX-512 has two rows, others one;
//                                        SSE2 has four lanes and needs two vectors for a cluster of eight
//   FixedVector load_rows(p)             p[row] in all lanes of a row
//   wrapped_difference(a, b)             of two FixedVectors
//   subtract_from_cluster(p, v)          the rows of v from p[0 ... 7], aligned to a row
//   add_to_rows(p, v)                    the lane sums of four rows, in as many vectors as they take, to p[0 ... 3], 16-byte aligned
//   compress_store_offsets(p, bits, first)      compress_store of the numbers 4 (first + lane)
//   compress_store_wide(p, bits, from)       compress_store of as many 32-bit numbers in memory
//   Vector add_halves(v)                 lower half + upper half, in double precision

inline Vector broadcast(double s) noexcept { return broadcast<Vector>(s); }

// 1/v where the mask is set, 0 elsewhere.
template <class M, class V>
inline V masked_reciprocal(M m, V v) noexcept {
  return masked_quotient(m, broadcast<V>(1), v);
}

// Set in the lanes below k; k beyond the ends means all or none.
template <class V = Vector, class Count>
inline MaskOf<V> lanes_below(Count k) noexcept {
  constexpr Count width = lanes_of<V>;
  if constexpr (std::is_signed_v<Count>) k = k < 0 ? 0 : k;
  return first_lanes<V>(static_cast<std::size_t>(k < width ? k : width));
}

// first, first + 1, first + 2, ...
inline Vector count_from(double first) noexcept {
  alignas(64) static constexpr double whole[] = {0, 1, 2, 3, 4, 5, 6, 7};
  return load(whole) + broadcast(first);
}

// Taken from zero and not negated, so that zero stays +0.
inline double reduce_min(Vector v) noexcept { return 0.0 - reduce_max(broadcast(0.0) - v); }

// Inlined by force: g++ takes a function that only prefetches for one without effects and drops calls of it.
[[gnu::always_inline]] inline void prefetch(const void* p) noexcept { __builtin_prefetch(p); }
[[gnu::always_inline]] inline void prefetch_for_write(void* p) noexcept { __builtin_prefetch(p, 1); }

// Whole numbers that lanes are rounded to, one by one in memory: what takes them out of a vector register costs more. In 32 bits, so
// that they are at most 32 bytes: loads from the upper half of a store of 64 bytes wait until it has left the store buffer.
struct WholeLanes {
  alignas(32) std::int32_t lane[lanes];
  std::uint32_t operator[](std::size_t k) const noexcept { return static_cast<std::uint32_t>(lane[k]); }
};

// The whole number nearest to each lane, ties to even, and `factor` times it. 0 <= v, factor * v < 2^31.
inline Vector store_nearest_whole(WholeLanes& out, Vector v, double factor) noexcept {
  // 1.5 x 2^52 leaves no bits for a fraction.
  const Vector shifted = broadcast(6755399441055744.0), whole = (v + shifted) - shifted;
  store_wrapped(out.lane, whole * broadcast(factor));
  asm volatile("" : "+m"(out.lane));
  return whole;
}

// Whole boxes left out, what is left of a coordinate in box lengths as a 32-bit fraction; one half wraps to minus one half.
inline void store_fractions(std::int32_t* out, Vector box_lengths) noexcept {
  store_wrapped(out, reduce_to_nearest(box_lengths) * broadcast(4294967296.0));
}

}  // namespace lanescape::kernels::LANESCAPE_ISA

#include "simd/exponential.hpp"
