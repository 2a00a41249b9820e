// Tabulated potentials between states, cubic splines in r, at fixed probabilities, over neighbour lists as in loops/list.hpp. All
// pairs of states of a species pair use the same intervals, so one search serves them all and their coefficients are contiguous.

#include "kernel_declarations.hpp"
#include "state_pair.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
namespace {

// The states of a row and of its neighbours that one sweep over the neighbours handles, at most four each.
struct Sweep {
  std::size_t states;  // in total
  std::size_t first_row_state, row_states;
  std::size_t first_state, neighbour_states;
  const double* row_probabilities;  // of the row, from first_row_state on
  const double* quads;              // of the neighbours
};

struct Table {
  const double* records;  // of the sweep's first pair of states
  Vector per_unit, intervals, origin, cutoff_squared;
};

LANESCAPE_INLINE void gather_states(const Sweep& sweep, const std::uint32_t* offsets, Vector fourth, NeighbourStates& states) {
  if (sweep.states > 2) {
    gather_quads(sweep.quads, offsets, states.p[0], states.p[1], states.p[2], states.p[3]);
  } else {
    states.p[0] = sweep.states == 1 ? broadcast(1.0) : fourth;
    states.p[1] = broadcast(1.0) - states.p[0];
  }
}

template <Output output, bool masked>
LANESCAPE_INLINE void pair_vector(const double* points, const std::uint32_t* offsets, const Displacement& row, const Sweep& sweep,
                                  const Table& table, Mask valid, Vector* slopes, Displacement& g, StateTotals& totals) {
  const PairVector pair = pairs_of<masked>(points, offsets, row, table.cutoff_squared, valid);
  if (!any(pair.in_range)) return;
  NeighbourStates states;
  gather_states(sweep, offsets, pair.fourth, states);
  const Vector r = square_root(pair.r2);
  SplinePlace place;
  find_place(place, (r - table.origin) * table.per_unit, table.intervals, sweep.states * sweep.states);
  Vector force = broadcast(0.0);
  for (std::size_t a = 0; a < sweep.row_states; ++a) {
    const Vector p_a = broadcast(sweep.row_probabilities[a]);
    for (std::size_t b = 0; b < sweep.neighbour_states; ++b) {
      Vector c1, c2, c3, c0;
      gather_quads(table.records + point_width * (a * sweep.states + b), place, c1, c2, c3, c0);
      const Vector s = place.s, p_b = where(pair.in_range, states.p[b]);
      slopes[a] = multiply_add(p_b, spline_value(s, c1, c2, c3, c0), slopes[a]);
      if constexpr (output != Output::energy) force = multiply_add(p_a * p_b, spline_slope(s, c1, c2, c3), force);
    }
  }
  if constexpr (output != Output::energy) {
    const Vector w = broadcast(0.0) - force * table.per_unit * masked_reciprocal(pair.in_range, r);
    g = {multiply_add(w, pair.d.x, g.x), multiply_add(w, pair.d.y, g.y), multiply_add(w, pair.d.z, g.z)};
    totals.virial = multiply_add(w, pair.r2, totals.virial);
    if constexpr (output == Output::stress) add_tensor(totals, pair.d, w);
  }
}

template <Output output>
LANESCAPE_INLINE void one_sweep(const double* points, const std::uint32_t* offsets, std::size_t count, const Displacement& row,
                                const Sweep& sweep, const StateTable& u, double* slopes, Displacement& g, StateTotals& totals) {
  const Table table{u.spline.records + point_width * (sweep.first_row_state * sweep.states + sweep.first_state),
                    broadcast(u.spline.per_unit), broadcast(u.spline.intervals), broadcast(u.origin), broadcast(u.cutoff_squared)};
  Vector sums[4] = {broadcast(0.0), broadcast(0.0), broadcast(0.0), broadcast(0.0)};
  std::size_t j = 0;
  for (; j + lanes <= count; j += lanes) pair_vector<output, false>(points, offsets + j, row, sweep, table, {}, sums, g, totals);
  if (j < count)
    pair_vector<output, true>(points, offsets + j, row, sweep, table, lanes_below(static_cast<std::ptrdiff_t>(count - j)), sums, g,
                              totals);
  for (std::size_t a = 0; a < sweep.row_states; ++a) {
    totals.energy += broadcast(sweep.row_probabilities[a]) * sums[a];
    if (slopes) slopes[sweep.first_row_state + a] += reduce_add(sums[a]);
  }
}

std::size_t four_at_most(std::size_t n) { return n < 4 ? n : 4; }

template <Output output>
LANESCAPE_INLINE void one_segment(const StateTableInput& in, const StateTable& table, const std::uint32_t* offsets,
                                  std::size_t count, const Displacement& row, const double* p, double* slopes, Displacement& g,
                                  StateTotals& totals) {
  const std::size_t states = in.probabilities.states;
  for (std::size_t a = 0; a < states; a += 4)
    for (std::size_t b = 0; b < states; b += 4) {
      const Sweep sweep{states,
                        a,
                        four_at_most(states - a),
                        b,
                        four_at_most(states - b),
                        p + a,
                        in.probabilities.points + b / 4 * in.probabilities.group_stride};
      one_sweep<output>(in.list.points, offsets, count, row, sweep, table, slopes, g, totals);
    }
}

template <Output output>
void sum_list(const StateTableInput& in, double* gradient, double* slopes, PairOutput& out) {
  const NeighbourRows& list = in.list;
  const std::size_t states = in.probabilities.states;
  const std::uint32_t* offsets = list.neighbours;
  const std::uint32_t* length = list.lengths;
  const Vector zero = broadcast(0.0);
  StateTotals totals;
  for (std::size_t k = 0; k < list.row_count; ++k) {
    const Displacement row = row_position(list, k);
    Displacement g{zero, zero, zero};
    double* slope = slopes ? slopes + k * states : nullptr;
    for (std::size_t a = 0; slope && a < states; ++a) slope[a] = 0.0;
    for (std::size_t s = 0; s < list.species_count; ++s, ++length) {
      if (in.tables[s].cutoff_squared > 0.0)
        one_segment<output>(in, in.tables[s], offsets, *length, row, in.probabilities.rows + k * states, slope, g, totals);
      offsets += padded_length(*length);
    }
    if constexpr (output != Output::energy) store_point(gradient + point_width * k, g.x, g.y, g.z);
  }
  put_totals(totals, output == Output::stress, out);
}

}  // namespace

double state_table_energy(const StateTableInput& in) noexcept {
  PairOutput out;
  sum_list<Output::energy>(in, nullptr, nullptr, out);
  return out.energy;
}

void state_table_gradient(const StateTableInput& in, double* gradient, double* slopes, PairOutput& out) noexcept {
  sum_list<Output::gradient>(in, gradient, slopes, out);
}

void state_table_stress(const StateTableInput& in, double* gradient, double* slopes, PairOutput& out) noexcept {
  sum_list<Output::stress>(in, gradient, slopes, out);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
