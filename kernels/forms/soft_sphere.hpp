#pragma once

#include "forms/truncation.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

// u(r) = a (1 - r/sigma)^2, or a (1 - r/sigma)^(5/2), and a truncation: harmonic and Hertzian spheres.
// Coefficients: those of Correction, a, 1/sigma, whether the power is 5/2.
template <class V>
struct SoftSphere : EnergyForm<V> {
  using typename EnergyForm<V>::Terms;

  struct Parameters {
    V cutoff_squared, a, inverse_sigma, power_a_over_sigma;
    bool hertzian;
    Correction<V> correction;
    PairUnit<V> unit;
  };

  template <class Given>
  static LANESCAPE_INLINE Parameters parameters(const Given& p) {
    const auto c = [&](std::size_t k) { return p.coefficient[k]; };
    const bool hertzian = c(6) != 0;
    return {broadcast<V>(p.cutoff_squared),
            broadcast<V>(c(4)),
            broadcast<V>(c(5)),
            broadcast<V>((hertzian ? 2.5 : 2.0) * c(4) * c(5)),
            hertzian,
            Correction<V>(p),
            PairUnit<V>(p)};
  }

  template <class M>
  static LANESCAPE_INLINE Terms terms(const Parameters& u, const Separation<V>& s, M in_range) {
    // Centres that coincide have no direction: a tiny r makes the force on them zero.
    const V r2 = maximum(u.unit.square(s.r2), broadcast<V>(1e-36)), r = square_root(r2);
    // Rounding may leave a depth below zero at the edge.
    const V depth = maximum(masked(in_range, broadcast<V>(1) - r * u.inverse_sigma), zero<V>());
    const V lower = u.hertzian ? depth * square_root(depth) : depth;  // the power that the force has
    return {(u.a * depth) * lower, (u.power_a_over_sigma * lower) / r, r2};
  }
};

}  // namespace lanescape::kernels::LANESCAPE_ISA
