#pragma once

#include "forms/truncation.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

// u(r) = a x^(m + d) - b x^m, x = (sigma/r)^2, and a truncation: Mie and inverse-power potentials.
// Coefficients: those of Correction, a, b, m, d, sigma^2.
template <class V>
struct EvenPowers : TruncatedForm<V> {
  struct Parameters {
    V cutoff_squared, sigma2, a, b, repulsive_virial, attractive_virial, repulsion, attraction;  // the last two of the force
    unsigned m, d;
    Correction<V> correction;
    PairUnit<V> unit;
  };
  // Zero out of range, but for x^0.
  struct Terms {
    V x, xm, xd, r2;
  };
  struct Sums {
    V repulsion = zero<V>(), attraction = repulsion;
    typename Correction<V>::Sums correction;
  };

  template <class Given>
  static LANESCAPE_INLINE Parameters parameters(const Given& p) {
    const auto a = p.coefficient[4], b = p.coefficient[5], m = p.coefficient[6], d = p.coefficient[7], sigma2 = p.coefficient[8];
    const auto repulsive = 2 * (m + d) * a, attractive = -2 * m * b;
    const PairUnit<V> unit(p);
    return {broadcast<V>(p.cutoff_squared),
            unit.from_sigma(broadcast<V>(sigma2)),
            broadcast<V>(a),
            broadcast<V>(b),
            broadcast<V>(repulsive),
            broadcast<V>(attractive),
            broadcast<V>(repulsive / sigma2),
            broadcast<V>(attractive / sigma2),
            static_cast<unsigned>(m),
            static_cast<unsigned>(d),
            Correction<V>(p),
            unit};
  }

  // x^n. Its branches go the same way for all pairs of a loop, so the processor predicts them.
  static LANESCAPE_INLINE V power(V x, unsigned n) {
    if (n == 0) return broadcast<V>(1);
    for (; n % 2 == 0; n /= 2) x = x * x;
    V result = x;
    while (n /= 2) {
      x = x * x;
      if (n % 2 == 1) result = result * x;
    }
    return result;
  }

  template <class M>
  static LANESCAPE_INLINE Terms terms(const Parameters& u, const Separation<V>& s, M in_range) {
    const V x = masked_quotient(in_range, u.sigma2, s.r2);
    return {x, power(x, u.m), power(x, u.d), u.unit.square(s.r2)};
  }
  template <class M>
  static LANESCAPE_INLINE void add(Sums& sums, const Parameters& u, const Terms& t, M in_range) {
    sums.repulsion = multiply_add(t.xm, t.xd, sums.repulsion);
    sums.attraction = sums.attraction + t.xm;
    u.correction.add(sums.correction, t.r2, in_range);
  }
  template <class M>
  static LANESCAPE_INLINE V force_over_r(const Parameters& u, const Terms& t, M in_range) {
    return u.correction.corrected((multiply_add(u.repulsion, t.xd, u.attraction) * t.xm) * t.x, t.r2, in_range);
  }
};

LANESCAPE_INLINE EvenPowers<Vector>::Sums widened(const EvenPowers<FloatVector>::Sums& s) {
  return {add_halves(s.repulsion), add_halves(s.attraction), widened(s.correction)};
}

LANESCAPE_INLINE void add_sums(Totals& totals, const EvenPowers<Vector>::Parameters& u, const EvenPowers<Vector>::Sums& s) {
  totals.energy += u.a * s.repulsion - u.b * s.attraction;
  totals.virial += multiply_add(u.repulsive_virial, s.repulsion, u.attractive_virial * s.attraction);
  add_sums(totals, u.correction, s.correction);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
