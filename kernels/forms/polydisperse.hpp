#pragma once

#include "forms/truncation.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

// u(r) = epsilon [x^-12 + c0 + c2 x^2 + c4 x^4], x = r/sigma_ij below its cutoff, with a diameter of each particle:
// sigma_ij = (sigma_i + sigma_j)/2 (1 - eta |sigma_i - sigma_j|). doi 10.1103/PhysRevX.7.021039
// Coefficients: those of Correction, epsilon, c0, c2, c4, eta, square of the cutoff in units of sigma_ij.
template <class V>
struct Polydisperse : EnergyForm<V> {
  static constexpr bool has_diameters = true;
  using typename EnergyForm<V>::Terms;

  struct Parameters {
    V epsilon, c0, c2, c4, half_eta, cutoff2;
    Correction<V> correction;
    PairUnit<V> unit;
  };

  template <class Given>
  static LANESCAPE_INLINE Parameters parameters(const Given& p) {
    const auto c = [&](std::size_t k) { return broadcast<V>(p.coefficient[k]); };
    return {c(4), c(5), c(6), c(7), broadcast<V>(p.coefficient[8] / 2), c(9), Correction<V>(p), PairUnit<V>(p)};
  }
  static LANESCAPE_INLINE V sigma_squared(const Parameters& u, V own, V other) {
    const V sigma = (own + other) * subtract_product(broadcast<V>(0.5), u.half_eta, absolute(own - other));
    return sigma * sigma;
  }
  static LANESCAPE_INLINE auto in_range(const Parameters& u, const Separation<V>& s) {
    return less(u.unit.square(s.r2), u.cutoff2 * s.sigma2);
  }

  template <class M>
  static LANESCAPE_INLINE Terms terms(const Parameters& u, const Separation<V>& s, M in_range) {
    const V r2 = u.unit.square(s.r2);
    // One division gives sigma^2/r^2, r^2/sigma^2 and 1/r^2.
    const V q = masked_quotient(in_range, broadcast<V>(1), r2 * s.sigma2);
    const V rinv2 = q * s.sigma2, x_inverse = rinv2 * s.sigma2, x = r2 * (q * r2);  // x: the square of r/sigma_ij
    const V x3 = x_inverse * x_inverse * x_inverse, repulsion = x3 * x3;
    const V square = multiply_add(u.c4, x, u.c2) * x, fourth = (u.c4 * x) * x;
    const V energy = u.epsilon * (repulsion + (u.c0 + square));
    const V slope = subtract_product(broadcast<V>(12) * repulsion, broadcast<V>(2), square + fourth);
    return {masked(in_range, energy), (u.epsilon * slope) * rinv2, r2};
  }
};

}  // namespace lanescape::kernels::LANESCAPE_ISA
