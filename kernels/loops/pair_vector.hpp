#pragma once

#include <type_traits>

#include "isa.hpp"
#include "simd/simd.hpp"
#include "views/pair.hpp"

// What all loops over pairs share: one vector of pairs at a time.
namespace lanescape::kernels::LANESCAPE_ISA {

#define LANESCAPE_INLINE inline __attribute__((always_inline))

// What a loop computes. `force` leaves energy and virial out.
enum class Output { energy, force, gradient, stress };
constexpr bool has_energy(Output output) { return output != Output::force; }
constexpr bool has_gradient(Output output) { return output != Output::energy; }

template <class V>
LANESCAPE_INLINE V zero() {
  return broadcast<V>(0);
}

template <class V>
struct Vector3 {
  V x, y, z;
};
using Displacement = Vector3<Vector>;

// A vector of pairs as a form sees it: r^2, and sigma_ij^2 where the form has particles of individual diameters, else nothing.
template <class V>
struct Separation {
  V r2, sigma2;
};

// From the unit of the separations to that of the parameters. Separations in double precision have the same; in single precision
// r^2 comes in a fixed unit, a power of two, so that nothing is rounded on the way.
template <class V>
struct PairUnit {
  explicit PairUnit(const PairParameters&) {}
  static LANESCAPE_INLINE V square(V r2) { return r2; }
  static LANESCAPE_INLINE V from_sigma(V square) { return square; }
  static LANESCAPE_INLINE V inverse(Mask in_range, V r2) { return masked_reciprocal(in_range, r2); }
};
template <>
struct PairUnit<FloatVector> {
  FloatVector sigma_squared, unit_squared;
  explicit PairUnit(const SinglePairParameters& p)
      : sigma_squared(broadcast<FloatVector>(p.sigma_squared)), unit_squared(broadcast<FloatVector>(p.unit_squared)) {}
  LANESCAPE_INLINE FloatVector square(FloatVector r2) const { return r2 * unit_squared; }
  // The inverse of square().
  LANESCAPE_INLINE FloatVector from_sigma(FloatVector square) const { return square * sigma_squared; }
  LANESCAPE_INLINE FloatVector inverse(FloatMask in_range, FloatVector r2) const {
    return masked_quotient(in_range, sigma_squared, r2);
  }
};

struct Totals {
  Vector energy = broadcast(0.0), virial = broadcast(0.0);
  Vector tensor[6] = {energy, energy, energy, energy, energy, energy};
};

template <class V>
LANESCAPE_INLINE V squared_length(const Vector3<V>& d) {
  return multiply_add(d.z, d.z, multiply_add(d.y, d.y, d.x * d.x));
}

// sum + w d
template <class V>
LANESCAPE_INLINE void add_scaled(Vector3<V>& sum, V w, const Vector3<V>& d) {
  sum = {multiply_add(w, d.x, sum.x), multiply_add(w, d.y, sum.y), multiply_add(w, d.z, sum.z)};
}

// sum - w d
template <class V>
LANESCAPE_INLINE void subtract_scaled(Vector3<V>& sum, V w, const Vector3<V>& d) {
  sum = {subtract_product(sum.x, w, d.x), subtract_product(sum.y, w, d.y), subtract_product(sum.z, w, d.z)};
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

// The sums over pairs of a list, in which each pair occurs twice: half of them.
template <Output output>
LANESCAPE_INLINE void store_half(const Totals& totals, PairOutput& out) {
  out.energy = 0.5 * reduce_add(totals.energy);
  out.virial = 0.5 * reduce_add(totals.virial);
  if constexpr (output == Output::stress)
    for (std::size_t k = 0; k < 6; ++k) out.virial_tensor[k] = 0.5 * reduce_add(totals.tensor[k]);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
