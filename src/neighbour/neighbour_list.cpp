#include "neighbour/neighbour_list.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/padded.hpp"
#include "core/parallel.hpp"

namespace lanescape {
namespace {

std::vector<double> with_skin(std::vector<double> cutoffs, double skin) {
  for (double& cutoff : cutoffs) cutoff += skin;
  return cutoffs;
}

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
              coordinates == Coordinates::floating ? 0.0 : unit_for(reaches_, skin)),
      neighbours_(static_cast<std::size_t>(threads)) {
  for (const auto& block : layout.blocks()) counts_.push_back(static_cast<double>(block.count));
  prepare(box);
}

void NeighbourList::prepare(const Box& box) {
  const double longest_reach = longest(reaches_);
  own_images_left_out_ = members_ == Members::others && longest_reach >= box.shortest();
  everywhere_ =
      members_ == Members::every_point ? 4.0 * (std::hypot(box.length[0], box.length[1], box.length[2]) + longest_reach) : 0.0;
  points_.set_box(box);
}

// Estimated for a fluid that fills the box evenly; otherwise the list grows.
double NeighbourList::expected_per_row() const {
  constexpr double half_a_vector_of_padding = 0.5 * kernels::slot_padding, margin = 1.02;
  const double particles = std::accumulate(counts_.begin(), counts_.end(), 0.0);
  double expected = 0.0;
  for (std::size_t k = 0; k < reaches_.size(); ++k) {
    const double rows = counts_[k / counts_.size()] / (particles + 1.0),
                 density = counts_[k % counts_.size()] / points_.box().volume();
    expected += margin * rows * (density * 4.0 / 3.0 * std::numbers::pi * std::pow(reaches_[k], 3) + half_a_vector_of_padding);
  }
  return expected;
}

kernels::NeighbourRows NeighbourList::rows_of(std::size_t block) const {
  const Block& b = blocks_[block];
  return {.points = points_.points(),
          .rows = points_.rows(b.species).data() + b.first_row,
          .row_count = b.row_count,
          .neighbours = neighbours_[b.array].data() + b.first_neighbour,
          .lengths = lengths_.data() + b.first_segment,
          .species_count = points_.species(),
          .fixed_points = points_.fixed_points(),
          .fixed_unit = points_.fixed_unit()};
}

void NeighbourList::update(const AlignedArray& positions) {
  if (frame_.is_empty()) return rebuild(positions);
  if (!moved_too_far(positions)) return;
  if (!take_out_boxes(positions) || moved_too_far(positions)) rebuild(positions);
}

namespace {

// The slots of a part are multiples of the kernels' padding.
std::size_t first_slot(std::size_t slots, int part, int parts) {
  return part_begin(slots / kernels::slot_padding, part, parts) * kernels::slot_padding;
}

}  // namespace

bool NeighbourList::moved_too_far(const AlignedArray& positions) {
  std::atomic<bool> too_far = false;
  // Points are refreshed in the same pass: it is rarely in vain, and threads wait for each other once less.
  for_each_part(threads_, [&](int part) {
    if (frame_.is_due(positions, first_slot(slots_, part, threads_), first_slot(slots_, part + 1, threads_))) too_far = true;
    points_.refresh(positions, part);
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
  cut_into_blocks();
  const double expected_each = expected_per_row();
  for_each_part(threads_, [&](int part) {
    const auto p = static_cast<std::size_t>(part);
    std::size_t end = 0, rows = 0;
    for (std::size_t b = part_begin(blocks_.size(), part, threads_); b < part_begin(blocks_.size(), part + 1, threads_); ++b)
      rows += blocks_[b].row_count;
    const auto expected = static_cast<std::size_t>(expected_each * static_cast<double>(rows));
    if (neighbours_[p].size() < expected) neighbours_[p].resize(expected);
    for (std::size_t b = part_begin(blocks_.size(), part, threads_); b < part_begin(blocks_.size(), part + 1, threads_); ++b) {
      fill(blocks_[b], p, end);
      end += blocks_[b].padded_neighbours;
    }
    // Vectors of sixteen lanes read on beyond the padding, where only here there is no neighbour of another row.
    neighbours_[p].resize(std::max(neighbours_[p].size(), end + kernels::slot_padding));
    std::fill_n(neighbours_[p].begin() + static_cast<std::ptrdiff_t>(end), kernels::slot_padding, 0U);
  });
  share_out();
  frame_.made_at(positions);
}

void NeighbourList::cut_into_blocks() {
  blocks_.clear();
  std::size_t segments = 0;
  for (std::size_t s = 0; s < points_.species(); ++s) {
    const std::size_t rows = points_.rows(s).size();
    for (std::size_t first = 0; first < rows; first += block_rows) {
      const std::size_t count = std::min(block_rows, rows - first);
      blocks_.push_back({s, first, count, segments, 0, 0, 0});
      segments += count * points_.species();
    }
  }
  lengths_.resize(segments);
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

void NeighbourList::fill(Block& block, std::size_t part, std::size_t begin) {
  AlignedVector<std::uint32_t>& neighbours = neighbours_[part];
  const AlignedVector<std::uint32_t>& rows = points_.rows(block.species);
  std::uint32_t* length = lengths_.data() + block.first_segment;
  std::size_t end = begin;
  for (std::size_t k = block.first_row; k < block.first_row + block.row_count; ++k) {
    const double* position = points_.points() + rows[k];
    for (std::size_t s = 0; s < points_.species(); ++s, ++length) {
      const kernels::NeighbourQuery query{{position[0], position[1], position[2]},
                                          std::max(reaches_[block.species * points_.species() + s], everywhere_),
                                          rows[k] / static_cast<std::uint32_t>(kernels::point_width)};
      const auto search = [&] {
        return table_->points_within(points_.grid(s), query, neighbours.data() + end, neighbours.size() - end);
      };
      std::size_t count = search();
      for (; count + kernels::slot_padding > neighbours.size() - end; count = search())
        neighbours.resize(neighbours.size() + neighbours.size() / 16 + 4096);
      count = without_own_images(rows[k], neighbours.data() + end, count);
      if (exclusions_) count = without_excluded(rows[k], neighbours.data() + end, count);
      // Whole vectors: what is added is never counted.
      std::fill_n(neighbours.begin() + static_cast<std::ptrdiff_t>(end + count), padded(count) - count, rows[k]);
      *length = static_cast<std::uint32_t>(count);
      end += padded(count);
    }
  }
  block.array = part;
  block.first_neighbour = begin;
  block.padded_neighbours = end - begin;
}

void NeighbourList::share_out() {
  const std::size_t parts =
      threads_ == 1 ? 1 : std::clamp<std::size_t>(blocks_.size(), 1, parts_of_thread * static_cast<std::size_t>(threads_));
  std::size_t total = 0, part = 0, so_far = 0;
  for (const Block& block : blocks_) total += block.padded_neighbours;
  first_blocks_.assign(parts + 1, blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    // A part begins with the block in whose first half its share begins.
    while (part < parts && so_far + blocks_[b].padded_neighbours / 2 >= total * part / parts) first_blocks_[part++] = b;
    so_far += blocks_[b].padded_neighbours;
  }
}

int useful_threads(std::size_t particles, int wanted) {
  constexpr std::size_t rows_per_thread = 128;
  return std::clamp(static_cast<int>(std::min<std::size_t>(particles / rows_per_thread, 4096)), 1, wanted);
}

std::size_t NeighbourList::neighbours() const { return std::accumulate(lengths_.begin(), lengths_.end(), std::size_t{0}); }

std::size_t NeighbourList::memory() const {
  std::size_t bytes = points_.memory() + frame_.memory() + boxes_before_.capacity() * sizeof(double) +
                      blocks_.capacity() * sizeof(Block) + lengths_.capacity() * sizeof(std::uint32_t);
  for (const auto& neighbours : neighbours_) bytes += neighbours.capacity() * sizeof(std::uint32_t);
  return bytes;
}

void NeighbourList::exchange(Archive& archive) {
  AlignedArray state = frame_.state();
  archive.field("list_made_at", state);
  if (!archive.reading()) return;
  const Box present = frame_.box();
  const ListFrame::Past past = frame_.past(state, 3 * slots_);
  frame_.forget();
  if (past.made_at.empty()) return;
  set_box(past.box);
  rebuild(past.made_at);
  frame_.take_boxes(past.boxes);
  if (!past.boxes.empty()) for_each_part(threads_, [&](int part) { points_.shift_back({}, past.boxes, part); });
  set_box(present);
}

}  // namespace lanescape
