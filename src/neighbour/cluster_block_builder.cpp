#include "neighbour/cluster_block_builder.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"

namespace lanescape {
namespace {

using kernels::cluster_rows;
using kernels::cluster_width;

double gap_squared(const ClusterColumns::Bounds& a, const ClusterColumns::Bounds& b) {
  double sum = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gap = std::max({a.low[axis] - b.high[axis], b.low[axis] - a.high[axis], 0.0});
    sum += gap * gap;
  }
  return sum;
}

// Whole boxes below an index of a column that may lie beyond a face, and what is left of it.
std::pair<int, std::size_t> wrapped(std::ptrdiff_t index, std::size_t count) {
  const auto n = static_cast<std::ptrdiff_t>(count);
  const std::ptrdiff_t boxes = index >= 0 ? index / n : -((n - 1 - index) / n);
  return {static_cast<int>(boxes), static_cast<std::size_t>(index - boxes * n)};
}

}  // namespace

ClusterBlocks::Builder::Builder(const ClusterBlocks& blocks, const ClusterColumns& columns)
    : blocks_(&blocks), columns_(&columns), longest_reach_(0.0), seen_at_(9 * columns.columns(), 0) {
  for (const SpeciesPair& pair : blocks.species_pairs_) longest_reach_ = std::max(longest_reach_, blocks.reach(pair, blocks.skin_));
}

void ClusterBlocks::Builder::add_piece(const Shifted& shifted, int z, std::size_t first, std::size_t end, Block& block) {
  if (first == end) return;
  const std::array<int, 3> boxes = {shifted.x, shifted.y, z};
  block.pieces.push_back({static_cast<std::uint32_t>(shifted.column),
                          static_cast<std::uint32_t>(first),
                          static_cast<std::uint32_t>(end - first),
                          static_cast<std::uint32_t>(bounds_.size()),
                          {static_cast<std::int8_t>(boxes[0]), static_cast<std::int8_t>(boxes[1]), static_cast<std::int8_t>(z)}});
  for (std::size_t cluster = first; cluster < end; ++cluster) {
    ClusterColumns::Bounds bounds = columns_->bounds(cluster);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds.low[axis] += boxes[axis] * columns_->box().length[axis];
      bounds.high[axis] += boxes[axis] * columns_->box().length[axis];
    }
    bounds_.push_back(bounds);
    filled_.push_back(static_cast<std::uint8_t>(columns_->filled(cluster)));
  }
}

const ClusterBlocks::Builder::Seen& ClusterBlocks::Builder::see(const Shifted& shifted, std::size_t, Block& block) {
  const std::size_t key = 9 * shifted.column + static_cast<std::size_t>(3 * (shifted.x + 1) + shifted.y + 1);
  if (seen_at_[key] == 0) {
    const double length = columns_->box().length[2];
    const std::size_t first = columns_->first_cluster(shifted.column), end = columns_->first_cluster(shifted.column + 1);
    std::size_t below = end, above = first;  // clusters whose images reach into the box from below and above
    while (below > first && columns_->bounds(below - 1).high[2] - length >= -longest_reach_) --below;
    while (above < end && columns_->bounds(above).low[2] <= longest_reach_) ++above;
    Seen seen{static_cast<std::uint32_t>(bounds_.size()), 0, 0};
    add_piece(shifted, -1, below, end, block);
    seen.own = static_cast<std::uint32_t>(bounds_.size());
    add_piece(shifted, 0, first, end, block);
    add_piece(shifted, 1, first, above, block);
    seen.end = static_cast<std::uint32_t>(bounds_.size());
    seen_.push_back(seen);
    seen_at_[key] = static_cast<std::uint32_t>(seen_.size());
    marked_.push_back(key);
  }
  return seen_[seen_at_[key] - 1];
}

template <class Visit>
void ClusterBlocks::Builder::for_each_own_column(std::size_t number, std::size_t species, Visit visit) const {
  const ClusterColumns::Grid& grid = columns_->grid(species);
  const auto part = [&](std::size_t axis, std::size_t tile) { return grid.count[axis] * tile / blocks_->tiles_[axis]; };
  const std::size_t x = number / blocks_->tiles_[1], y = number % blocks_->tiles_[1];
  for (std::size_t i = part(0, x); i < part(0, x + 1); ++i)
    for (std::size_t j = part(1, y); j < part(1, y + 1); ++j) visit(std::array{i, j});
}

