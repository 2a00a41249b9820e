#pragma once

#include "loops/neighbour_rows.hpp"

// Shared by the kernels of state-probability interactions.
namespace lanescape::kernels::LANESCAPE_ISA {

// How many states of its neighbours a kernel sums over at once. The probability of a single state is 1. With two states, the first
// probability is stored with the point. With more, records hold four probabilities each, and there is one sweep per four states.
enum class StatesAtOnce { one, two, four };
constexpr std::size_t count_of(StatesAtOnce n) { return n == StatesAtOnce::one ? 1 : n == StatesAtOnce::two ? 2 : 4; }

// Probabilities of one vector of neighbours.
struct NeighbourStates {
  Vector p[4];
};

// One vector of neighbours of a row: separations r_j - r_i, their squares, and which lanes are within the cutoff.
struct PairVector {
  Displacement d;
  Vector r2, fourth;
  Mask in_range;
};

template <bool masked>
LANESCAPE_INLINE PairVector pairs_of(const double* points, const std::uint32_t* offsets, const Displacement& row,
                                     Vector cutoff_squared, Mask valid) {
  PairVector pair;
  Displacement& d = pair.d;
  gather_quads(points, offsets, d.x, d.y, d.z, pair.fourth);
  d = {d.x - row.x, d.y - row.y, d.z - row.z};
  pair.r2 = squared_length(d);
  pair.in_range = less(pair.r2, cutoff_squared);
  if constexpr (masked) pair.in_range = both(pair.in_range, valid);
  return pair;
}

LANESCAPE_INLINE Vector where(Mask m, Vector v) { return select(m, v, broadcast(0.0)); }

// Where an argument lies in a spline: offsets of the intervals' first records, and the position within the interval.
struct SplinePlace {
  WholeLanes offsets;  // of the first record of each lane's interval
  Vector s;
  std::uint32_t operator[](std::size_t lane) const { return offsets[lane]; }
};

// `x` is in units of intervals; values not below their number, and NaN, map to the end. `width`: records per interval.
LANESCAPE_INLINE void find_place(SplinePlace& place, Vector x, Vector intervals, std::size_t width) {
  x = select(less(x, intervals), x, intervals);
  // A knot may be the end of one interval or the start of the next: the spline has the same value in both.
  place.s = x - store_nearest_whole(place.offsets, x - broadcast(0.5), static_cast<double>(width * point_width));
}

LANESCAPE_INLINE Vector spline_value(Vector s, Vector b, Vector c, Vector d, Vector a) {
  return multiply_add(s, multiply_add(s, multiply_add(s, d, c), b), a);
}

// Derivative with respect to the argument in intervals.
LANESCAPE_INLINE Vector spline_slope(Vector s, Vector b, Vector c, Vector d) {
  return multiply_add(s, multiply_add(s * broadcast(3.0), d, c + c), b);
}

// Sums per lane, and sums per row.
struct StateTotals : Totals {
  double rows_energy = 0.0, rows_virial = 0.0;
};

// Halves the sums, because every pair was visited from both ends.
inline void put_totals(const StateTotals& totals, bool with_tensor, PairOutput& out) {
  out.energy = 0.5 * (reduce_add(totals.energy) + totals.rows_energy);
  out.virial = 0.5 * (reduce_add(totals.virial) + totals.rows_virial);
  if (with_tensor)
    for (std::size_t k = 0; k < 6; ++k) out.virial_tensor[k] = 0.5 * reduce_add(totals.tensor[k]);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
