#pragma once

#include "loops/pair_vector.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

// u(r) = c12 r^-12 - c6 r^-6 - shift, r below the cutoff.
// Coefficients: c12 = 4 epsilon sigma^12, c6 = 4 epsilon sigma^6, shift, 12 c12, -6 c6.
template <class V>
struct LennardJones {
  static constexpr bool has_diameters = false;
  // Loops in units of the box and with a mask for every edge: faster by three products a vector, and three times the code to
  // compile.
  static constexpr bool specialised = true;

  struct Parameters {
    V c12, c6, shift, twelve_c12, minus_six_c6, cutoff_squared;
    PairUnit<V> unit;
  };
  // What energy and force of one vector of pairs have in common; zero out of range.
  struct Terms {
    V rinv2, rinv6;
  };
  // Over the pairs in range: all that energy and virial need.
  struct Sums {
    V rinv6 = zero<V>(), rinv12 = rinv6, count = rinv6;
  };

  template <class Given>
  static LANESCAPE_INLINE Parameters parameters(const Given& p) {
    const auto c = [&](std::size_t k) { return broadcast<V>(p.coefficient[k]); };
    return {c(0), c(1), c(2), c(3), c(4), broadcast<V>(p.cutoff_squared), PairUnit<V>(p)};
  }
  static LANESCAPE_INLINE auto in_range(const Parameters& u, const Separation<V>& s) { return less(s.r2, u.cutoff_squared); }
  template <class M>
  static LANESCAPE_INLINE Terms terms(const Parameters& u, const Separation<V>& s, M in_range) {
    const V rinv2 = u.unit.inverse(in_range, s.r2);
    return {rinv2, rinv2 * rinv2 * rinv2};
  }
  template <class M>
  static LANESCAPE_INLINE void add(Sums& sums, const Parameters&, const Terms& t, M in_range) {
    add_powers(sums, t.rinv6, in_range);
  }
  template <class M>
  static LANESCAPE_INLINE void add_powers(Sums& sums, V rinv6, M in_range) {
    sums.rinv6 = sums.rinv6 + rinv6;
    sums.rinv12 = multiply_add(rinv6, rinv6, sums.rinv12);
    sums.count = masked_increment(sums.count, in_range);
  }
  // -u'(r)/r
  template <class M>
  static LANESCAPE_INLINE V force_over_r(const Parameters& u, const Terms& t, M) {
    return (multiply_add(u.twelve_c12, t.rinv6, u.minus_six_c6) * t.rinv6) * t.rinv2;
  }
};

LANESCAPE_INLINE LennardJones<Vector>::Sums widened(const LennardJones<FloatVector>::Sums& s) {
  return {add_halves(s.rinv6), add_halves(s.rinv12), add_halves(s.count)};
}

// Energy and virial of one species pair.
LANESCAPE_INLINE void add_sums(Totals& totals, const LennardJones<Vector>::Parameters& u, const LennardJones<Vector>::Sums& s) {
  totals.energy += multiply_add(u.c12, s.rinv12, broadcast(0.0) - multiply_add(u.c6, s.rinv6, u.shift * s.count));
  totals.virial += multiply_add(u.twelve_c12, s.rinv12, u.minus_six_c6 * s.rinv6);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
