// Lennard-Jones potentials between states, at fixed probabilities, over neighbour lists as in loops/list.hpp.
//
// All pairs of states share the powers of one distance. A row sums r^-6, r^-12 and 1 over its neighbours, weighted with the
// probability of each of their states; energy and dU/dp follow from these sums, once per row. The force on a pair needs one c12 and
// one c6, averaged over the states of both. Two states then cost only a few multiplications more than one.

#include "forms/lennard_jones.hpp"
#include "kernel_declarations.hpp"
#include "state_pair.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
namespace {

using PowerSums = LennardJones<Vector>::Sums;

// One row with the neighbours of one species: 12 c12 and 6 c6 for each neighbour state, averaged over the row's states.
struct Averaged {
  Vector twelve_c12[4], six_c6[4];
};

// Sums of powers, weighted with the probability of each state. With two states: the sums of the first state and of both.
struct StateSums {
  PowerSums of[4];
};

LANESCAPE_INLINE void add_weighted(PowerSums& sums, Vector p, Vector rinv6, Mask in_range) {
  const Vector weighted = p * rinv6;
  sums.rinv6 += weighted;
  sums.rinv12 = multiply_add(weighted, rinv6, sums.rinv12);
  sums.count += where(in_range, p);
}

template <StatesAtOnce n>
LANESCAPE_INLINE void add_states(StateSums& sums, const NeighbourStates& states, Vector rinv6, Mask in_range) {
  if constexpr (n == StatesAtOnce::four) {
    for (std::size_t b = 0; b < 4; ++b) add_weighted(sums.of[b], states.p[b], rinv6, in_range);
  } else {
    if constexpr (n == StatesAtOnce::two) add_weighted(sums.of[0], states.p[0], rinv6, in_range);
    LennardJones<Vector>::add_powers(sums.of[count_of(n) - 1], rinv6, in_range);
  }
}

// The average over a neighbour's states. With two states, `of_state` holds the difference (first minus second) and the second.
template <StatesAtOnce n>
LANESCAPE_INLINE Vector average(const Vector* of_state, const NeighbourStates& states) {
  if constexpr (n == StatesAtOnce::one) return of_state[0];
  if constexpr (n == StatesAtOnce::two) return multiply_add(states.p[0], of_state[0], of_state[1]);
  return multiply_add(states.p[0], of_state[0],
                      multiply_add(states.p[1], of_state[1], multiply_add(states.p[2], of_state[2], states.p[3] * of_state[3])));
}

template <Output output, StatesAtOnce n, bool masked>
LANESCAPE_INLINE void pair_vector(const double* points, const double* quads, const std::uint32_t* offsets, const Displacement& row,
                                  Vector cutoff_squared, const Averaged& averaged, Mask valid, StateSums& sums, Displacement& g,
                                  StateTotals& totals) {
  prefetch(offsets + list_prefetch);
  const PairVector pair = pairs_of<masked>(points, offsets, row, cutoff_squared, valid);
  NeighbourStates states{{pair.fourth, pair.fourth, pair.fourth, pair.fourth}};
  if constexpr (n == StatesAtOnce::four) gather_quads(quads, offsets, states.p[0], states.p[1], states.p[2], states.p[3]);
  const Vector inverse = masked_reciprocal(pair.in_range, pair.r2);
  const Vector rinv6 = inverse * inverse * inverse;
  add_states<n>(sums, states, rinv6, pair.in_range);
  if constexpr (output != Output::energy) {
    const Vector c12 = average<n>(averaged.twelve_c12, states), c6 = average<n>(averaged.six_c6, states);
    const Vector w = (multiply_add(c12, rinv6, broadcast(0.0) - c6) * rinv6) * inverse;
    g = {multiply_add(w, pair.d.x, g.x), multiply_add(w, pair.d.y, g.y), multiply_add(w, pair.d.z, g.z)};
    if constexpr (output == Output::stress) add_tensor(totals, pair.d, w);
  }
}

// The number of states, a compile-time constant for one or two.
template <StatesAtOnce n>
constexpr std::size_t known(std::size_t states) {
  return n == StatesAtOnce::four ? states : count_of(n);
}

// For the states [first, first + n) of a neighbour.
template <StatesAtOnce n>
LANESCAPE_INLINE Averaged average_over_row(const StateLjPair* pairs, const double* p, std::size_t states, std::size_t first) {
  double c12[4] = {}, c6[4] = {};
  for (std::size_t b = 0; b < count_of(n) && first + b < states; ++b)
    for (std::size_t a = 0; a < states; ++a) {
      c12[b] += p[a] * pairs[a * states + first + b].c12;
      c6[b] += p[a] * pairs[a * states + first + b].c6;
    }
  Averaged averaged;
  for (std::size_t b = 0; b < 4; ++b) {
    averaged.twelve_c12[b] = broadcast(12.0 * c12[b]);
    averaged.six_c6[b] = broadcast(6.0 * c6[b]);
  }
  return averaged;
}

// Adds what follows from the sums over one species' neighbours: energy, virial and, if wanted, dU/dp of each of the row's states.
// With one state the result equals that of loops/list.hpp to the bit. With more states the lanes are summed first, which is less
// work.
LANESCAPE_INLINE void add_one_state(const StateLjPair& u, double p, const Averaged& averaged, const PowerSums& s, double* slopes,
                                    StateTotals& totals) {
  totals.virial += multiply_add(averaged.twelve_c12[0], s.rinv12, broadcast(0.0) - averaged.six_c6[0] * s.rinv6);
  const Vector slope = multiply_add(broadcast(u.c12), s.rinv12,
                                    broadcast(0.0) - multiply_add(broadcast(u.c6), s.rinv6, broadcast(u.shift) * s.count));
  totals.energy += broadcast(p) * slope;
  if (slopes) slopes[0] += reduce_add(slope);
}

template <StatesAtOnce n>
LANESCAPE_INLINE void add_segment(const StateLjPair* pairs, const double* p, std::size_t states, std::size_t first,
                                  const StateSums& sums, double* slopes, double& energy, double& virial) {
  alignas(array_alignment) double s[4][point_width];  // r^-6, r^-12, 1
  for (std::size_t b = 0; b < count_of(n); ++b) store_point(s[b], sums.of[b].rinv6, sums.of[b].rinv12, sums.of[b].count);
  for (std::size_t a = 0; a < states; ++a) {
    double rinv6 = 0.0, rinv12 = 0.0, shift = 0.0;
    for (std::size_t b = 0; b < count_of(n) && first + b < states; ++b) {
      const StateLjPair& u = pairs[a * states + first + b];
      rinv6 += u.c6 * s[b][0];
      rinv12 += u.c12 * s[b][1];
      shift += u.shift * s[b][2];
    }
    const double slope = rinv12 - (rinv6 + shift);
    energy += p[a] * slope;
    virial += p[a] * (12.0 * rinv12 - 6.0 * rinv6);
    if (slopes) slopes[a] += slope;
  }
}

template <Output output, StatesAtOnce n>
LANESCAPE_INLINE void one_segment(const StateLjInput& in, std::size_t species, const std::uint32_t* offsets, std::size_t count,
                                  const Displacement& row, const double* p, std::size_t group, Displacement& g, double* slopes,
                                  StateTotals& totals) {
  const std::size_t states = known<n>(in.probabilities.states), first = n == StatesAtOnce::four ? group * count_of(n) : 0;
  const StateLjPair* pairs = in.pairs + species * states * states;
  const double *points = in.list.points, *quads = in.probabilities.points + group * in.probabilities.group_stride;
  const Vector cutoff_squared = broadcast(in.cutoffs_squared[species]);
  const Averaged averaged = average_over_row<n>(pairs, p, states, first);
  Averaged of_pairs = averaged;
  if constexpr (n == StatesAtOnce::two) {
    of_pairs.twelve_c12[0] = averaged.twelve_c12[0] - averaged.twelve_c12[1];
    of_pairs.six_c6[0] = averaged.six_c6[0] - averaged.six_c6[1];
  }
  StateSums sums;
  Displacement sum = g;
  std::size_t j = 0;
  for (; j + lanes <= count; j += lanes)
    pair_vector<output, n, false>(points, quads, offsets + j, row, cutoff_squared, of_pairs, {}, sums, sum, totals);
  if (j < count)
    pair_vector<output, n, true>(points, quads, offsets + j, row, cutoff_squared, of_pairs,
                                 lanes_below(static_cast<std::ptrdiff_t>(count - j)), sums, sum, totals);
  g = sum;
  if constexpr (n == StatesAtOnce::two) {
    const PowerSums &one = sums.of[0], all = sums.of[1];
    sums.of[1] = {all.rinv6 - one.rinv6, all.rinv12 - one.rinv12, all.count - one.count};
  }
  if constexpr (n == StatesAtOnce::one)
    add_one_state(pairs[0], p[0], averaged, sums.of[0], slopes, totals);
  else
    add_segment<n>(pairs, p, states, first, sums, slopes, totals.rows_energy, totals.rows_virial);
}

template <Output output, StatesAtOnce n>
void all_rows(const StateLjInput& in, double* gradient, double* slopes, StateTotals& totals) {
  const NeighbourRows& list = in.list;
  const std::size_t states = known<n>(in.probabilities.states), groups = (states + count_of(n) - 1) / count_of(n);
  const std::uint32_t* offsets = list.neighbours;
  const std::uint32_t* length = list.lengths;
  const Vector zero = broadcast(0.0);
  for (std::size_t k = 0; k < list.row_count; ++k, length += list.species_count) {
    const Displacement row = row_position(list, k);
    Displacement g{zero, zero, zero};
    double* slope = slopes ? slopes + k * states : nullptr;
    for (std::size_t a = 0; slope && a < states; ++a) slope[a] = 0.0;
    const std::uint32_t* end = offsets;
    for (std::size_t group = 0; group < groups; ++group) {
      end = offsets;
      for (std::size_t s = 0; s < list.species_count; ++s) {
        if (in.cutoffs_squared[s] > 0.0)
          one_segment<output, n>(in, s, end, length[s], row, in.probabilities.rows + k * states, group, g, slope, totals);
        end += padded_length(length[s]);
      }
    }
    offsets = end;
    if constexpr (output != Output::energy) store_point(gradient + point_width * k, g.x, g.y, g.z);
  }
}

template <Output output>
void sum_list(const StateLjInput& in, double* gradient, double* slopes, PairOutput& out) {
  StateTotals totals;
  switch (in.probabilities.states) {
    case 1:
      all_rows<output, StatesAtOnce::one>(in, gradient, slopes, totals);
      break;
    case 2:
      all_rows<output, StatesAtOnce::two>(in, gradient, slopes, totals);
      break;
    default:
      all_rows<output, StatesAtOnce::four>(in, gradient, slopes, totals);
  }
  put_totals(totals, output == Output::stress, out);
}

}  // namespace

double state_lj_energy(const StateLjInput& in) noexcept {
  PairOutput out;
  sum_list<Output::energy>(in, nullptr, nullptr, out);
  return out.energy;
}

void state_lj_gradient(const StateLjInput& in, double* gradient, double* slopes, PairOutput& out) noexcept {
  sum_list<Output::gradient>(in, gradient, slopes, out);
}

void state_lj_stress(const StateLjInput& in, double* gradient, double* slopes, PairOutput& out) noexcept {
  sum_list<Output::stress>(in, gradient, slopes, out);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
