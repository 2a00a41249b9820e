#pragma once

#include "loops/list.hpp"

// Pair potentials over neighbour lists in mixed precision: pairs in single precision, sums in double; otherwise as in list.hpp.
//
// What single precision would lose first is the difference of two large coordinates. Here they are integers in a unit of about
// 2^-28 sigma: the difference is exact, and rounded once, to 2^-24 of itself, in any box. r^-13 makes thirteen times that of it.
//
// The lanes of one row are summed in single precision: at a cutoff of 2.5 sigma each of sixteen lanes adds half a dozen numbers, of
// SSE2's four two dozen, before it is widened to double. Widening each term instead leaves the worst error of a force at 6e-7 to
// 7e-7 and that of an energy as it is, since it is the pairs' own rounding; it took 1.3 to 1.7 times as long (4000 particles,
// AVX-512, Zen 4, separate runs on a busy machine).
namespace lanescape::kernels::LANESCAPE_ISA {

// The fourth numbers of points, in fixed units as the coordinates are.
LANESCAPE_INLINE FloatVector gather_diameters(const std::int32_t* points, const std::uint32_t* offsets, float unit) {
  alignas(array_alignment) float diameters[float_lanes];
  for (std::size_t k = 0; k < float_lanes; ++k) diameters[k] = static_cast<float>(points[offsets[k] + 3]);
  return load(diameters) * broadcast<FloatVector>(unit);
}

template <class Form>
struct MixedRowSums {
  Vector3<FloatVector> gradient;
  typename Form::Sums pairs;
};

template <class Form, Output output>
LANESCAPE_INLINE void mixed_vector(const std::int32_t* points, const std::uint32_t* offsets, const std::int32_t* row,
                                   const typename Form::Parameters& u, float unit, FloatMask valid, MixedRowSums<Form>& sums) {
  Vector3<FloatVector> d;
  Separation<FloatVector> separation;
  prefetch(offsets + list_prefetch);
  gather_differences(points, offsets, row, d.x, d.y, d.z);
  if constexpr (Form::has_diameters)
    separation.sigma2 =
        Form::sigma_squared(u, broadcast<FloatVector>(static_cast<float>(row[3]) * unit), gather_diameters(points, offsets, unit));
  separation.r2 = squared_length(d);
  const FloatMask in_range = both(valid, Form::in_range(u, separation));
  const auto terms = Form::terms(u, separation, in_range);
  if constexpr (has_energy(output)) Form::add(sums.pairs, u, terms, in_range);
  if constexpr (has_gradient(output)) add_scaled(sums.gradient, Form::force_over_r(u, terms, in_range), d);
}

template <template <class> class Form, Output output>
LANESCAPE_INLINE void mixed_rows(const PairListInput& in, double* gradient, Totals& totals) {
  using Single = Form<FloatVector>;
  const NeighbourRows& list = in.list;
  const std::uint32_t* offsets = list.neighbours;
  const std::uint32_t* length = list.lengths;
  const FloatVector none = zero<FloatVector>();
  const Vector unit = broadcast(list.fixed_unit);
  for (std::size_t k = 0; k < list.row_count; ++k) {
    const std::int32_t* row = list.fixed_points + list.rows[k];
    MixedRowSums<Single> sums{{none, none, none}, {}};
    for (std::size_t s = 0; s < list.species_count; ++s, ++length) {
      sums.pairs = {};
      const auto u = Single::parameters(in.single_pairs[s]);
      const std::size_t count = *length;
      for (std::size_t j = 0; j < count; j += float_lanes)
        mixed_vector<Single, output>(list.fixed_points, offsets + j, row, u, static_cast<float>(list.fixed_unit),
                                     lanes_below<FloatVector>(count - j), sums);
      offsets += padded_length(count);
      if constexpr (has_energy(output)) add_sums(totals, Form<Vector>::parameters(in.pairs[s]), widened(sums.pairs));
    }
    if constexpr (has_gradient(output))
      store_point(gradient + point_width * k, unit * add_halves(sums.gradient.x), unit * add_halves(sums.gradient.y),
                  unit * add_halves(sums.gradient.z));
  }
}

template <template <class> class Form, Output output>
LANESCAPE_INLINE void sum_list_mixed(const PairListInput& in, double* gradient, PairOutput& out) {
  Totals totals;
  mixed_rows<Form, output>(in, gradient, totals);
  store_half<output>(totals, out);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
