#pragma once

#include "forms/energy_sums.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

// u(r) = a (sigma/r)^2n - b (sigma/r)^2m and a truncation: Mie and inverse-power potentials.
// Coefficients: those of Correction, a, b, n, m, sigma^2.
template <class V>
struct EvenPowers : EnergyForm<V> {
  using Terms = EnergyTerms<V>;

  struct Parameters {
    V cutoff_squared, a, b, two_n_a, two_m_b, sigma2;
    unsigned n, m;
    Correction<V> correction;
    PairUnit<V> unit;
  };

  template <class Given>
  static LANESCAPE_INLINE Parameters parameters(const Given& p) {
    const auto c = [&](std::size_t k) { return p.coefficient[k]; };
    return {broadcast<V>(p.cutoff_squared),
            broadcast<V>(c(4)),
            broadcast<V>(c(5)),
            broadcast<V>(2 * c(6) * c(4)),
            broadcast<V>(2 * c(7) * c(5)),
            broadcast<V>(c(8)),
            static_cast<unsigned>(c(6)),
            static_cast<unsigned>(c(7)),
            Correction<V>(p),
            PairUnit<V>(p)};
  }

  // x^n. The branches are the same for all pairs of a loop, hence foreseen.
  static LANESCAPE_INLINE V power(V x, unsigned n) {
    V result = n & 1U ? x : broadcast<V>(1);
    while (n >>= 1U) {
      x = x * x;
      if (n & 1U) result = result * x;
    }
    return result;
  }

  template <class M>
  static LANESCAPE_INLINE Terms terms(const Parameters& u, const Separation<V>& s, M in_range) {
    const V rinv2 = u.unit.inverse(in_range, s.r2), x = u.sigma2 * rinv2;
    const V repulsion = power(x, u.n);
    Terms t{u.a * repulsion, (u.two_n_a * repulsion) * rinv2, u.unit.square(s.r2)};
    if (u.m != 0) {
      const V attraction = power(x, u.m);
      t.energy = subtract_product(t.energy, u.b, attraction);
      t.force_over_r = (subtract_product(u.two_n_a * repulsion, u.two_m_b, attraction)) * rinv2;
    }
    u.correction.add(t, in_range);
    return t;
  }
};

}  // namespace lanescape::kernels::LANESCAPE_ISA
