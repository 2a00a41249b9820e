#pragma once

#include "simd/traits.hpp"

// e^v over the whole range, infinities and NaN included; at most 1.1 ulp off (measured), 2 ulp are allowed.
//
// v = n ln 2 + r with n whole and |r| <= ln(2)/2; ln 2 comes in two parts, of which n times the first is exact. Then
// e^r = 1 + r + r^2 P(r), where P has the least largest relative error of its degree (found by Remez' exchange method), and
// e^v = e^r 2^n. Arguments are first limited to where the result is zero or infinite.
namespace lanescape::kernels::LANESCAPE_ISA {

// P: the even powers of r, then the odd ones, so that two chains run side by side.
template <class V, std::size_t pairs>
inline V split_polynomial(V r, V square, const ScalarOf<V> (&even)[pairs], const ScalarOf<V> (&odd)[pairs]) noexcept {
  V e = broadcast<V>(even[pairs - 1]), o = broadcast<V>(odd[pairs - 1]);
  for (std::size_t k = pairs - 1; k-- > 0;) {
    e = multiply_add(e, square, broadcast<V>(even[k]));
    o = multiply_add(o, square, broadcast<V>(odd[k]));
  }
  return multiply_add(o, r, e);
}

inline Vector exponential(Vector v) noexcept {
  // Largest relative error of the polynomial: 3.6e-18.
  static constexpr double even[] = {0x1.000000000000ap-1, 0x1.555555555087dp-5, 0x1.6c16c18429f3fp-10, 0x1.a0199a0cad68ap-16,
                                    0x1.28ad7293dd837p-22};
  static constexpr double odd[] = {0x1.55555555554fap-3, 0x1.1111111127bf3p-7, 0x1.a01a012a5264ap-13, 0x1.71df255ef2651p-19,
                                   0x1.ad7f59f7dfc9cp-26};
  // NaN is the second argument, which both pass on.
  v = minimum(broadcast(710.0), maximum(broadcast(-750.0), v));
  const Vector n = nearest_whole(v * broadcast(0x1.71547652b82fep+0));
  // 32 bits of ln 2 and what is left of it.
  const Vector r = subtract_product(subtract_product(v, n, broadcast(0x1.62e42feep-1)), n, broadcast(0x1.a39ef35793c76p-33));
  const Vector square = r * r;
  const Vector power = broadcast(1.0) + multiply_add(square, split_polynomial(r, square, even, odd), r);
  return scale_by_power_of_two(power, n);
}

inline FloatVector exponential(FloatVector v) noexcept {
  // Largest relative error of the polynomial: 5.2e-11 before the coefficients are rounded.
  static constexpr float even[] = {0x1p-1F, 0x1.55548ep-5F, 0x1.6d8d06p-10F};
  static constexpr float odd[] = {0x1.555554p-3F, 0x1.11127p-7F, 0x1.9f0892p-13F};
  v = minimum(broadcast<FloatVector>(89.0F), maximum(broadcast<FloatVector>(-105.0F), v));
  const FloatVector n = nearest_whole(v * broadcast<FloatVector>(0x1.715476p+0F));
  // 9 bits of ln 2 and what is left of it.
  const FloatVector r =
      subtract_product(subtract_product(v, n, broadcast<FloatVector>(0x1.63p-1F)), n, broadcast<FloatVector>(-0x1.bd0106p-13F));
  const FloatVector square = r * r;
  const FloatVector power = broadcast<FloatVector>(1.0F) + multiply_add(square, split_polynomial(r, square, even, odd), r);
  return scale_by_power_of_two(power, n);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
