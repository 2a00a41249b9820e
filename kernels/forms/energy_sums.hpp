#pragma once

#include "loops/pair_vector.hpp"

// What forms share whose energy does not follow from a few sums of powers: energy and virial are added up pair by pair.
namespace lanescape::kernels::LANESCAPE_ISA {

// v in range, 0 out of it.
template <class M, class V>
LANESCAPE_INLINE V masked(M in_range, V v) {
  return select(in_range, v, zero<V>());
}

// Of one vector of pairs, zero out of range: u(r), -u'(r)/r and r^2, lengths in sigma.
template <class V>
struct EnergyTerms {
  V energy, force_over_r, r2;
};

template <class V>
struct EnergySums {
  V energy = zero<V>(), virial = energy;
};

// Base of such forms.
template <class V>
struct EnergyForm {
  static constexpr bool has_diameters = false;
  static constexpr bool in_box_units = false;
  using Terms = EnergyTerms<V>;
  using Sums = EnergySums<V>;

  template <class Parameters>
  static LANESCAPE_INLINE auto in_range(const Parameters& u, const Separation<V>& s) {
    return less(s.r2, u.cutoff_squared);
  }
  template <class Parameters, class M>
  static LANESCAPE_INLINE void add(Sums& sums, const Parameters&, const Terms& t, M) {
    sums.energy = sums.energy + t.energy;
    sums.virial = multiply_add(t.force_over_r, t.r2, sums.virial);
  }
  template <class Parameters>
  static LANESCAPE_INLINE V force_over_r(const Parameters&, const Terms& t) {
    return t.force_over_r;
  }
};

LANESCAPE_INLINE EnergySums<Vector> widened(const EnergySums<FloatVector>& s) {
  return {add_halves(s.energy), add_halves(s.virial)};
}

template <class Parameters>
LANESCAPE_INLINE void add_sums(Totals& totals, const Parameters&, const EnergySums<Vector>& s) {
  totals.energy += s.energy;
  totals.virial += s.virial;
}

// What a truncation adds to u(r): c0 + c1 r + c2 r^2 + c4 r^4. Coefficients 0 to 3 of a form that has one.
template <class V>
struct Correction {
  V c0, c1, c2, c4;
  bool linear;  // c1 is not zero

  template <class Given>
  explicit LANESCAPE_INLINE Correction(const Given& p)
      : c0(broadcast<V>(p.coefficient[0])),
        c1(broadcast<V>(p.coefficient[1])),
        c2(broadcast<V>(p.coefficient[2])),
        c4(broadcast<V>(p.coefficient[3])),
        linear(p.coefficient[1] != 0) {}

  // Adds it to energy and force; out of range terms stay zero. A root is taken only where the truncation asks for one.
  template <class M>
  LANESCAPE_INLINE void add(EnergyTerms<V>& t, M in_range) const {
    t.energy = t.energy + multiply_add(multiply_add(c4, t.r2, c2), t.r2, c0);
    t.force_over_r = t.force_over_r - twice(multiply_add(twice(c4), t.r2, c2));
    if (linear) {
      const V r = square_root(t.r2);
      t.energy = multiply_add(c1, r, t.energy);
      t.force_over_r = t.force_over_r - c1 / r;
    }
    t.energy = masked(in_range, t.energy);
    t.force_over_r = masked(in_range, t.force_over_r);
  }
  static LANESCAPE_INLINE V twice(V v) { return v + v; }
};

}  // namespace lanescape::kernels::LANESCAPE_ISA
