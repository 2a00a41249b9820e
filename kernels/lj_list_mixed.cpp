// Lennard-Jones mixtures over neighbour lists in mixed precision: pairs in single precision, sums in double; otherwise lj_list.cpp.
//
// What single precision would lose first is the difference of two large coordinates. Here they are integers in a unit of about
// 2^-28 sigma: the difference is exact, and rounded once, to 2^-24 of itself, in any box. r^-13 makes thirteen times that of it.

#include "kernel_declarations.hpp"
#include "lj_pair.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
namespace {

enum class Output { energy, force, gradient };

// As in lj_list.cpp.
constexpr std::size_t list_prefetch = 192;

struct FloatDisplacement {
  FloatVector x, y, z;
};

struct FloatPotential {
  FloatVector twelve_c12, minus_six_c6, cutoff_squared, sigma_squared;
};

LANESCAPE_INLINE FloatPotential broadcast_single(const LjSinglePair& p) {
  return {broadcast_float(p.twelve_c12), broadcast_float(p.minus_six_c6), broadcast_float(p.cutoff_squared),
          broadcast_float(p.sigma_squared)};
}

// Sums over the neighbours of one row, of one species those of powers, in single precision: at a cutoff of 2.5 sigma each of
// sixteen lanes adds half a dozen numbers, of SSE2's four two dozen, before it is turned into double. Turning the terms themselves
// instead leaves the worst error of a force at 6e-7 to 7e-7 and that of an energy as it is, for it is the pairs' own rounding; it
// took about 1.3 to 1.7 times as long (4000 particles, AVX-512, Zen 4, separate runs on a busy machine).
struct FloatPowerSums {
  FloatVector rinv6 = broadcast_float(0.0F), rinv12 = rinv6, count = rinv6;
};

struct RowSums {
  FloatDisplacement gradient;
  FloatPowerSums powers;
};

template <Output output>
LANESCAPE_INLINE void pair_vector(const std::int32_t* points, const std::uint32_t* offsets, const std::int32_t* row,
                                  const FloatPotential& u, FloatMask valid, RowSums& sums) {
  FloatDisplacement d;
  prefetch(offsets + list_prefetch);
  gather_differences(points, offsets, row, d.x, d.y, d.z);
  const FloatVector r2 = square_plus(d.z, square_plus(d.y, multiply(d.x, d.x)));
  const FloatMask in_range = both(valid, less(r2, u.cutoff_squared));
  const FloatVector inverse = masked_quotient(in_range, u.sigma_squared, r2);
  const FloatVector rinv6 = multiply(multiply(inverse, inverse), inverse);
  if constexpr (output != Output::force) {
    FloatPowerSums& powers = sums.powers;
    powers.rinv6 = add(powers.rinv6, rinv6);
    powers.rinv12 = multiply_add(rinv6, rinv6, powers.rinv12);
    powers.count = masked_increment(powers.count, in_range);
  }
  if constexpr (output != Output::energy) {
    const FloatVector w = multiply(multiply(multiply_add(u.twelve_c12, rinv6, u.minus_six_c6), rinv6), inverse);
    FloatDisplacement& g = sums.gradient;
    g = {multiply_add(w, d.x, g.x), multiply_add(w, d.y, g.y), multiply_add(w, d.z, g.z)};
  }
}

template <Output output>
LANESCAPE_INLINE void all_rows(const LjListInput& in, double* gradient, Totals& totals) {
  const NeighbourRows& list = in.list;
  const std::uint32_t* offsets = list.neighbours;
  const std::uint32_t* length = list.lengths;
  const FloatVector zero = broadcast_float(0.0F);
  const Vector unit = broadcast(list.fixed_unit);
  for (std::size_t k = 0; k < list.row_count; ++k) {
    const std::int32_t* row = list.fixed_points + list.rows[k];
    RowSums sums{{zero, zero, zero}, {}};
    for (std::size_t s = 0; s < list.species_count; ++s, ++length) {
      sums.powers = {};
      const FloatPotential u = broadcast_single(in.single_pairs[s]);
      const std::size_t count = *length;
      for (std::size_t j = 0; j < count; j += float_lanes)
        pair_vector<output>(list.fixed_points, offsets + j, row, u, float_lanes_below(count - j), sums);
      offsets += (count + slot_padding - 1) / slot_padding * slot_padding;
      if constexpr (output != Output::force) {
        const PowerSums powers{add_halves(sums.powers.rinv6), add_halves(sums.powers.rinv12), add_halves(sums.powers.count)};
        add_sums(totals, broadcast_potential(in.pairs[s]), powers);
      }
    }
    if constexpr (output != Output::energy)
      store_point(gradient + point_width * k, unit * add_halves(sums.gradient.x), unit * add_halves(sums.gradient.y),
                  unit * add_halves(sums.gradient.z));
  }
}

}  // namespace

double lj_list_energy_mixed(const LjListInput& in) noexcept {
  Totals totals;
  all_rows<Output::energy>(in, nullptr, totals);
  return 0.5 * reduce_add(totals.energy);
}

void lj_list_force_mixed(const LjListInput& in, double* gradient) noexcept {
  Totals totals;
  all_rows<Output::force>(in, gradient, totals);
}

void lj_list_gradient_mixed(const LjListInput& in, double* gradient, PairOutput& out) noexcept {
  Totals totals;
  all_rows<Output::gradient>(in, gradient, totals);
  // Every pair was met from both ends.
  out.energy = 0.5 * reduce_add(totals.energy);
  out.virial = 0.5 * reduce_add(totals.virial);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
