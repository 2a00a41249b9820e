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

// How many neighbours are looked at before what is in range of them is counted.
constexpr std::size_t chunk = 128;

// The first part of a pass: squared separations of what is in range of the switching function, packed, and places of what is within
// reach of anything.
struct Packed {
  alignas(array_alignment) double r2[chunk + lanes];
  std::size_t in_range = 0, in_reach = 0;
};

template <bool masked>
LANESCAPE_INLINE void pack_vector(const double* points, const std::uint32_t* places, const Displacement& row, Vector cutoff_squared,
                                  Vector reach_squared, Mask valid, std::uint32_t* near, Packed& packed) {
  prefetch(places + list_prefetch);
  Displacement d;
  gather_points(points, places, d.x, d.y, d.z);
  const Vector r2 = squared_length({d.x - row.x, d.y - row.y, d.z - row.z});
  Mask in_range = less(r2, cutoff_squared), in_reach = less(r2, reach_squared);
  if constexpr (masked) {
    in_range = both(in_range, valid);
    in_reach = both(in_reach, valid);
  }
  packed.in_range += store_chosen(packed.r2 + packed.in_range, bits(in_range), r2);
  packed.in_reach += store_chosen(near + packed.in_reach, bits(in_reach), places);
}

LANESCAPE_INLINE Vector value_at(const Switching& w, Vector r2) {
  SplinePlace place;
  find_place(place, r2 * w.per_unit, w.intervals, 1);
  return spline_value(w.records, place);
}

LANESCAPE_INLINE Vector sum_of_packed(const Switching& w, const Packed& packed) {
  Vector sum = broadcast(0.0);
  std::size_t j = 0;
  for (; j + lanes <= packed.in_range; j += lanes) sum += value_at(w, load(packed.r2 + j));
  const Mask valid = lanes_below(static_cast<std::ptrdiff_t>(packed.in_range - j));
  if (j < packed.in_range) sum += where(valid, value_at(w, where(valid, load(packed.r2 + j))));
  return sum;
}

// The density that `count` neighbours make; their places within reach go to `near`, and how many.
LANESCAPE_INLINE double one_segment(const double* points, const std::uint32_t* places, std::size_t count, const Displacement& row,
                                    const Switching& w, Vector cutoff_squared, Vector reach_squared, std::uint32_t* near,
                                    std::size_t& in_reach) {
  Vector sum = broadcast(0.0);
  in_reach = 0;
  for (std::size_t first = 0; first < count; first += chunk) {
    const std::size_t here = count - first < chunk ? count - first : chunk;
    const std::uint32_t* from = places + first;
    std::uint32_t* to = near + in_reach;
    Packed packed;
    std::size_t j = 0;
    for (; j + lanes <= here; j += lanes) pack_vector<false>(points, from + j, row, cutoff_squared, reach_squared, {}, to, packed);
    if (j < here)
      pack_vector<true>(points, from + j, row, cutoff_squared, reach_squared, lanes_below(static_cast<std::ptrdiff_t>(here - j)),
                        to, packed);
    in_reach += packed.in_reach;
    sum += sum_of_packed(w, packed);
  }
  return sum_lanes(sum);
}

// 2 dw/d(r^2) = w'(r)/r.
LANESCAPE_INLINE Vector slope_over_r(const Switching& w, Vector r2, Mask in_range) {
  SplinePlace place;
  find_place(place, r2 * w.per_unit, w.intervals, 1);
  Vector b, c, d;
  gather_points(w.records, place, b, c, d);
  return where(in_range, spline_slope(place.s, b, c, d) * (w.per_unit + w.per_unit));
}

// One row's part in the densities of both ends of its pairs.
struct Multipliers {
  Vector own;   // dU/drho_i c_ij
  Vector back;  // c_ji
};

// The first part of a pass: separations in columns. What follows from them is a chain so long that it keeps the processor waiting
// where it comes right after each fetch.
struct Separations {
  Vector x[chunk / lanes], y[chunk / lanes], z[chunk / lanes], r2[chunk / lanes], fourth[chunk / lanes];
};

LANESCAPE_INLINE void fetch(const double* points, const std::uint32_t* places, std::size_t vectors, const Displacement& row,
                            Separations& separations) {
  for (std::size_t k = 0; k < vectors; ++k) {
    prefetch(places + lanes * k + list_prefetch);
    Displacement d;
    gather_quads(points, places + lanes * k, d.x, d.y, d.z, separations.fourth[k]);
    separations.x[k] = d.x = d.x - row.x;
    separations.y[k] = d.y = d.y - row.y;
    separations.z[k] = d.z = d.z - row.z;
    separations.r2[k] = squared_length(d);
  }
}

