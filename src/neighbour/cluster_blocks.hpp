#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/aligned_array.hpp"
#include "kernel_table.hpp"
#include "neighbour/cluster_columns.hpp"

namespace lanescape {

// Pairs of clusters, shared out to blocks: a block is a bundle of columns with all pairs of which its clusters are the rows. It
// holds copies of the clusters that it needs, images with their shifts, and collects gradients of its own, so that whatever threads
// take the blocks, each sum has one order: within a block that of its lists, then that of the blocks.
//
// Of two clusters that are neighbours, the one whose column comes first is the row, where a column behind a face of the box comes
// after all others along x, or along y, and before them in front of it. Of two species the rarer one's clusters are rows.
class ClusterBlocks {
 public:
  // `cutoffs`: species x species [sigma]; lists reach further by `skin`, pruned ones by `inner_skin`.
  ClusterBlocks(const std::vector<double>& cutoffs, double skin, double inner_skin, const kernels::KernelTable& table)
      : table_(&table), cutoffs_(cutoffs), skin_(skin), inner_skin_(inner_skin) {}

  // Lists the pairs of clusters that were just sorted, and refreshed.
  void make(const ClusterColumns& columns, int threads);
  std::size_t count() const { return blocks_.size(); }
  // Pairs of species with lists.
  struct SpeciesPair {
    std::size_t rows, neighbours;
  };
  const std::vector<SpeciesPair>& species_pairs() const { return species_pairs_; }

  // Brings the copies of a block's clusters up to date and clears their gradients.
  void load(std::size_t block, const ClusterColumns& columns);
  // Makes the pruned lists of a block, whose clusters are up to date.
  void prune(std::size_t block);
  // The pruned lists of one of species_pairs().
  kernels::ClusterLists lists(std::size_t block, std::size_t pair) const;
  float* gradients(std::size_t block) { return blocks_[block].gradients.data(); }
  // Adds the gradients of a column's clusters, of which this is the first, over all blocks to records as those of clusters.
  void sum_gradients(std::size_t column, std::size_t first_cluster, double* sums) const;
  std::size_t memory() const;  // [bytes]

 private:
  // Clusters of a column that follow each other, all with the same shift.
  struct Piece {
    std::uint32_t column, first_cluster, count;
    std::uint32_t local;  // of the first one in the block
    std::array<std::int8_t, 3> boxes;
  };
  struct Lists {
    std::vector<kernels::ClusterRows> rows, pruned_rows;
    std::vector<std::uint32_t> neighbours, pruned;
    kernels::ClusterCounts kept{0, 0};
  };
  struct Block {
    std::vector<Piece> pieces;
    std::vector<Lists> lists;  // of species_pairs_
    AlignedVector<std::int32_t> points;
    AlignedVector<float> gradients;
    double fixed_unit = 0.0;
  };
  // The gradients of a column's clusters in one block.
  struct Source {
    std::uint32_t block, first_cluster, count, local;
  };
  class Builder;

  void find_species_pairs(const ClusterColumns& columns);
  void shape_tiles(const ClusterColumns& columns);
  void collect_sources(std::size_t columns);
  double reach(const SpeciesPair& pair, double skin) const { return cutoffs_[pair.rows * species_ + pair.neighbours] + skin; }
  kernels::ClusterCounts prune(Lists& lists, const Block& block, double reach) const;
  void shorten(Lists& lists, const Block& block, double reach) const;

  const kernels::KernelTable* table_;
  std::vector<double> cutoffs_;
  double skin_, inner_skin_;
  std::size_t species_ = 0;
  std::vector<SpeciesPair> species_pairs_;
  std::array<std::size_t, 2> tiles_{1, 1};
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> first_source_;  // of each column; one more at the end
  std::vector<Source> sources_;
};

}  // namespace lanescape
