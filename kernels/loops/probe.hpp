#pragma once

#include "grid_columns.hpp"
#include "loops/pair_vector.hpp"

// What a particle that is not in the fluid would feel: the sums over its neighbours of one species each, from cells whose points
// lie side by side. For insertion and for chemical potentials, one probe after the other.
namespace lanescape::kernels::LANESCAPE_ISA {

template <class Form>
struct ProbeSums {
  Displacement gradient{broadcast(0.0), broadcast(0.0), broadcast(0.0)};
  typename Form::Sums pairs;
};

// The points [begin, end) of one species.
template <class Form, Output output>
LANESCAPE_INLINE void add_run(const ProbeSpecies& points, const Displacement& probe, Vector diameter,
                              const typename Form::Parameters& u, std::uint32_t begin, std::uint32_t end, ProbeSums<Form>& sums) {
  for (std::uint32_t k = begin; k < end; k += lanes) {
    // Of the probe less the point, so that the force of a pair adds to the probe's.
    const Displacement d{probe.x - load_unaligned(points.x + k), probe.y - load_unaligned(points.y + k),
                         probe.z - load_unaligned(points.z + k)};
    Separation<Vector> separation{squared_length(d), {}};
    if constexpr (Form::has_diameters) separation.sigma2 = Form::sigma_squared(u, diameter, load_unaligned(points.diameters + k));
    const Mask in_range = both(Form::in_range(u, separation), lanes_below(static_cast<std::ptrdiff_t>(end - k)));
    const auto terms = Form::terms(u, separation, in_range);
    Form::add(sums.pairs, u, terms, in_range);
    if constexpr (has_gradient(output)) subtract_scaled(sums.gradient, Form::force_over_r(u, terms, in_range), d);
  }
}

template <class Form, Output output>
LANESCAPE_INLINE double sum_probe(const ProbeInput& in, const double* position, double* gradient) {
  const Displacement probe{broadcast(position[0]), broadcast(position[1]), broadcast(position[2])};
  const Vector diameter = broadcast(in.diameter);
  Totals totals;
  ProbeSums<Form> sums;
  for (std::size_t s = 0; s < in.species_count; ++s) {
    const ProbeSpecies& points = in.species[s];
    const auto u = Form::parameters(points.pair);
    sums.pairs = {};
    for_each_column(points, position, points.reach + grid_margin(points, points.reach),
                    [&](std::size_t column, std::size_t low, std::size_t high) {
                      const std::uint32_t* first = points.first + column * (points.cells[2] + 1);
                      add_run<Form, output>(points, probe, diameter, u, first[low], first[high + 1], sums);
                      return true;
                    });
    add_sums(totals, u, sums.pairs);
  }
  if constexpr (has_gradient(output)) {
    gradient[0] = reduce_add(sums.gradient.x);
    gradient[1] = reduce_add(sums.gradient.y);
    gradient[2] = reduce_add(sums.gradient.z);
  }
  return reduce_add(totals.energy);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
