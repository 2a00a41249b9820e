// Local densities, and the forces that act by way of them: the first and the last pass over pairs of a state-probability
// interaction. As in lj_list.cpp each pair is met from both ends and only the row's own results are written.
//
// A switching function is a cubic spline in r^2: no root, no division, and 2 dw/d(r^2) is w'/r. Any function will do, and the force
// is the exact derivative of the density that is summed, so that energy is conserved to rounding.

#include "kernel_declarations.hpp"
#include "state_pair.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
namespace {

struct Switching {
  const double* records;
  Vector per_unit, intervals, cutoff_squared;
};

Switching broadcast_switching(const SwitchingSpline& w) {
  return {w.spline.records, broadcast(w.spline.per_unit), broadcast(w.spline.intervals), broadcast(w.cutoff_squared)};
}

template <bool masked>
LANESCAPE_INLINE Vector density_vector(const double* points, const std::uint32_t* places, const Displacement& row,
                                       const Switching& w, Mask valid) {
  Displacement d;
  gather_points(points, places, d.x, d.y, d.z);
  const Vector r2 = squared_length({d.x - row.x, d.y - row.y, d.z - row.z});
  Mask in_range = less(r2, w.cutoff_squared);
  if constexpr (masked) in_range = both(in_range, valid);
  SplinePlace place;
  find_place(place, r2 * w.per_unit, w.intervals, 1.0);
  return where(in_range, spline_value(w.records, place));
}

// 2 dw/d(r^2) = w'(r)/r.
LANESCAPE_INLINE Vector slope_over_r(const Switching& w, Vector r2, Mask in_range) {
  SplinePlace place;
  find_place(place, r2 * w.per_unit, w.intervals, 1.0);
  Vector b, c, d;
  gather_points(w.records, place.records, b, c, d);
  return where(in_range, spline_slope(place.s, b, c, d) * (w.per_unit + w.per_unit));
}

// One row's part in the densities of both ends of its pairs.
struct Multipliers {
  Vector own;   // dU/drho_i c_ij
  Vector back;  // c_ji
};

template <bool with_tensor, bool one_switching, bool masked>
LANESCAPE_INLINE void force_vector(const double* points, const std::uint32_t* places, const Displacement& row,
                                   const Switching& mine, const Switching& theirs, const Multipliers& multipliers, Mask valid,
                                   Displacement& g, Totals& totals) {
  const PairVector pair = pairs_of<masked>(points, places, row, mine.cutoff_squared, valid);
  const Displacement& d = pair.d;
  Vector pull;
  if constexpr (one_switching) {
    pull = multiply_add(pair.fourth, multipliers.back, multipliers.own) * slope_over_r(mine, pair.r2, pair.in_range);
  } else {
    Mask in_theirs = less(pair.r2, theirs.cutoff_squared);
    if constexpr (masked) in_theirs = both(in_theirs, valid);
    pull = multiply_add(pair.fourth * multipliers.back, slope_over_r(theirs, pair.r2, in_theirs),
                        multipliers.own * slope_over_r(mine, pair.r2, pair.in_range));
  }
  pull = broadcast(0.0) - pull;  // of a force, as -u'/r
  g = {multiply_add(pull, d.x, g.x), multiply_add(pull, d.y, g.y), multiply_add(pull, d.z, g.z)};
  totals.virial = multiply_add(pull, pair.r2, totals.virial);
  if constexpr (with_tensor) add_tensor(totals, d, pull);
}

template <bool with_tensor, bool one_switching>
LANESCAPE_INLINE void force_segment(const double* points, const std::uint32_t* places, std::size_t count, const Displacement& row,
                                    const Switching& mine, const Switching& theirs, const Multipliers& multipliers, Displacement& g,
                                    Totals& totals) {
  for_each_vector(
      count,
      [&](std::size_t j) {
        force_vector<with_tensor, one_switching, false>(points, places + j, row, mine, theirs, multipliers, {}, g, totals);
      },
      [&](std::size_t j, Mask valid) {
        force_vector<with_tensor, one_switching, true>(points, places + j, row, mine, theirs, multipliers, valid, g, totals);
      });
}

template <bool with_tensor>
void sum_forces(const StateDensityForceInput& in, double* gradient, LjOutput& out) {
  const NeighbourRows& list = in.list;
  const std::uint32_t* places = list.neighbours;
  const std::uint32_t* length = list.lengths;
  const Switching mine = broadcast_switching(in.switching);
  Totals totals;
  for (std::size_t k = 0; k < list.row_count; ++k) {
    const Displacement row = row_at(list, k);
    const double lambda = list.points[list.rows[k] + 3];
    const Vector zero = broadcast(0.0);
    Displacement g{zero, zero, zero};
    for (std::size_t s = 0; s < list.species_count; ++s, ++length) {
      const Multipliers multipliers{broadcast(lambda * in.filter[s]), broadcast(in.filter_back[s])};
      const SwitchingSpline& w = in.switchings[s];
      if (in.filter[s] == 0.0 && in.filter_back[s] == 0.0) {
        // neither end counts the other
      } else if (w.spline.records == in.switching.spline.records) {
        force_segment<with_tensor, true>(list.points, places, *length, row, mine, mine, multipliers, g, totals);
      } else {
        force_segment<with_tensor, false>(list.points, places, *length, row, mine, broadcast_switching(w), multipliers, g, totals);
      }
      places += padded_length(*length);
    }
    store_point(gradient + point_width * k, g.x, g.y, g.z);
  }
  put_totals(totals, with_tensor, out);
}

}  // namespace

void state_densities(const StateDensityInput& in, double* densities) noexcept {
  const NeighbourRows& list = in.list;
  const std::uint32_t* places = list.neighbours;
  const std::uint32_t* length = list.lengths;
  const Switching w = broadcast_switching(in.switching);
  for (std::size_t k = 0; k < list.row_count; ++k) {
    const Displacement row = row_at(list, k);
    double density = 0.0;
    for (std::size_t s = 0; s < list.species_count; ++s, ++length) {
      if (in.filter[s] != 0.0) {
        Vector sum = broadcast(0.0);
        for_each_vector(
            *length, [&](std::size_t j) { sum += density_vector<false>(list.points, places + j, row, w, {}); },
            [&](std::size_t j, Mask valid) { sum += density_vector<true>(list.points, places + j, row, w, valid); });
        density += in.filter[s] * sum_lanes(sum);
      }
      places += padded_length(*length);
    }
    densities[k] = density;
  }
}

void state_density_gradient(const StateDensityForceInput& in, double* gradient, LjOutput& out) noexcept {
  sum_forces<false>(in, gradient, out);
}

void state_density_stress(const StateDensityForceInput& in, double* gradient, LjOutput& out) noexcept {
  sum_forces<true>(in, gradient, out);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
