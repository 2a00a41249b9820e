#pragma once

#include "loops/pair_vector.hpp"

// Shared by the forms that take any truncation.
namespace lanescape::kernels::LANESCAPE_ISA {

// v in range, 0 out of it.
template <class M, class V>
LANESCAPE_INLINE V masked(M in_range, V v) {
  return select(in_range, v, zero<V>());
}

// What a truncation adds to u(r): c0 + c1 r + c2 r^2 + c4 r^4, coefficients 0 to 3 of a form. All
// pairs of a loop have the same kind, so the processor predicts the branches on it.
template <class V>
struct Correction {
  V c0, minus_c1, minus_two_c2, minus_four_c4;
  PairCorrectionKind kind;

  // Over the pairs in range.
  struct Sums {
    V count = zero<V>(), r = count, r2 = count, r4 = count;
  };

  template <class Given>
  explicit LANESCAPE_INLINE Correction(const Given& p)
      : c0(broadcast<V>(p.coefficient[0])),
        minus_c1(broadcast<V>(-p.coefficient[1])),
        minus_two_c2(broadcast<V>(-2 * p.coefficient[2])),
        minus_four_c4(broadcast<V>(-4 * p.coefficient[3])),
        kind(p.correction) {}

  template <class M>
  LANESCAPE_INLINE void add(Sums& sums, V r2, M in_range) const {
    sums.count = masked_increment(sums.count, in_range);
    if (kind == PairCorrectionKind::constant) return;
    const V inside = masked(in_range, r2);
    sums.r2 = sums.r2 + inside;
    sums.r4 = multiply_add(inside, inside, sums.r4);
    if (kind == PairCorrectionKind::linear) sums.r = sums.r + square_root(inside);
  }
  // -u'(r)/r with the truncation, from that without.
  template <class M>
  LANESCAPE_INLINE V corrected(V force_over_r, V r2, M in_range) const {
    if (kind == PairCorrectionKind::constant) return force_over_r;
    V more = multiply_add(minus_four_c4, r2, minus_two_c2);
    if (kind == PairCorrectionKind::linear) more = more + minus_c1 / square_root(r2);
    return force_over_r + masked(in_range, more);
  }
};

LANESCAPE_INLINE Correction<Vector>::Sums widened(const Correction<FloatVector>::Sums& s) {
  return {add_halves(s.count), add_halves(s.r), add_halves(s.r2), add_halves(s.r4)};
}

LANESCAPE_INLINE void add_sums(Totals& totals, const Correction<Vector>& u, const Correction<Vector>::Sums& s) {
  totals.energy = multiply_add(u.c0, s.count, totals.energy);
  if (u.kind == PairCorrectionKind::constant) return;
  const Vector linear = u.minus_c1 * s.r, square = u.minus_two_c2 * s.r2, fourth = u.minus_four_c4 * s.r4;
  totals.energy += broadcast(0.0) - (linear + (broadcast(0.5) * square + broadcast(0.25) * fourth));
  totals.virial += linear + (square + fourth);
}

// Base of forms with a truncation.
template <class V>
struct TruncatedForm {
  static constexpr bool has_diameters = false;
  static constexpr bool specialised = false;

  template <class Parameters>
  static LANESCAPE_INLINE auto in_range(const Parameters& u, const Separation<V>& s) {
    return less(s.r2, u.cutoff_squared);
  }
};

// Base of forms whose energy does not follow from a few sums of powers: energy and virial are added up pair by pair.
template <class V>
struct EnergyForm : TruncatedForm<V> {
  // Of one vector of pairs, zero out of range: u(r) and -u'(r)/r without the truncation; r^2. Lengths in sigma.
  struct Terms {
    V energy, force_over_r, r2;
  };
  struct Sums {
    V energy = zero<V>(), virial = energy;
    typename Correction<V>::Sums correction;
  };

  template <class Parameters, class M>
  static LANESCAPE_INLINE void add(Sums& sums, const Parameters& u, const Terms& t, M in_range) {
    sums.energy = sums.energy + t.energy;
    sums.virial = multiply_add(t.force_over_r, t.r2, sums.virial);
    u.correction.add(sums.correction, t.r2, in_range);
  }
  template <class Parameters, class M>
  static LANESCAPE_INLINE V force_over_r(const Parameters& u, const Terms& t, M in_range) {
    return u.correction.corrected(t.force_over_r, t.r2, in_range);
  }
};

LANESCAPE_INLINE EnergyForm<Vector>::Sums widened(const EnergyForm<FloatVector>::Sums& s) {
  return {add_halves(s.energy), add_halves(s.virial), widened(s.correction)};
}

template <class Parameters>
LANESCAPE_INLINE void add_sums(Totals& totals, const Parameters& u, const EnergyForm<Vector>::Sums& s) {
  totals.energy += s.energy;
  totals.virial += s.virial;
  add_sums(totals, u.correction, s.correction);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
