#include "neighbour/neighbour_list.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/padded.hpp"
#include "core/parallel.hpp"
#include "neighbour/point_cells.hpp"

namespace lanescape {
namespace {

// How far rows that search together may lie apart along z, in reaches.
constexpr double group_depth = 0.8;

double longest(const std::vector<double>& lengths) {
  double longest = 0.0;
  for (const double length : lengths) longest = std::max(longest, length);
  return longest;
}

// For each species the largest reach of a search for it.
std::vector<double> margins(const std::vector<double>& reaches, std::size_t species) {
  std::vector<double> margins(species, 0.0);
  for (std::size_t k = 0; k < reaches.size(); ++k) margins[k % species] = std::max(margins[k % species], reaches[k]);
  return margins;
}

// A power of two [sigma] in which twice the largest separation of two listed points is below 2^31.
double unit_for(const std::vector<double>& reaches, double skin) {
  double furthest = skin;
  for (const double reach : reaches) furthest = std::max(furthest, reach + skin);
  return std::ldexp(1.0, std::ilogb(2.0 * furthest) + 1 - 31);
}

}  // namespace

NeighbourList::NeighbourList(const Box& box, const ParticleLayout& layout, const std::vector<double>& cutoffs, double skin,
                             const kernels::KernelTable& table, int threads, Coordinates coordinates, Members members)
    : table_(&table),
      slots_(layout.slots()),
      reaches_(with_skin(cutoffs, skin)),
      members_(members),
      frame_(box, skin, longest(cutoffs), table),
      threads_(threads),
      points_(box, layout, margins(reaches_, layout.blocks().size()), threads,
              coordinates == Coordinates::floating ? 0.0 : unit_for(reaches_, skin)) {
  for (const auto& block : layout.blocks()) counts_.push_back(static_cast<double>(block.count));
  cut_into_blocks(layout);
  share_out([](const Block& block) { return block.row_count; });
  writers_ = std::vector<Writer>(parts());
  for (Writer& writer : writers_) {
    writer.nearby.resize(counts_.size());
    writer.near.resize(counts_.size());
  }
  prepare(box);
}

void NeighbourList::prepare(const Box& box) {
  const double longest_reach = longest(reaches_);
  own_images_left_out_ = members_ == Members::others && longest_reach >= box.shortest();
  everywhere_ =
      members_ == Members::every_point ? 4.0 * (std::hypot(box.length[0], box.length[1], box.length[2]) + longest_reach) : 0.0;
  points_.set_box(box);
}

// Estimated for a fluid that fills the box evenly; otherwise the list grows, and threads take work from each other.
double NeighbourList::expected_per_row(std::size_t species) const {
  constexpr double half_a_vector_of_padding = 0.5 * kernels::slot_padding, margin = 1.02;
  double expected = 0.0;
  for (std::size_t s = 0; s < counts_.size(); ++s)
    expected += margin * counts_[s] / points_.box().volume() * 4.0 / 3.0 * std::numbers::pi *
                    std::pow(reaches_[species * counts_.size() + s], 3) +
                half_a_vector_of_padding;
  return expected;
}

kernels::NeighbourRows NeighbourList::rows_of(std::size_t block) const {
  const Block& b = blocks_[block];
  return {.points = points_.points(),
          .rows = points_.rows(b.species).data() + b.first_row,
          .row_count = b.row_count,
          .neighbours = writers_[b.array].neighbours.data() + b.first_neighbour,
          .lengths = lengths_.data() + b.first_segment,
          .species_count = points_.species(),
          .fixed_points = points_.fixed_points(),
          .fixed_unit = points_.fixed_unit()};
}

void NeighbourList::update(const AlignedArray& positions, const SlotWork& move) {
  if (frame_.is_empty()) {
    if (move) for_all_slots(threads_, slots_, move);
    return rebuild(positions);
  }
  if (!moved_too_far(positions, move)) return;
  if (!take_out_boxes(positions) || moved_too_far(positions, {})) rebuild(positions);
}

bool NeighbourList::moved_too_far(const AlignedArray& positions, const SlotWork& move) {
  std::atomic<bool> too_far = false;
  // Points are refreshed in the same pass: it is rarely in vain, and threads wait for each other once less.
  for_each_block(threads_, points_.ranges(), [&](std::size_t range) {
    const std::size_t begin = range * slot_range, end = std::min(begin + slot_range, slots_);
    if (move) move(begin, end);
    if (frame_.is_due(positions, begin, end)) too_far = true;
    points_.refresh(positions, range);
  });
  return too_far;
}

bool NeighbourList::take_out_boxes(const AlignedArray& positions) {
  if (!frame_.any_boxes(positions)) return false;
  boxes_before_ = frame_.boxes();
  frame_.count_boxes(positions);
  for_each_part(threads_, [&](int part) { points_.shift_back(boxes_before_, frame_.boxes(), part); });
  return true;
}

void NeighbourList::set_box(const Box& box) {
  if (box == frame_.box()) return;
  // The points of a sparse box, its gaps narrowed, do not move as the box does.
  const bool lasts = frame_.stretch_to(box) && !points_.is_sparse();
  if (lasts) for_each_part(threads_, [&](int part) { points_.stretch_to(box, part); });
  prepare(box);
  if (!lasts || points_.is_sparse()) frame_.forget();
}

void NeighbourList::set_values(const AlignedArray& per_slot, std::size_t stride) {
  for_each_part(threads_, [&](int part) { points_.set_values(per_slot, stride, part); });
}

void NeighbourList::rebuild(const AlignedArray& positions) {
  ++rebuilds_;
  frame_.forget();
  points_.sort(positions);
  expected_.resize(species());
  for (std::size_t s = 0; s < species(); ++s) expected_[s] = expected_per_row(s);
  share_out([&](const Block& block) { return static_cast<std::size_t>(expected_[block.species]) * block.row_count; });
  double total = 0.0;
  for (std::size_t s = 0; s < species(); ++s) total += expected_[s] * counts_[s];
  for_each_block(threads_, parts(), [&](std::size_t part) {
    Writer& writer = writers_[part];
    writer.end = 0;
    writer.make_room(static_cast<std::size_t>(total / static_cast<double>(parts())));
    for (std::size_t b = first_block(part); b < first_block(part + 1); ++b) {
      blocks_[b].array = part;
      fill(blocks_[b], writer);
    }
    // Vectors of sixteen lanes read on beyond the padding, where only here there is no neighbour of another row.
    writer.make_room(kernels::slot_padding);
    std::fill_n(writer.neighbours.data() + writer.end, kernels::slot_padding, 0U);
  });
  share_out([](const Block& block) { return block.padded_neighbours; });
  frame_.made_at(positions, threads_);
}

void NeighbourList::cut_into_blocks(const ParticleLayout& layout) {
  for (std::size_t s = 0; s < layout.blocks().size(); ++s) {
    const std::size_t rows = layout.blocks()[s].count;
    for (std::size_t first = 0; first < rows; first += block_rows) {
      const std::size_t count = std::min(block_rows, rows - first);
      blocks_.push_back({s, first, count, segments_, 0, 0, 0});
      segments_ += count * layout.blocks().size();
    }
  }
  lengths_.room_for(segments_);
}

std::size_t NeighbourList::without_own_images(std::uint32_t place, std::uint32_t* neighbours, std::size_t count) const {
  if (!own_images_left_out_) return count;
  return static_cast<std::size_t>(
      std::remove_if(neighbours, neighbours + count, [&](std::uint32_t other) { return slot_at(other) == slot_at(place); }) -
      neighbours);
}

void NeighbourList::set_exclusions(std::shared_ptr<const Exclusions> exclusions) {
  exclusions_ = std::move(exclusions);
  frame_.forget();
}

std::size_t NeighbourList::without_excluded(std::uint32_t place, std::uint32_t* neighbours, std::size_t count) const {
  const double* row = points_.points() + place;
  const auto distance_squared = [&](std::uint32_t other) {
    const double* point = points_.points() + other;
    const double x = point[0] - row[0], y = point[1] - row[1], z = point[2] - row[2];
    return x * x + y * y + z * z;
  };
  for (const std::uint32_t partner : exclusions_->of(slot_at(place))) {
    std::uint32_t* nearest = nullptr;
    for (std::uint32_t* other = neighbours; other != neighbours + count; ++other)
      if (slot_at(*other) == partner && (nearest == nullptr || distance_squared(*other) < distance_squared(*nearest)))
        nearest = other;
    if (nearest != nullptr) std::copy(nearest + 1, neighbours + count--, nearest);
  }
  return count;
}

void NeighbourList::Writer::make_room(std::size_t more) {
  if (end + more > neighbours.capacity()) neighbours.grow(end + more + end / 16, end);
}

NeighbourList::Column NeighbourList::column_of(std::uint32_t place, const kernels::PointGrid& grid) const {
  const double* at = points_.points() + place;
  const auto along = [&](std::size_t axis) {
    return cell_along(at[axis] - grid.low[axis], grid.cells_per_length[axis], grid.cells[axis]);
  };
  return {along(0), along(1)};
}

// Rows follow each other in the order of cells along z.
NeighbourList::RowGroup NeighbourList::group_at(const Block& block, std::size_t row, const Column& column,
                                                const kernels::PointGrid& grid) const {
  const std::span<const std::uint32_t> rows = points_.rows(block.species);
  const double deepest = group_depth * reaches_[block.species * (species() + 1)], first = points_.points()[rows[row] + 2];
  RowGroup group;
  group.count = 0;
  const std::size_t last = std::min(block.first_row + block.row_count, row + kernels::most_group_rows);
  for (std::size_t k = row; k < last; ++k) {
    const double* at = points_.points() + rows[k];
    if (std::abs(at[2] - first) > deepest || !(column_of(rows[k], grid) == column)) break;
    group.rows[group.count++] = {{at[0], at[1], at[2]}, rows[k] / static_cast<std::uint32_t>(kernels::point_width)};
  }
  return group;
}

void NeighbourList::look_around(const Column& column, std::size_t from, Writer& writer) const {
  const kernels::PointGrid own = points_.grid(from);
  const auto face = [&](std::size_t axis, std::size_t cell) { return own.low[axis] + static_cast<double>(cell) * own.edge[axis]; };
  const double low[2] = {face(0, column.x), face(1, column.y)}, high[2] = {face(0, column.x + 1), face(1, column.y + 1)};
  for (std::size_t of = 0; of < species(); ++of) {
    Nearby& nearby = writer.nearby[of];
    kernels::NearColumns& columns = nearby.columns;
    while (table_->columns_near_rectangle(points_.grid(of), low, high, reach(from, of), columns) > columns.capacity) {
      columns.capacity = 2 * columns.capacity + 8 * kernels::slot_padding;
      columns.first_cell = nearby.first_cells.room_for(columns.capacity);
      columns.cells = nearby.cells.room_for(columns.capacity);
    }
  }
}

std::size_t NeighbourList::copy_near(const RowGroup& group, std::size_t of, Writer& writer) const {
  kernels::NearPoints& near = writer.near[of];
  Nearby& nearby = writer.nearby[of];
  for (;;) {
    const std::size_t count = table_->points_near_group(points_.grid(of), nearby.columns, group.rows.data(), group.count,
                                                        points_.offsets(), near);
    if (count <= near.capacity) return count;
    near.capacity = 2 * near.capacity + 512;
    const std::size_t stride = near.capacity + read_ahead;
    near.x = nearby.coordinates.room_for(3 * stride);
    near.y = near.x + stride;
    near.z = near.y + stride;
    near.numbers = nearby.offsets.room_for(stride);
  }
}

std::size_t NeighbourList::shorten(const RowGroup& group, std::uint32_t* neighbours, std::uint32_t* lengths) const {
  std::uint32_t *from = neighbours, *to = neighbours;
  for (std::size_t row = 0; row < group.count; ++row)
    for (std::size_t s = 0; s < species(); ++s, ++lengths) {
      const std::uint32_t place = static_cast<std::uint32_t>(kernels::point_width) * group.rows[row].self;
      std::copy(from, from + *lengths, to);
      from += padded(*lengths);
      std::size_t count = without_own_images(place, to, *lengths);
      if (exclusions_) count = without_excluded(place, to, count);
      std::fill_n(to + count, padded(count) - count, place);
      to += padded(count);
      *lengths = static_cast<std::uint32_t>(count);
    }
  return static_cast<std::size_t>(to - neighbours);
}

void NeighbourList::fill(Block& block, Writer& writer) {
  std::uint32_t* lengths = lengths_.data() + block.first_segment;
  const kernels::PointGrid grid = points_.grid(block.species);
  const std::span<const std::uint32_t> rows = points_.rows(block.species);
  block.first_neighbour = writer.end;
  for (std::size_t k = block.first_row; k < block.first_row + block.row_count;) {
    const Column column = column_of(rows[k], grid);
    if (k == block.first_row || !(column == column_of(rows[k - 1], grid))) look_around(column, block.species, writer);
    const RowGroup group = group_at(block, k, column, grid);
    std::size_t most = 0;
    for (std::size_t s = 0; s < species(); ++s) most += padded(copy_near(group, s, writer)) + kernels::slot_padding;
    writer.make_room(group.count * most + read_ahead);
    std::uint32_t* neighbours = writer.neighbours.data() + writer.end;
    const std::size_t size =
        table_->list_group(group.rows.data(), group.count, writer.near.data(), species(), neighbours, lengths);
    writer.end += own_images_left_out_ || exclusions_ ? shorten(group, neighbours, lengths) : size;
    lengths += group.count * species();
    k += group.count;
  }
  block.padded_neighbours = writer.end - block.first_neighbour;
}

template <class Work>
void NeighbourList::share_out(Work work) {
  const std::size_t parts =
      threads_ == 1 ? 1 : std::clamp<std::size_t>(blocks_.size(), 1, parts_of_thread * static_cast<std::size_t>(threads_));
  std::size_t total = 0, part = 0, so_far = 0;
  for (const Block& block : blocks_) total += work(block);
  first_blocks_.assign(parts + 1, blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    // A part begins with the block in whose first half its share begins.
    while (part < parts && so_far + work(blocks_[b]) / 2 >= total * part / parts) first_blocks_[part++] = b;
    so_far += work(blocks_[b]);
  }
}

int useful_threads(std::size_t particles, int wanted) {
  constexpr std::size_t rows_per_thread = 128;
  return std::clamp(static_cast<int>(std::min<std::size_t>(particles / rows_per_thread, 4096)), 1, wanted);
}

std::size_t NeighbourList::neighbours() const {
  return rebuilds_ > 0 ? std::accumulate(lengths_.data(), lengths_.data() + segments_, std::size_t{0}) : 0;
}

std::size_t NeighbourList::memory() const {
  std::size_t bytes = points_.memory() + frame_.memory() + boxes_before_.capacity() * sizeof(double) +
                      blocks_.capacity() * sizeof(Block) + lengths_.capacity() * sizeof(std::uint32_t);
  for (const Writer& writer : writers_) {
    bytes += writer.neighbours.capacity() * sizeof(std::uint32_t);
    for (const Nearby& nearby : writer.nearby)
      bytes += nearby.coordinates.capacity() * sizeof(float) + nearby.cells.capacity() * sizeof(double) +
               (nearby.offsets.capacity() + nearby.first_cells.capacity()) * sizeof(std::uint32_t);
  }
  return bytes;
}

void NeighbourList::exchange(Archive& archive) {
  frame_.exchange(
      archive, 3 * slots_, [&](const Box& box) { set_box(box); }, [&](const AlignedArray& positions) { rebuild(positions); },
      [&](const AlignedArray& boxes) { for_each_part(threads_, [&](int part) { points_.shift_back({}, boxes, part); }); });
}

}  // namespace lanescape
