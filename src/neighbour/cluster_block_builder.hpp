#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "neighbour/cluster_blocks.hpp"

namespace lanescape {

// Finds the clusters that a block needs, and its pairs of clusters whose bounds are within reach. One per thread; it keeps its
// memory.
class ClusterBlocks::Builder {
 public:
  Builder(const ClusterBlocks& blocks, const ClusterColumns& columns);
  // Fills pieces, and lists with all pairs of clusters whose bounds are within reach.
  void build(std::size_t number, Block& block);

 private:
  // A column as a block sees it: shifted by whole boxes, with its images above and below in z.
  struct Seen {
    std::uint32_t first, end;  // local clusters
    std::uint32_t own;         // those that are not images begin here
  };
  struct Shifted {
    std::size_t column;
    int x, y;  // boxes
  };
  const Seen& see(const Shifted& shifted, std::size_t species, Block& block);
  void add_piece(const Shifted& shifted, int z, std::size_t first, std::size_t end, Block& block);
  template <class Visit>
  void for_each_own_column(std::size_t number, std::size_t species, Visit visit) const;
  void list_column(const std::array<std::size_t, 2>& at, const SpeciesPair& pair, Lists& lists, Block& block);
  void find_near_columns(const std::array<std::size_t, 2>& at, const SpeciesPair& pair, Block& block);
  void list_cluster(std::uint32_t local, const SpeciesPair& pair, Lists& lists);

  const ClusterBlocks* blocks_;
  const ClusterColumns* columns_;
  double longest_reach_;
  std::vector<std::uint32_t> seen_at_;  // for each column and shift, one more than its place in seen_
  std::vector<std::size_t> marked_;     // in seen_at_
  std::vector<Seen> seen_;
  std::vector<Seen> near_;                      // of one column
  std::vector<ClusterColumns::Bounds> bounds_;  // of local clusters, shifted
  std::vector<std::uint8_t> filled_;
};

}  // namespace lanescape
