#include "kernel_declarations.hpp"
#include "loops/clusters.hpp"

// No round of the loop that follows writes what another reads.
#ifdef __clang__
#define LANESCAPE_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define LANESCAPE_INDEPENDENT _Pragma("GCC ivdep")
#endif

// What is done with clusters beside the evaluation of their pairs.
namespace lanescape::kernels::LANESCAPE_ISA {
namespace {

// Whether a particle of a cluster is in reach of one of four rows. Places without particles may say so too, which costs time only.
LANESCAPE_INLINE bool in_reach(const std::int32_t* points, const RowPoints& rows, FloatVector reach_squared) {
  FloatMask near = less(zero<FloatVector>(), zero<FloatVector>());
#pragma GCC unroll 2
  for (std::size_t part = 0; part < vectors_per_cluster; ++part) {
    const std::size_t place = part * float_lanes;
    const FixedVector x = load_cluster(points + place), y = load_cluster(points + cluster_size + place),
                      z = load_cluster(points + 2 * cluster_size + place);
#pragma GCC unroll 4
    for (std::size_t v = 0; v < row_vectors; ++v) {
      const Vector3<FloatVector> d{wrapped_difference(x, rows.x[v]), wrapped_difference(y, rows.y[v]),
                                   wrapped_difference(z, rows.z[v])};
      near = either(near, less(squared_length(d), reach_squared));
    }
  }
  return any(near);
}

}  // namespace

ClusterCounts prune_clusters(const ClusterLists& lists, float reach_squared, ClusterRows* rows,
                             std::uint32_t* neighbours) noexcept {
  const FloatVector reach2 = broadcast<FloatVector>(reach_squared);
  ClusterCounts counts{0, 0};
  for (std::size_t k = 0; k < lists.row_count; ++k) {
    const ClusterRows& row = lists.rows[k];
    const RowPoints points = load_row_points(lists.points + row.offset);
    const std::size_t begin = counts.neighbours;
    for (std::size_t n = row.begin; n < row.end; ++n) {
      // Written always, kept or not: a branch would be hard to predict.
      neighbours[counts.neighbours] = lists.neighbours[n];
      counts.neighbours += in_reach(lists.points + lists.neighbours[n], points, reach2) ? 1 : 0;
    }
    rows[counts.rows] = row;
    rows[counts.rows].begin = static_cast<std::uint32_t>(begin);
    rows[counts.rows].end = static_cast<std::uint32_t>(counts.neighbours);
    counts.rows += counts.neighbours > begin ? 1 : 0;
  }
  return counts;
}

void load_clusters(const std::int32_t* from, const std::int32_t* shift, std::size_t count, std::int32_t* points,
                   float* gradients) noexcept {
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis, from += cluster_size, points += cluster_size, gradients += cluster_size)
LANESCAPE_INDEPENDENT
      for (std::size_t place = 0; place < cluster_size; ++place) {
        // Unsigned arithmetic wraps around; what is signed must not.
        points[place] =
            static_cast<std::int32_t>(static_cast<std::uint32_t>(from[place]) + static_cast<std::uint32_t>(shift[axis]));
        gradients[place] = 0.0F;
      }
}

void add_clusters(const float* from, std::size_t count, double* sums) noexcept {
LANESCAPE_INDEPENDENT
  for (std::size_t k = 0; k < cluster_width * count; ++k) sums[k] += static_cast<double>(from[k]);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
