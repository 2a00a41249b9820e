#pragma once

#include "loops/pair_vector.hpp"
#include "views/cluster.hpp"

// Pair potentials over clusters, in mixed precision: the loop for large systems. Particles of a cluster are next to each other in
// memory: neither loads nor stores are scattered, so that each pair is evaluated once and its gradient added to both particles.
// Of the 4 x 8 pairs of rows and a cluster a quarter is in range in a liquid, but in single precision sixteen take no longer than
// the gathering of eight neighbours of a list.
//
// Separations are exact integers as in list_mixed.hpp. The lanes of four rows are summed in single precision over one list of
// clusters, a few tens of numbers each, and then in double.
namespace lanescape::kernels::LANESCAPE_ISA {

// A vector holds one row with a cluster or half of it, or two rows with a cluster.
inline constexpr std::size_t rows_per_vector = float_lanes > cluster_size ? float_lanes / cluster_size : 1;
inline constexpr std::size_t vectors_per_cluster = float_lanes < cluster_size ? cluster_size / float_lanes : 1;
inline constexpr std::size_t row_vectors = cluster_rows / rows_per_vector;

struct RowPoints {
  FixedVector x[row_vectors], y[row_vectors], z[row_vectors];
};
LANESCAPE_INLINE RowPoints load_row_points(const std::int32_t* points) {
  RowPoints rows;
#pragma GCC unroll 4
  for (std::size_t v = 0; v < row_vectors; ++v) {
    rows.x[v] = load_rows(points + rows_per_vector * v);
    rows.y[v] = load_rows(points + cluster_size + rows_per_vector * v);
    rows.z[v] = load_rows(points + 2 * cluster_size + rows_per_vector * v);
  }
  return rows;
}

// Which pairs count, where not all do.
struct ClusterMasks {
  FloatMask of[row_vectors][vectors_per_cluster];
};
// Of rows that are particles, with every place of a cluster, or with those after the row's own, which is `first` for the first row.
template <bool own>
LANESCAPE_INLINE ClusterMasks cluster_masks(std::size_t filled, std::size_t first) {
  alignas(array_alignment) static constexpr float places[] = {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
  alignas(array_alignment) static constexpr float second_row[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1};
  ClusterMasks masks;
#pragma GCC unroll 4
  for (std::size_t v = 0; v < row_vectors; ++v) {
    const FloatVector row = load(second_row) + broadcast<FloatVector>(static_cast<float>(rows_per_vector * v));
#pragma GCC unroll 2
    for (std::size_t part = 0; part < vectors_per_cluster; ++part) {
      masks.of[v][part] = less(row, broadcast<FloatVector>(static_cast<float>(filled)));
      if constexpr (own)
        masks.of[v][part] = both(masks.of[v][part],
                                 less(row + broadcast<FloatVector>(static_cast<float>(first)), load(places + part * float_lanes)));
    }
  }
  return masks;
}

template <class Form>
struct ClusterRowSums {
  FloatVector x[row_vectors], y[row_vectors], z[row_vectors];
  typename Form::Sums pairs;
};

template <class Form, Output output, bool masked>
LANESCAPE_INLINE void cluster_pairs(const std::int32_t* points, float* gradients, const RowPoints& rows,
                                    const typename Form::Parameters& u, const ClusterMasks& masks, ClusterRowSums<Form>& sums) {
#pragma GCC unroll 2
  for (std::size_t part = 0; part < vectors_per_cluster; ++part) {
    const std::size_t place = part * float_lanes;
    const FixedVector x = load_cluster(points + place), y = load_cluster(points + cluster_size + place),
                      z = load_cluster(points + 2 * cluster_size + place);
    Vector3<FloatVector> back{zero<FloatVector>(), zero<FloatVector>(), zero<FloatVector>()};
#pragma GCC unroll 4
    for (std::size_t v = 0; v < row_vectors; ++v) {
      const Vector3<FloatVector> d{wrapped_difference(x, rows.x[v]), wrapped_difference(y, rows.y[v]),
                                   wrapped_difference(z, rows.z[v])};
      Separation<FloatVector> separation;
      separation.r2 = squared_length(d);
      FloatMask in_range = Form::in_range(u, separation);
      if constexpr (masked) in_range = both(masks.of[v][part], in_range);
      const auto terms = Form::terms(u, separation, in_range);
      if constexpr (has_energy(output)) Form::add(sums.pairs, u, terms, in_range);
      if constexpr (has_gradient(output)) {
        const FloatVector w = Form::force_over_r(u, terms, in_range);
        sums.x[v] = multiply_add(w, d.x, sums.x[v]);
        sums.y[v] = multiply_add(w, d.y, sums.y[v]);
        sums.z[v] = multiply_add(w, d.z, sums.z[v]);
        add_scaled(back, w, d);
      }
    }
    if constexpr (has_gradient(output)) {
      subtract_from_cluster(gradients + place, back.x);
      subtract_from_cluster(gradients + cluster_size + place, back.y);
      subtract_from_cluster(gradients + 2 * cluster_size + place, back.z);
    }
  }
}

// All neighbours of four rows.
template <class Form, Output output>
LANESCAPE_INLINE void cluster_row_pairs(const ClusterLists& lists, const ClusterRows& row, float* gradients,
                                        const typename Form::Parameters& u, ClusterRowSums<Form>& sums) {
  const RowPoints points = load_row_points(lists.points + row.offset);
  const std::size_t filled = row.filled;
  std::size_t k = row.begin;
  if (row.own != 0) {
    const std::uint32_t offset = lists.neighbours[k++];
    cluster_pairs<Form, output, true>(lists.points + offset, gradients + offset, points, u,
                                      cluster_masks<true>(filled, row.offset % cluster_width), sums);
  }
  const ClusterMasks masks = cluster_masks<false>(filled, 0);
  if (filled == cluster_rows)
    for (; k < row.end; ++k)
      cluster_pairs<Form, output, false>(lists.points + lists.neighbours[k], gradients + lists.neighbours[k], points, u, masks,
                                         sums);
  else
    for (; k < row.end; ++k)
      cluster_pairs<Form, output, true>(lists.points + lists.neighbours[k], gradients + lists.neighbours[k], points, u, masks,
                                        sums);
}

template <template <class> class Form, Output output>
LANESCAPE_INLINE void sum_clusters(const ClusterInput& in, float* gradients, Totals& totals) {
  using Single = Form<FloatVector>;
  const auto u = Single::parameters(*in.single_pair);
  for (std::size_t k = 0; k < in.lists.row_count; ++k) {
    const ClusterRows& row = in.lists.rows[k];
    ClusterRowSums<Single> sums;
#pragma GCC unroll 4
    for (std::size_t v = 0; v < row_vectors; ++v) sums.x[v] = sums.y[v] = sums.z[v] = zero<FloatVector>();
    cluster_row_pairs<Single, output>(in.lists, row, gradients, u, sums);
    if constexpr (has_gradient(output)) {
      add_to_rows(gradients + row.offset, sums.x);
      add_to_rows(gradients + row.offset + cluster_size, sums.y);
      add_to_rows(gradients + row.offset + 2 * cluster_size, sums.z);
    }
    if constexpr (has_energy(output)) add_sums(totals, Form<Vector>::parameters(*in.pair), widened(sums.pairs));
  }
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
