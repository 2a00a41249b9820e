#include "neighbour/cluster_blocks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/parallel.hpp"
#include "neighbour/cluster_block_builder.hpp"

namespace lanescape {
namespace {

using kernels::cluster_width;

}  // namespace

void ClusterBlocks::find_species_pairs(const ClusterColumns& columns) {
  species_ = columns.species();
  species_pairs_.clear();
  const auto clusters = [&](std::size_t s) {
    const ClusterColumns::Grid& grid = columns.grid(s);
    return columns.first_cluster(grid.first_column + grid.count[0] * grid.count[1]) - columns.first_cluster(grid.first_column);
  };
  for (std::size_t a = 0; a < species_; ++a)
    for (std::size_t b = a; b < species_; ++b)
      species_pairs_.push_back(clusters(b) < clusters(a) ? SpeciesPair{b, a} : SpeciesPair{a, b});
}

// Tiles of 4 x 4 columns: smaller ones share more clusters with others, larger ones are few. A small system has smaller ones.
void ClusterBlocks::shape_tiles(const ClusterColumns& columns) {
  constexpr std::size_t wide = 4, narrow = 2, enough = 8;
  std::array<std::size_t, 2> most{1, 1};
  for (std::size_t s = 0; s < species_; ++s)
    for (std::size_t axis = 0; axis < 2; ++axis) most[axis] = std::max(most[axis], columns.grid(s).count[axis]);
  for (std::size_t axis = 0; axis < 2; ++axis) tiles_[axis] = std::max<std::size_t>(1, most[axis] / wide);
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (tiles_[0] * tiles_[1] < enough) tiles_[axis] = std::max<std::size_t>(1, most[axis] / narrow);
}

void ClusterBlocks::make(const ClusterColumns& columns, int threads) {
  find_species_pairs(columns);
  shape_tiles(columns);
  blocks_.resize(tiles_[0] * tiles_[1]);
  for_each_part(threads, [&](int part) {
    Builder builder(*this, columns);
    for (std::size_t b = part_begin(count(), part, threads); b < part_begin(count(), part + 1, threads); ++b) {
      Block& block = blocks_[b];
      builder.build(b, block);
      const std::size_t clusters = block.pieces.empty() ? 0 : block.pieces.back().local + block.pieces.back().count;
      block.points.resize(cluster_width * clusters);
      block.gradients.resize(cluster_width * clusters);
      block.fixed_unit = columns.fixed_unit();
      load(b, columns);
      for (std::size_t p = 0; p < species_pairs_.size(); ++p) shorten(block.lists[p], block, reach(species_pairs_[p], skin_));
    }
  });
  collect_sources(columns.columns());
}

kernels::ClusterCounts ClusterBlocks::prune(Lists& lists, const Block& block, double reach) const {
  const double reach_in_units = reach / block.fixed_unit;
  std::size_t most = 1;
  for (const kernels::ClusterRows& row : lists.rows) most += row.end - row.begin;
  if (lists.pruned_rows.size() <= lists.rows.size()) lists.pruned_rows.resize(lists.rows.size() + 1);
  if (lists.pruned.size() < most) lists.pruned.resize(most);
  return table_->prune_clusters({block.points.data(), lists.rows.data(), lists.rows.size(), lists.neighbours.data()},
                                static_cast<float>(reach_in_units * reach_in_units * (1.0 + 1e-6)), lists.pruned_rows.data(),
                                lists.pruned.data());
}

// From clusters whose bounds are in reach to those of which particles are.
void ClusterBlocks::shorten(Lists& lists, const Block& block, double reach) const {
  const kernels::ClusterCounts kept = prune(lists, block, reach);
  lists.rows.assign(lists.pruned_rows.begin(), lists.pruned_rows.begin() + static_cast<std::ptrdiff_t>(kept.rows));
  lists.neighbours.assign(lists.pruned.begin(), lists.pruned.begin() + static_cast<std::ptrdiff_t>(kept.neighbours));
}

void ClusterBlocks::prune(std::size_t b) {
  for (std::size_t p = 0; p < species_pairs_.size(); ++p)
    blocks_[b].lists[p].kept = prune(blocks_[b].lists[p], blocks_[b], reach(species_pairs_[p], inner_skin_));
}

kernels::ClusterLists ClusterBlocks::lists(std::size_t block, std::size_t pair) const {
  const Lists& lists = blocks_[block].lists[pair];
  return {blocks_[block].points.data(), lists.pruned_rows.data(), lists.kept.rows, lists.pruned.data()};
}

void ClusterBlocks::load(std::size_t b, const ClusterColumns& columns) {
  constexpr double shifter = 6755399441055744.0;  // as for points
  Block& block = blocks_[b];
  for (const Piece& piece : block.pieces) {
    std::array<std::int32_t, 3> shift{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      shift[axis] = static_cast<std::int32_t>(
          std::bit_cast<std::uint64_t>(piece.boxes[axis] * columns.box().length[axis] / columns.fixed_unit() + shifter));
    const std::size_t to = cluster_width * piece.local;
    table_->load_clusters(columns.points(piece.first_cluster), shift.data(), piece.count, block.points.data() + to,
                          block.gradients.data() + to);
  }
}

void ClusterBlocks::collect_sources(std::size_t columns) {
  first_source_.assign(columns + 1, 0);
  for (const Block& block : blocks_)
    for (const Piece& piece : block.pieces) ++first_source_[piece.column + 1];
  for (std::size_t column = 0; column < columns; ++column) first_source_[column + 1] += first_source_[column];
  sources_.resize(first_source_[columns]);
  std::vector<std::uint32_t> next(first_source_.begin(), first_source_.end() - 1);
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    for (const Piece& piece : blocks_[b].pieces)
      sources_[next[piece.column]++] = {static_cast<std::uint32_t>(b), piece.first_cluster, piece.count, piece.local};
}

void ClusterBlocks::sum_gradients(std::size_t column, std::size_t first_cluster, double* sums) const {
  for (std::uint32_t s = first_source_[column]; s < first_source_[column + 1]; ++s) {
    const Source& source = sources_[s];
    table_->add_clusters(blocks_[source.block].gradients.data() + cluster_width * source.local, source.count,
                         sums + cluster_width * (source.first_cluster - first_cluster));
  }
}

std::size_t ClusterBlocks::memory() const {
  std::size_t bytes = sources_.capacity() * sizeof(Source) + first_source_.capacity() * sizeof(std::uint32_t);
  for (const Block& block : blocks_) {
    bytes += block.pieces.capacity() * sizeof(Piece) + (block.points.capacity() + block.gradients.capacity()) * sizeof(float);
    for (const Lists& lists : block.lists)
      bytes += (lists.rows.capacity() + lists.pruned_rows.capacity()) * sizeof(kernels::ClusterRows) +
               (lists.neighbours.capacity() + lists.pruned.capacity()) * sizeof(std::uint32_t);
  }
  return bytes;
}

}  // namespace lanescape
