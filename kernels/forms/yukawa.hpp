#pragma once

#include "forms/truncation.hpp"
#include "simd/exponential.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

// u(r) = a exp(kappa (sigma - r)) / r and a truncation; a = epsilon sigma.
// Coefficients: those of Correction, a, kappa, kappa sigma.
template <class V>
struct Yukawa : EnergyForm<V> {
  using typename EnergyForm<V>::Terms;

  struct Parameters {
    V cutoff_squared, a, kappa, kappa_sigma;
    Correction<V> correction;
    PairUnit<V> unit;
  };

  template <class Given>
  static LANESCAPE_INLINE Parameters parameters(const Given& p) {
    const auto c = [&](std::size_t k) { return broadcast<V>(p.coefficient[k]); };
    return {broadcast<V>(p.cutoff_squared), c(4), c(5), c(6), Correction<V>(p), PairUnit<V>(p)};
  }

  template <class M>
  static LANESCAPE_INLINE Terms terms(const Parameters& u, const Separation<V>& s, M in_range) {
    const V r2 = u.unit.square(s.r2), rinv = square_root(masked_quotient(in_range, broadcast<V>(1), r2));
    const V energy = (u.a * rinv) * exponential(subtract_product(u.kappa_sigma, u.kappa, r2 * rinv));
    return {energy, energy * ((u.kappa + rinv) * rinv), r2};
  }
};

}  // namespace lanescape::kernels::LANESCAPE_ISA
