// Local densities, and the forces that act through them: the first and the last pass over pairs of a state-probability interaction.
// As in loops/list.hpp, each pair is visited from both ends and only the row's own results are written.
//
// A switching function is a cubic spline in r^2: it needs no root and no division, and 2 dw/d(r^2) is w'/r. Any function can be
// used. The force is the exact derivative of the summed density, so energy is conserved to rounding.

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

// In large systems the array of slopes is written to memory; this is how far ahead it is prefetched (saves 5 % of all passes).
constexpr std::size_t write_ahead = 128;

// Neighbours are processed in chunks of this size; those in range are packed before their densities are summed.
constexpr std::size_t chunk = 128;

// The first part of a pass: squared separations of the neighbours within any reach, packed.
struct Packed {
  alignas(array_alignment) double r2[chunk + lanes];
  std::size_t count = 0;
};

template <bool masked>
LANESCAPE_INLINE void pack_vector(const double* points, const std::uint32_t* offsets, const Displacement& row, Vector reach_squared,
                                  Mask valid, std::uint32_t* near, Packed& packed) {
  prefetch(offsets + list_prefetch);
  Displacement d;
  gather_points(points, offsets, d.x, d.y, d.z);
  const Vector r2 = squared_length(Displacement{d.x - row.x, d.y - row.y, d.z - row.z});
  Mask in_reach = less(r2, reach_squared);
  if constexpr (masked) in_reach = both(in_reach, valid);
  const unsigned chosen = bits(in_reach);
  compress_store(packed.r2 + packed.count, chosen, r2);
  packed.count += compress_store(near + packed.count, chosen, offsets);
}

// The density from a vector of neighbours; w'(r)/r of each is written to `slopes`.
LANESCAPE_INLINE Vector density_of(const Switching& w, Vector r2, Mask in_range, double* slopes) {
  SplinePlace place;
  find_place(place, r2 * w.per_unit, w.intervals, 1);
  Vector b, c, d, a;
  gather_quads(w.records, place, b, c, d, a);
  prefetch_for_write(slopes + write_ahead);
  // 2 dw/d(r^2) = w'(r)/r.
  store_unaligned(slopes, where(in_range, spline_slope(place.s, b, c, d) * (w.per_unit + w.per_unit)));
  return where(in_range, spline_value(place.s, b, c, d, a));
}

LANESCAPE_INLINE Vector sum_of_packed(const Switching& w, const Packed& packed, double* slopes) {
  Vector sum = broadcast(0.0);
  std::size_t j = 0;
  for (; j + lanes <= packed.count; j += lanes) {
    const Vector r2 = load(packed.r2 + j);
    sum += density_of(w, r2, less(r2, w.cutoff_squared), slopes + j);
  }
  if (j == packed.count) return sum;
  const Mask valid = lanes_below(static_cast<std::ptrdiff_t>(packed.count - j));
  const Vector r2 = where(valid, load(packed.r2 + j));
  return sum + density_of(w, r2, both(less(r2, w.cutoff_squared), valid), slopes + j);
}

// Output for the near neighbours of a segment.
struct Near {
  std::uint32_t* offsets;
  double* slopes;
  std::size_t count = 0;
};

// The density from `count` neighbours.
LANESCAPE_INLINE double one_segment(const double* points, const std::uint32_t* offsets, std::size_t count, const Displacement& row,
                                    const Switching& w, Vector reach_squared, Near& near) {
  Vector sum = broadcast(0.0);
  for (std::size_t first = 0; first < count; first += chunk) {
    const std::size_t here = count - first < chunk ? count - first : chunk;
    const std::uint32_t* from = offsets + first;
    std::uint32_t* to = near.offsets + near.count;
    Packed packed;
    std::size_t j = 0;
    for (; j + lanes <= here; j += lanes) pack_vector<false>(points, from + j, row, reach_squared, {}, to, packed);
    if (j < here)
      pack_vector<true>(points, from + j, row, reach_squared, lanes_below(static_cast<std::ptrdiff_t>(here - j)), to, packed);
    sum += sum_of_packed(w, packed, near.slopes + near.count);
    near.count += packed.count;
  }
  return reduce_add(sum);
}

// 2 dw/d(r^2) = w'(r)/r.
LANESCAPE_INLINE Vector slope_over_r(const Switching& w, Vector r2, Mask in_range) {
  SplinePlace place;
  find_place(place, r2 * w.per_unit, w.intervals, 1);
  Vector b, c, d;
  gather_points(w.records, place, b, c, d);
  return where(in_range, spline_slope(place.s, b, c, d) * (w.per_unit + w.per_unit));
}

// Weights of one row in the densities of both ends of its pairs.
struct Multipliers {
  Vector own;   // dU/drho_i c_ij
  Vector back;  // c_ji
};

