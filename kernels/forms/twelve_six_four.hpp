#pragma once

#include "forms/energy_sums.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

// u(r) = a [x^12 - x^6 - c x^4], x = sigma/r, and a truncation; a = 4 epsilon.
// Coefficients: those of Correction, a, c, sigma^2.
template <class V>
struct TwelveSixFour : EnergyForm<V> {
  using Terms = EnergyTerms<V>;

  struct Parameters {
    V cutoff_squared, a, c, sigma2;
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
    const V rinv2 = u.unit.inverse(in_range, s.r2), x2 = u.sigma2 * rinv2, x4 = x2 * x2, x6 = x4 * x2;
    const V fourth = u.c * x4;
    const V energy = u.a * (multiply_add(x6, x6, zero<V>() - x6) - fourth);
    const V slope =
        multiply_add(broadcast<V>(12) * x6, x6, zero<V>() - multiply_add(broadcast<V>(6), x6, broadcast<V>(4) * fourth));
    Terms t{energy, (u.a * slope) * rinv2, u.unit.square(s.r2)};
    u.correction.add(t, in_range);
    return t;
  }
};

}  // namespace lanescape::kernels::LANESCAPE_ISA