// -u'/r of a vector of pairs, had they an energy.
template <bool one_switching>
LANESCAPE_INLINE Vector pull_of(Vector r2, Vector fourth, const Switching& mine, const Switching& theirs,
                                const Multipliers& multipliers, Mask valid) {
  const Mask in_range = both(less(r2, mine.cutoff_squared), valid);
  if constexpr (one_switching)
    return broadcast(0.0) - multiply_add(fourth, multipliers.back, multipliers.own) * slope_over_r(mine, r2, in_range);
  const Mask in_theirs = both(less(r2, theirs.cutoff_squared), valid);
  return broadcast(0.0) - multiply_add(fourth * multipliers.back, slope_over_r(theirs, r2, in_theirs),
                                       multipliers.own * slope_over_r(mine, r2, in_range));
}

// What one row gets. Copied to registers for a loop and back after it.
struct RowSums {
  Displacement g;
  Vector virial;
};

template <bool with_tensor, bool one_switching>
LANESCAPE_INLINE void force_segment(const double* points, const std::uint32_t* places, std::size_t count, const Displacement& row,
                                    const Switching mine, const Switching theirs, const Multipliers multipliers, RowSums& row_sums,
                                    StateTotals& totals) {
  RowSums sums = row_sums;
  for (std::size_t first = 0; first < count; first += chunk) {
    const std::size_t here = count - first < chunk ? count - first : chunk, vectors = (here + lanes - 1) / lanes;
    Separations separations;
    fetch(points, places + first, vectors, row, separations);
    for (std::size_t k = 0; k < vectors; ++k) {
      const Displacement d{separations.x[k], separations.y[k], separations.z[k]};
      const Vector r2 = separations.r2[k];
      const Mask valid = lanes_below(static_cast<std::ptrdiff_t>(here - lanes * k));
      const Vector pull = pull_of<one_switching>(r2, separations.fourth[k], mine, theirs, multipliers, valid);
      sums.g = {multiply_add(pull, d.x, sums.g.x), multiply_add(pull, d.y, sums.g.y), multiply_add(pull, d.z, sums.g.z)};
      sums.virial = multiply_add(pull, r2, sums.virial);
      if constexpr (with_tensor) add_tensor(totals, d, pull);
    }
  }
  row_sums = sums;
}

template <bool with_tensor>
void sum_forces(const StateDensityForceInput& in, double* gradient, LjOutput& out) {
  const NeighbourRows& list = in.list;
  const std::uint32_t* places = list.neighbours;
  const std::uint32_t* length = list.lengths;
  const Switching mine = broadcast_switching(in.switching);
  StateTotals totals;
  for (std::size_t k = 0; k < list.row_count; ++k) {
    const Displacement row = row_at(list, k);
    const double lambda = list.points[list.rows[k] + 3];
    const Vector zero = broadcast(0.0);
    RowSums sums{{zero, zero, zero}, zero};
    for (std::size_t s = 0; s < list.species_count; ++s, ++length) {
      const Multipliers multipliers{broadcast(lambda * in.filter[s]), broadcast(in.filter_back[s])};
      const SwitchingSpline& w = in.switchings[s];
      if (in.filter[s] == 0.0 && in.filter_back[s] == 0.0) {
        // neither end counts the other
      } else if (w.spline.records == in.switching.spline.records) {
        force_segment<with_tensor, true>(list.points, places, *length, row, mine, mine, multipliers, sums, totals);
      } else {
        force_segment<with_tensor, false>(list.points, places, *length, row, mine, broadcast_switching(w), multipliers, sums,
                                          totals);
      }
      places += padded_length(*length);
    }
    store_point(gradient + point_width * k, sums.g.x, sums.g.y, sums.g.z);
    totals.virial += sums.virial;
  }
  put_totals(totals, with_tensor, out);
}

}  // namespace

void state_densities(const StateDensityInput& in, double* densities) noexcept {
  const NeighbourRows& list = in.list;
  const std::uint32_t* places = list.neighbours;
  const std::uint32_t* length = list.lengths;
  std::uint32_t *near = in.near, *near_length = in.near_lengths;
  const Switching w = broadcast_switching(in.switching);
  for (std::size_t k = 0; k < list.row_count; ++k) {
    const Displacement row = row_at(list, k);
    double density = 0.0;
    for (std::size_t s = 0; s < list.species_count; ++s, ++length, ++near_length) {
      // What does not count is out of range.
      const Vector cutoff_squared = in.filter[s] == 0.0 ? broadcast(0.0) : w.cutoff_squared;
      std::size_t in_reach;
      const double sum =
          one_segment(list.points, places, *length, row, w, cutoff_squared, broadcast(in.reaches_squared[s]), near, in_reach);
      density += in.filter[s] * sum;
      places += padded_length(*length);
      *near_length = static_cast<std::uint32_t>(in_reach);
      for (const std::size_t end = padded_length(in_reach); in_reach < end; ++in_reach) near[in_reach] = list.rows[k];
      near += in_reach;
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