// Sums of one row. They are copied to registers before a loop and back after it.
struct RowSums {
  Displacement g;
  Vector virial;
};

// one_switching: both ends use the same switching function, whose slopes are stored. Otherwise the other end has its own.
template <bool with_tensor, bool one_switching>
LANESCAPE_INLINE void force_segment(const double* points, const std::uint32_t* offsets, const double* slopes, std::size_t count,
                                    const Displacement& row, const Switching theirs, const Multipliers multipliers,
                                    RowSums& row_sums, StateTotals& totals) {
  RowSums sums = row_sums;
  for (std::size_t j = 0; j < count; j += lanes) {
    prefetch(offsets + j + list_prefetch);
    prefetch(slopes + j + list_prefetch);
    Displacement d;
    Vector lambda;
    gather_quads(points, offsets + j, d.x, d.y, d.z, lambda);
    d = {d.x - row.x, d.y - row.y, d.z - row.z};
    const Vector r2 = squared_length(d), mine = load(slopes + j);
    Vector slope;
    if constexpr (one_switching) {
      slope = multiply_add(lambda, multipliers.back, multipliers.own) * mine;
    } else {
      const Mask valid = lanes_below(static_cast<std::ptrdiff_t>(count - j));
      const Vector back = slope_over_r(theirs, r2, both(less(r2, theirs.cutoff_squared), valid));
      slope = multiply_add(lambda * multipliers.back, back, multipliers.own * mine);
    }
    const Vector w = broadcast(0.0) - slope;
    sums.g = {multiply_add(w, d.x, sums.g.x), multiply_add(w, d.y, sums.g.y), multiply_add(w, d.z, sums.g.z)};
    sums.virial = multiply_add(w, r2, sums.virial);
    if constexpr (with_tensor) add_tensor(totals, d, w);
  }
  row_sums = sums;
}

template <bool with_tensor>
void sum_forces(const StateDensityForceInput& in, double* gradient, PairOutput& out) {
  const NeighbourRows& list = in.list;
  const std::uint32_t* offsets = list.neighbours;
  const std::uint32_t* length = list.lengths;
  const double* slopes = in.slopes;
  StateTotals totals;
  for (std::size_t k = 0; k < list.row_count; ++k) {
    const Displacement row = row_position(list, k);
    const double lambda = list.points[list.rows[k] + 3];
    const Vector zero = broadcast(0.0);
    RowSums sums{{zero, zero, zero}, zero};
    for (std::size_t s = 0; s < list.species_count; ++s, ++length) {
      const Multipliers multipliers{broadcast(lambda * in.filter[s]), broadcast(in.filter_back[s])};
      const SwitchingSpline& w = in.switchings[s];
      if (in.filter[s] == 0.0 && in.filter_back[s] == 0.0) {
        // neither end counts the other
      } else if (w.spline.records == in.switching.spline.records) {
        force_segment<with_tensor, true>(list.points, offsets, slopes, *length, row, {}, multipliers, sums, totals);
      } else {
        force_segment<with_tensor, false>(list.points, offsets, slopes, *length, row, broadcast_switching(w), multipliers, sums,
                                          totals);
      }
      offsets += padded_length(*length);
      slopes += padded_length(*length);
    }
    store_point(gradient + point_width * k, sums.g.x, sums.g.y, sums.g.z);
    totals.virial += sums.virial;
  }
  put_totals(totals, with_tensor, out);
}

}  // namespace

void state_densities(const StateDensityInput& in, double* densities) noexcept {
  const NeighbourRows& list = in.list;
  const std::uint32_t* offsets = list.neighbours;
  const std::uint32_t* length = list.lengths;
  Near near{in.near, in.near_slopes};
  std::uint32_t* near_length = in.near_lengths;
  const Switching w = broadcast_switching(in.switching);
  for (std::size_t k = 0; k < list.row_count; ++k) {
    const Displacement row = row_position(list, k);
    double density = 0.0;
    for (std::size_t s = 0; s < list.species_count; ++s, ++length, ++near_length) {
      near.count = 0;
      const double sum = one_segment(list.points, offsets, *length, row, w, broadcast(in.reaches_squared[s]), near);
      density += in.filter[s] * sum;
      offsets += padded_length(*length);
      *near_length = static_cast<std::uint32_t>(near.count);
      const std::size_t end = padded_length(near.count);
      for (std::size_t j = near.count; j < end; ++j) near.offsets[j] = list.rows[k];
      near.offsets += end;
      near.slopes += end;
    }
    densities[k] = density;
  }
}

void state_density_gradient(const StateDensityForceInput& in, double* gradient, PairOutput& out) noexcept {
  sum_forces<false>(in, gradient, out);
}

void state_density_stress(const StateDensityForceInput& in, double* gradient, PairOutput& out) noexcept {
  sum_forces<true>(in, gradient, out);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
