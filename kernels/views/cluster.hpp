#pragma once

#include <cstddef>
#include <cstdint>

#include "views/pair.hpp"

// Clusters: eight particles of one species near each other. Pairs of whole clusters need no gathering of single neighbours.
namespace lanescape::kernels {

inline constexpr std::size_t cluster_size = 8;
// Numbers of a record: x of all eight, y of all eight, z of all eight. Clusters are identified by the offset of their record.
inline constexpr std::size_t cluster_width = 3 * cluster_size;
// Rows are the first or the last four particles of a cluster.
inline constexpr std::size_t cluster_rows = 4;

struct ClusterRows {
  std::uint32_t offset;      // of the x of the first row
  std::uint32_t begin, end;  // their neighbours
  std::uint16_t filled;      // rows that are particles
  std::uint16_t own;         // 1: the first neighbour is their own cluster, of which they pair with the particles after themselves
};

// Four rows each against the clusters in their reach, each pair in one of its two orders only.
struct ClusterLists {
  // Coordinates in fixed_unit, modulo 2^32. Places of a record without a particle are far from everything but other such places.
  const std::int32_t* points;
  const ClusterRows* rows;
  std::size_t row_count;
  const std::uint32_t* neighbours;
};

struct ClusterInput {
  ClusterLists lists;
  double fixed_unit;  // a power of two [sigma]
  // Of both species; `images` is ignored [sigma].
  const PairParameters* pair;
  const SinglePairParameters* single_pair;
};

// What pruned lists take.
struct ClusterCounts {
  std::size_t rows, neighbours;
};

}  // namespace lanescape::kernels
