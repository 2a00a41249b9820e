// Lennard-Jones mixtures over neighbour lists: the form for large systems. Each row's list holds all its neighbours, so that a
// pair is evaluated from both of its ends: nothing but the row's own gradient is written, rows can be shared out among threads
// in any way and no sum depends on it. The other form, each pair once, has to fetch and put back the gradients of eight
// scattered neighbours for every vector of pairs, which costs more than it saves (docs/PERFORMANCE.md).
//
// A neighbour is one load of four doubles; what a vector of pairs needs is turned into columns by seven shuffles. Images are
// points of their own, so that there is no nearest image to find and the box may be of any size.

#include "kernel_declarations.hpp"
#include "lj_pair.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
namespace {

enum class Output { energy, force, gradient, stress };

// How far ahead of its use a list that does not fit a cache is asked for; the processor's own look-ahead ends at each page.
constexpr std::size_t list_prefetch = 192;

// What is summed over the neighbours of one species of one row.
struct RowSums {
  Displacement gradient;
  PowerSums powers;
};

template <Output output, bool masked>
LANESCAPE_INLINE void pair_vector(const double* points, const std::uint32_t* offsets, const Displacement& row, const Potential& u,
                                  Mask valid, RowSums& sums, Totals& totals) {
  Displacement d;
  prefetch(offsets + list_prefetch);
  gather_points(points, offsets, d.x, d.y, d.z);
  d = {d.x - row.x, d.y - row.y, d.z - row.z};
  const Vector r2 = squared_length(d);
  Mask in_range = less(r2, u.cutoff_squared);
  if constexpr (masked) in_range = both(in_range, valid);
  const Vector inverse = masked_reciprocal(in_range, r2);
  const Vector rinv6 = inverse * inverse * inverse;
  if constexpr (output != Output::force) add_powers(sums.powers, rinv6, in_range);
  if constexpr (output != Output::energy) {
    const Vector w = force_over_r(u, inverse, rinv6);
    Displacement& g = sums.gradient;
    g = {multiply_add(w, d.x, g.x), multiply_add(w, d.y, g.y), multiply_add(w, d.z, g.z)};
    if constexpr (output == Output::stress) add_tensor(totals, d, w);
  }
}

template <Output output>
LANESCAPE_INLINE void all_rows(const LjListInput& in, double* gradient, Totals& totals) {
  const NeighbourRows& list = in.list;
  const std::uint32_t* offsets = list.neighbours;
  const std::uint32_t* length = list.lengths;
  const Vector zero = broadcast(0.0);
  for (std::size_t k = 0; k < list.row_count; ++k) {
    const double* point = list.points + list.rows[k];
    const Displacement row{broadcast(point[0]), broadcast(point[1]), broadcast(point[2])};
    RowSums sums{{zero, zero, zero}, {}};
    for (std::size_t s = 0; s < list.species_count; ++s, ++length) {
      const Potential u = broadcast_potential(in.pairs[s]);
      sums.powers = {};
      const std::size_t count = *length;
      std::size_t j = 0;
      for (; j + lanes <= count; j += lanes) pair_vector<output, false>(list.points, offsets + j, row, u, {}, sums, totals);
      if (j < count)
        pair_vector<output, true>(list.points, offsets + j, row, u, lanes_below(static_cast<std::ptrdiff_t>(count - j)), sums,
                                  totals);
      offsets += (count + slot_padding - 1) / slot_padding * slot_padding;
      if constexpr (output != Output::force) add_sums(totals, u, sums.powers);
    }
    if constexpr (output != Output::energy)
      store_point(gradient + point_width * k, sums.gradient.x, sums.gradient.y, sums.gradient.z);
  }
}

template <Output output>
void sum_list(const LjListInput& in, double* gradient, PairOutput& out) {
  Totals totals;
  all_rows<output>(in, gradient, totals);
  // Every pair was met from both ends.
  out.energy = 0.5 * reduce_add(totals.energy);
  out.virial = 0.5 * reduce_add(totals.virial);
  if constexpr (output == Output::stress)
    for (std::size_t k = 0; k < 6; ++k) out.virial_tensor[k] = 0.5 * reduce_add(totals.tensor[k]);
}

}  // namespace

double lj_list_energy(const LjListInput& in) noexcept {
  PairOutput out;
  sum_list<Output::energy>(in, nullptr, out);
  return out.energy;
}

void lj_list_force(const LjListInput& in, double* gradient) noexcept {
  Totals totals;
  all_rows<Output::force>(in, gradient, totals);
}

void lj_list_gradient(const LjListInput& in, double* gradient, PairOutput& out) noexcept {
  sum_list<Output::gradient>(in, gradient, out);
}

void lj_list_stress(const LjListInput& in, double* gradient, PairOutput& out) noexcept {
  sum_list<Output::stress>(in, gradient, out);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
