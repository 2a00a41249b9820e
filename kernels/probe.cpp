// What a particle that is not there yet would feel: the sums over its neighbours of one Lennard-Jones species each, from cells
// whose points lie side by side. For insertion and for chemical potentials, one probe after the other.

#include "grid_columns.hpp"
#include "kernel_declarations.hpp"
#include "lj_pair.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
namespace {

enum class Output { energy, gradient };

struct ProbeSums {
  Displacement gradient{broadcast(0.0), broadcast(0.0), broadcast(0.0)};
  PowerSums powers;
};

// The points [begin, end) of one species.
template <Output output>
LANESCAPE_INLINE void add_run(const ProbeSpecies& points, const Displacement& probe, const Potential& u, std::uint32_t begin,
                              std::uint32_t end, ProbeSums& sums) {
  for (std::uint32_t k = begin; k < end; k += lanes) {
    // Of the probe less the point, so that the pull of a pair adds to the probe's force.
    const Displacement d{probe.x - load_anywhere(points.x + k), probe.y - load_anywhere(points.y + k),
                         probe.z - load_anywhere(points.z + k)};
    const Vector r2 = squared_length(d);
    const Mask in_range = both(less(r2, u.cutoff_squared), lanes_below(static_cast<std::ptrdiff_t>(end - k)));
    const Vector inverse = masked_reciprocal(in_range, r2);
    const Vector rinv6 = inverse * inverse * inverse;
    add_powers(sums.powers, rinv6, in_range);
    if constexpr (output == Output::gradient) {
      const Vector w = force_over_r(u, inverse, rinv6);
      Displacement& g = sums.gradient;
      g = {subtract_product(g.x, w, d.x), subtract_product(g.y, w, d.y), subtract_product(g.z, w, d.z)};
    }
  }
}

template <Output output>
LANESCAPE_INLINE double sum_probe(const ProbeInput& in, const double* position, double* gradient) {
  const Displacement probe{broadcast(position[0]), broadcast(position[1]), broadcast(position[2])};
  Totals totals;
  ProbeSums sums;
  for (std::size_t s = 0; s < in.species_count; ++s) {
    const ProbeSpecies& points = in.species[s];
    const Potential u = broadcast_potential(points.pair);
    const double cutoff = std::sqrt(points.pair.cutoff_squared);
    sums.powers = {};
    for_each_column(points, position, cutoff + grid_margin(points, cutoff),
                    [&](std::size_t column, std::size_t low, std::size_t high) {
                      const std::uint32_t* first = points.first + column * (points.cells[2] + 1);
                      add_run<output>(points, probe, u, first[low], first[high + 1], sums);
                      return true;
                    });
    add_sums(totals, u, sums.powers);
  }
  if constexpr (output == Output::gradient) {
    gradient[0] = reduce_add(sums.gradient.x);
    gradient[1] = reduce_add(sums.gradient.y);
    gradient[2] = reduce_add(sums.gradient.z);
  }
  return reduce_add(totals.energy);
}

// Whether no point of a species is nearer than `reach`. The position's own column comes first: what is too near is mostly there.
bool is_clear(const ProbeSpecies& points, double reach, const double* position) noexcept {
  const Vector x = broadcast(position[0]), y = broadcast(position[1]), z = broadcast(position[2]);
  const Vector limit = broadcast(reach * reach);
  const std::size_t low_z = cell_along(points, 2, position[2] - reach), high_z = cell_along(points, 2, position[2] + reach);
  const auto column_is_clear = [&](std::size_t cx, std::size_t cy) {
    const std::uint32_t* first = points.first + (cx * points.cells[1] + cy) * (points.cells[2] + 1);
    const std::uint32_t end = first[high_z + 1];
    for (std::uint32_t k = first[low_z]; k < end; k += lanes) {
      const Displacement d{x - load_anywhere(points.x + k), y - load_anywhere(points.y + k), z - load_anywhere(points.z + k)};
      if (any(both(less(squared_length(d), limit), lanes_below(static_cast<std::ptrdiff_t>(end - k))))) return false;
    }
    return true;
  };
  const std::size_t own_x = cell_along(points, 0, position[0]), own_y = cell_along(points, 1, position[1]);
  if (!column_is_clear(own_x, own_y)) return false;
  const std::size_t last_x = cell_along(points, 0, position[0] + reach), last_y = cell_along(points, 1, position[1] + reach);
  for (std::size_t cx = cell_along(points, 0, position[0] - reach); cx <= last_x; ++cx)
    for (std::size_t cy = cell_along(points, 1, position[1] - reach); cy <= last_y; ++cy)
      if ((cx != own_x || cy != own_y) && !column_is_clear(cx, cy)) return false;
  return true;
}

}  // namespace

std::size_t lj_probe_first_clear(const ProbeInput& in, const double* clearances, const double* positions,
                                 std::size_t count) noexcept {
  for (std::size_t k = 0; k < count; ++k) {
    bool clear = true;
    for (std::size_t s = 0; s < in.species_count && clear; ++s) clear = is_clear(in.species[s], clearances[s], positions + 3 * k);
    if (clear) return k;
  }
  return count;
}

void lj_probe(const ProbeInput& in, const double* position, ProbeOutput& out) noexcept {
  out.energy = sum_probe<Output::gradient>(in, position, out.gradient);
}

void lj_probe_energies(const ProbeInput& in, const double* positions, std::size_t count, double* energies) noexcept {
  for (std::size_t k = 0; k < count; ++k) energies[k] = sum_probe<Output::energy>(in, positions + 3 * k, nullptr);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
