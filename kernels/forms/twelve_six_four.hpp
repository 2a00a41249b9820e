#pragma once

#include "forms/truncation.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

// u(r) = a (x^6 - x^3 - c x^2), x = (sigma/r)^2, and a truncation; a = 4 epsilon.
// Coefficients: those of Correction, a, c, sigma^2.
template <class V>
struct TwelveSixFour : TruncatedForm<V> {
  struct Parameters {
    V cutoff_squared, sigma2, a, c, twelve, six, four;  // the last three of the force
    Correction<V> correction;
    PairUnit<V> unit;
  };
  // Zero out of range.
  struct Terms {
    V x, x2, x3, r2;
  };
  struct Sums {
    V x2 = zero<V>(), x3 = x2, x6 = x2;
    typename Correction<V>::Sums correction;
  };

  template <class Given>
  static LANESCAPE_INLINE Parameters parameters(const Given& p) {
    const auto a = p.coefficient[4], c = p.coefficient[5], sigma2 = p.coefficient[6];
    const PairUnit<V> unit(p);
    return {broadcast<V>(p.cutoff_squared),
            unit.from_sigma(broadcast<V>(sigma2)),
            broadcast<V>(a),
            broadcast<V>(c),
            broadcast<V>(12 * a / sigma2),
            broadcast<V>(-6 * a / sigma2),
            broadcast<V>(-4 * a * c / sigma2),
            Correction<V>(p),
            unit};
  }

  template <class M>
  static LANESCAPE_INLINE Terms terms(const Parameters& u, const Separation<V>& s, M in_range) {
    const V x = masked_quotient(in_range, u.sigma2, s.r2), x2 = x * x;
    return {x, x2, x2 * x, u.unit.square(s.r2)};
  }
  template <class M>
  static LANESCAPE_INLINE void add(Sums& sums, const Parameters& u, const Terms& t, M in_range) {
    sums.x2 = sums.x2 + t.x2;
    sums.x3 = sums.x3 + t.x3;
    sums.x6 = multiply_add(t.x3, t.x3, sums.x6);
    u.correction.add(sums.correction, t.r2, in_range);
  }
  template <class M>
  static LANESCAPE_INLINE V force_over_r(const Parameters& u, const Terms& t, M in_range) {
    const V w = multiply_add(u.four, t.x2, multiply_add(u.twelve, t.x3, u.six) * t.x3) * t.x;
    return u.correction.corrected(w, t.r2, in_range);
  }
};

LANESCAPE_INLINE TwelveSixFour<Vector>::Sums widened(const TwelveSixFour<FloatVector>::Sums& s) {
  return {add_halves(s.x2), add_halves(s.x3), add_halves(s.x6), widened(s.correction)};
}

LANESCAPE_INLINE void add_sums(Totals& totals, const TwelveSixFour<Vector>::Parameters& u, const TwelveSixFour<Vector>::Sums& s) {
  const Vector fourth = u.c * s.x2, twelve = broadcast(12.0), six = broadcast(6.0), four = broadcast(4.0);
  totals.energy += u.a * (s.x6 - (s.x3 + fourth));
  totals.virial += u.a * (twelve * s.x6 - (six * s.x3 + four * fourth));
  add_sums(totals, u.correction, s.correction);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