// The columns that may be in reach and, of the same species, come after this one.
void ClusterBlocks::Builder::find_near_columns(const std::array<std::size_t, 2>& at, const SpeciesPair& pair, Block& block) {
  near_.clear();
  const ClusterColumns::Grid& grid = columns_->grid(pair.neighbours);
  const std::array<double, 2> own_edge = columns_->edge(pair.rows), edge = columns_->edge(pair.neighbours);
  const double reach = blocks_->reach(pair, blocks_->skin_) * (1.0 + 1e-9);
  const auto index = [&](std::size_t axis, double x) { return static_cast<std::ptrdiff_t>(std::floor(x / edge[axis])); };
  std::array<std::array<double, 2>, 2> own{};  // low and high edge along each axis
  for (std::size_t axis = 0; axis < 2; ++axis)
    own[axis] = {static_cast<double>(at[axis]) * own_edge[axis], static_cast<double>(at[axis] + 1) * own_edge[axis]};
  const auto gap = [&](std::size_t axis, std::ptrdiff_t i) {
    const double low = static_cast<double>(i) * edge[axis], high = static_cast<double>(i + 1) * edge[axis];
    return std::max({low - own[axis][1], own[axis][0] - high, 0.0});
  };
  const bool same = pair.rows == pair.neighbours;
  for (std::ptrdiff_t i = index(0, own[0][0] - reach); i <= index(0, own[0][1] + reach); ++i)
    for (std::ptrdiff_t j = index(1, own[1][0] - reach); j <= index(1, own[1][1] + reach); ++j) {
      const double x = gap(0, i), y = gap(1, j);
      if (x * x + y * y > reach * reach) continue;
      const auto [boxes_x, column_x] = wrapped(i, grid.count[0]);
      const auto [boxes_y, column_y] = wrapped(j, grid.count[1]);
      const std::array there{static_cast<std::ptrdiff_t>(boxes_x), static_cast<std::ptrdiff_t>(boxes_y),
                             static_cast<std::ptrdiff_t>(column_x), static_cast<std::ptrdiff_t>(column_y)};
      const std::array here{std::ptrdiff_t{0}, std::ptrdiff_t{0}, static_cast<std::ptrdiff_t>(at[0]),
                            static_cast<std::ptrdiff_t>(at[1])};
      if (same && there <= here) continue;
      near_.push_back(see({grid.first_column + column_x * grid.count[1] + column_y, boxes_x, boxes_y}, pair.neighbours, block));
    }
}

void ClusterBlocks::Builder::list_cluster(std::uint32_t local, const SpeciesPair& pair, Lists& lists) {
  const ClusterColumns::Bounds own = bounds_[local];
  const double reach = blocks_->reach(pair, blocks_->skin_) * (1.0 + 1e-9);
  const auto begin = static_cast<std::uint32_t>(lists.neighbours.size());
  const bool same = pair.rows == pair.neighbours;
  const auto add = [&](std::uint32_t other) { lists.neighbours.push_back(static_cast<std::uint32_t>(cluster_width) * other); };
  if (same) add(local);
  for (const Seen& seen : near_) {
    const auto from = bounds_.begin() + seen.first, to = bounds_.begin() + seen.end;
    const auto first = std::partition_point(from, to, [&](const auto& b) { return b.high[2] < own.low[2] - reach; });
    for (auto other = std::max(first, bounds_.begin() + (seen.own <= local && local < seen.end ? local + 1 : 0));
         other != to && other->low[2] <= own.high[2] + reach; ++other)
      if (gap_squared(own, *other) <= reach * reach) add(static_cast<std::uint32_t>(other - bounds_.begin()));
  }
  const auto end = static_cast<std::uint32_t>(lists.neighbours.size());
  const std::size_t filled = filled_[local];
  for (std::size_t first = 0; first < filled; first += cluster_rows)
    lists.rows.push_back({static_cast<std::uint32_t>(cluster_width * local + first), begin, end,
                          static_cast<std::uint16_t>(std::min(filled - first, cluster_rows)), static_cast<std::uint16_t>(same)});
}

void ClusterBlocks::Builder::list_column(const std::array<std::size_t, 2>& at, const SpeciesPair& pair, Lists& lists,
                                         Block& block) {
  const ClusterColumns::Grid& grid = columns_->grid(pair.rows);
  const std::size_t column = grid.first_column + at[0] * grid.count[1] + at[1];
  const Seen own = see({column, 0, 0}, pair.rows, block);
  find_near_columns(at, pair, block);
  if (pair.rows == pair.neighbours) near_.insert(near_.begin(), own);
  const std::size_t count = columns_->first_cluster(column + 1) - columns_->first_cluster(column);
  for (std::size_t k = 0; k < count; ++k) list_cluster(own.own + static_cast<std::uint32_t>(k), pair, lists);
}

void ClusterBlocks::Builder::build(std::size_t number, Block& block) {
  for (const std::size_t key : marked_) seen_at_[key] = 0;
  marked_.clear();
  seen_.clear();
  bounds_.clear();
  filled_.clear();
  block.pieces.clear();
  block.lists.resize(blocks_->species_pairs_.size());
  for (std::size_t p = 0; p < blocks_->species_pairs_.size(); ++p) {
    const SpeciesPair& pair = blocks_->species_pairs_[p];
    Lists& lists = block.lists[p];
    lists.rows.clear();
    lists.neighbours.clear();
    for_each_own_column(number, pair.rows, [&](const std::array<std::size_t, 2>& at) { list_column(at, pair, lists, block); });
  }
}

}  // namespace lanescape
