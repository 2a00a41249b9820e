#pragma once

#include "loops/neighbour_rows.hpp"

// Pair potentials over neighbour lists: the loop for large systems. Each row's list holds all its neighbours, so that a pair is
// evaluated from both of its ends: nothing but the row's own gradient is written, threads can share the rows in any way and no sum
// depends on it. Each pair once would mean to fetch and put back the gradients of eight scattered neighbours for every vector of
// pairs, which costs more than it saves (docs/PERFORMANCE.md).
//
// A neighbour is one load of four doubles; seven shuffles turn a vector of them into columns. Images are points of their own, so
// that there is no nearest image to find and the box may be of any size.
namespace lanescape::kernels::LANESCAPE_ISA {

struct ListRow {
  Displacement position;
  Vector diameter;  // where the form has it
};

template <class Form>
LANESCAPE_INLINE ListRow row_at(const NeighbourRows& list, std::size_t k) {
  ListRow row{row_position(list, k), {}};
  if constexpr (Form::has_diameters) row.diameter = broadcast(list.points[list.rows[k] + 3]);
  return row;
}

// What is summed over the neighbours of one row: of all species, and of one.
template <class Form>
struct RowSums {
  Displacement gradient;
  typename Form::Sums pairs;
};

template <class Form, Output output, bool masked>
LANESCAPE_INLINE void list_vector(const double* points, const std::uint32_t* offsets, const ListRow& row,
                                  const typename Form::Parameters& u, Mask valid, RowSums<Form>& sums, Totals& totals) {
  Displacement d;
  Separation<Vector> separation;
  prefetch(offsets + list_prefetch);
  if constexpr (Form::has_diameters) {
    Vector diameter;
    gather_quads(points, offsets, d.x, d.y, d.z, diameter);
    separation.sigma2 = Form::sigma_squared(u, row.diameter, diameter);
  } else {
    gather_points(points, offsets, d.x, d.y, d.z);
  }
  d = {d.x - row.position.x, d.y - row.position.y, d.z - row.position.z};
  separation.r2 = squared_length(d);
  Mask in_range = Form::in_range(u, separation);
  if constexpr (masked) in_range = both(in_range, valid);
  const auto terms = Form::terms(u, separation, in_range);
  if constexpr (has_energy(output)) Form::add(sums.pairs, u, terms, in_range);
  if constexpr (has_gradient(output)) {
    const Vector w = Form::force_over_r(u, terms, in_range);
    add_scaled(sums.gradient, w, d);
    if constexpr (output == Output::stress) add_tensor(totals, d, w);
  }
}

template <class Form, Output output>
LANESCAPE_INLINE void list_rows(const PairListInput& in, double* gradient, Totals& totals) {
  const NeighbourRows& list = in.list;
  const std::uint32_t* offsets = list.neighbours;
  const std::uint32_t* length = list.lengths;
  const Vector none = broadcast(0.0);
  for (std::size_t k = 0; k < list.row_count; ++k) {
    const ListRow row = row_at<Form>(list, k);
    RowSums<Form> sums{{none, none, none}, {}};
    for (std::size_t s = 0; s < list.species_count; ++s, ++length) {
      const auto u = Form::parameters(in.pairs[s]);
      sums.pairs = {};
      const std::size_t count = *length;
      std::size_t j = 0;
      for (; j + lanes <= count; j += lanes) list_vector<Form, output, false>(list.points, offsets + j, row, u, {}, sums, totals);
      if (j < count)
        list_vector<Form, output, true>(list.points, offsets + j, row, u, lanes_below(static_cast<std::ptrdiff_t>(count - j)), sums,
                                        totals);
      offsets += padded_length(count);
      if constexpr (has_energy(output)) add_sums(totals, u, sums.pairs);
    }
    if constexpr (has_gradient(output)) store_point(gradient + point_width * k, sums.gradient.x, sums.gradient.y, sums.gradient.z);
  }
}

template <class Form, Output output>
LANESCAPE_INLINE void sum_list(const PairListInput& in, double* gradient, PairOutput& out) {
  Totals totals;
  list_rows<Form, output>(in, gradient, totals);
  store_half<output>(totals, out);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
