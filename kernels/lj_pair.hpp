#pragma once

#include "isa.hpp"
#include "simd_ops.hpp"
#include "views.hpp"

// What the Lennard-Jones kernels share, whichever way they find their pairs: one vector of pairs at a time.
namespace lanescape::kernels::LANESCAPE_ISA {

#define LANESCAPE_INLINE inline __attribute__((always_inline))

struct Displacement {
  Vector x, y, z;
};

// The potential of one species pair, in the units of the separations.
struct Potential {
  Vector c12, c6, twelve_c12, six_c6, cutoff_squared, shift;
};

inline Potential broadcast_potential(const LjPair& p) noexcept {
  return {broadcast(p.c12),  broadcast(p.c6), broadcast(12.0 * p.c12), broadcast(6.0 * p.c6), broadcast(p.cutoff_squared),
          broadcast(p.shift)};
}

// Sums over the pairs in range of r^-6, r^-12 and 1: all that energy and virial need.
struct PowerSums {
  Vector rinv6 = broadcast(0.0), rinv12 = broadcast(0.0), count = broadcast(0.0);
};

struct Totals {
  Vector energy = broadcast(0.0), virial = broadcast(0.0);
  Vector tensor[6] = {energy, energy, energy, energy, energy, energy};
};

LANESCAPE_INLINE Vector squared_length(const Displacement& d) { return multiply_add(d.z, d.z, multiply_add(d.y, d.y, d.x * d.x)); }

LANESCAPE_INLINE void add_powers(PowerSums& sums, Vector rinv6, Mask in_range) {
  sums.rinv6 += rinv6;
  sums.rinv12 = multiply_add(rinv6, rinv6, sums.rinv12);
  sums.count = masked_increment(sums.count, in_range);
}

// -u'(r)/r, given 1/r^2 and its cube.
LANESCAPE_INLINE Vector force_over_r(const Potential& u, Vector inverse, Vector rinv6) {
  return (multiply_add(u.twelve_c12, rinv6, broadcast(0.0) - u.six_c6) * rinv6) * inverse;
}

LANESCAPE_INLINE void add_tensor(Totals& totals, const Displacement& d, Vector w) {
  const Vector wx = w * d.x, wy = w * d.y, wz = w * d.z;
  totals.tensor[0] = multiply_add(wx, d.x, totals.tensor[0]);
  totals.tensor[1] = multiply_add(wy, d.y, totals.tensor[1]);
  totals.tensor[2] = multiply_add(wz, d.z, totals.tensor[2]);
  totals.tensor[3] = multiply_add(wy, d.z, totals.tensor[3]);
  totals.tensor[4] = multiply_add(wx, d.z, totals.tensor[4]);
  totals.tensor[5] = multiply_add(wx, d.y, totals.tensor[5]);
}

// Energy and virial of one species pair.
LANESCAPE_INLINE void add_sums(Totals& totals, const Potential& u, const PowerSums& sums) {
  totals.energy += multiply_add(u.c12, sums.rinv12, broadcast(0.0) - multiply_add(u.c6, sums.rinv6, u.shift * sums.count));
  totals.virial += multiply_add(u.twelve_c12, sums.rinv12, broadcast(0.0) - u.six_c6 * sums.rinv6);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
