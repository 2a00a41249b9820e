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
    const Vector sixth = inverse * inverse * inverse;
    add_powers(sums.powers, sixth, in_range);
    if constexpr (output == Output::gradient) {
      const Vector w = pull(u, inverse, sixth);
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
    gradient[0] = sum_lanes(sums.gradient.x);
    gradient[1] = sum_lanes(sums.gradient.y);
    gradient[2] = sum_lanes(sums.gradient.z);
  }
  return sum_lanes(totals.energy);
}

}  // namespace

void lj_probe(const ProbeInput& in, const double* position, ProbeOutput& out) noexcept {
  out.energy = sum_probe<Output::gradient>(in, position, out.gradient);
}

void lj_probe_energies(const ProbeInput& in, const double* positions, std::size_t count, double* energies) noexcept {
  for (std::size_t k = 0; k < count; ++k) energies[k] = sum_probe<Output::energy>(in, positions + 3 * k, nullptr);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
