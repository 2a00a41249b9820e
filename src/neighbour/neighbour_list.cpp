#include "neighbour/neighbour_list.hpp"

#include <algorithm>

#include "core/parallel.hpp"

namespace lanescape {
namespace {

std::size_t padded(std::size_t n) { return (n + kernels::slot_padding - 1) / kernels::slot_padding * kernels::slot_padding; }

std::vector<double> with_skin(std::vector<double> cutoffs, double skin) {
  for (double& cutoff : cutoffs) cutoff += skin;
  return cutoffs;
}

// For each species the furthest that anything looks for it.
std::vector<double> margins(const std::vector<double>& reaches, std::size_t species) {
  std::vector<double> margins(species, 0.0);
  for (std::size_t k = 0; k < reaches.size(); ++k) margins[k % species] = std::max(margins[k % species], reaches[k]);
  return margins;
}

}  // namespace

NeighbourList::NeighbourList(const Box& box, const ParticleLayout& layout, const std::vector<double>& cutoffs, double skin,
                             const kernels::KernelTable& table, int threads)
    : table_(&table),
      slots_(layout.slots()),
      reaches_(with_skin(cutoffs, skin)),
      skin_(skin),
      own_images_in_reach_(std::any_of(reaches_.begin(), reaches_.end(), [&](double reach) { return reach >= box.shortest(); })),
      threads_(threads),
      points_(box, layout, margins(reaches_, layout.blocks().size()), threads),
      scratch_(static_cast<std::size_t>(threads)) {}

kernels::NeighbourRows NeighbourList::rows_of(std::size_t block) const {
  const Block& b = blocks_[block];
  return {points_.points(), b.rows.data(), b.rows.size(), b.neighbours.data(), b.lengths.data(), points_.species()};
}

void NeighbourList::update(const AlignedArray& positions) {
  if (made_at_.empty() || moved_too_far(positions))
    rebuild(positions);
  else
    points_.refresh(positions);
}

bool NeighbourList::moved_too_far(const AlignedArray& positions) const {
  // A little less than half the skin: the displacement is rounded too.
  const double allowed = 0.499 * skin_;
  std::vector<double> furthest(static_cast<std::size_t>(threads_));
  const std::size_t units = slots_ / kernels::slot_padding;
  for_each_part(threads_, [&](int part) {
    furthest[static_cast<std::size_t>(part)] = table_->largest_displacement_squared(
        made_at_.data(), positions.data(), slots_, part_begin(units, part, threads_) * kernels::slot_padding,
        part_begin(units, part + 1, threads_) * kernels::slot_padding);
  });
  return !std::all_of(furthest.begin(), furthest.end(), [&](double squared) { return squared <= allowed * allowed; });
}

void NeighbourList::rebuild(const AlignedArray& positions) {
  ++rebuilds_;
  made_at_ = positions;
  points_.sort(positions);
  cut_into_blocks();
  for_each_part(threads_, [&](int part) {
    for (std::size_t b = part_begin(blocks_.size(), part, threads_); b < part_begin(blocks_.size(), part + 1, threads_); ++b)
      fill(blocks_[b], scratch_[static_cast<std::size_t>(part)]);
  });
  share_out();
}

void NeighbourList::cut_into_blocks() {
  std::size_t count = 0;
  for (std::size_t s = 0; s < points_.species(); ++s) count += (points_.rows(s).size() + block_rows - 1) / block_rows;
  blocks_.resize(count);
  auto block = blocks_.begin();
  for (std::size_t s = 0; s < points_.species(); ++s) {
    const std::vector<std::uint32_t>& rows = points_.rows(s);
    for (std::size_t first = 0; first < rows.size(); first += block_rows, ++block) {
      block->species = s;
      block->rows.clear();
      for (std::size_t k = first; k < std::min(first + block_rows, rows.size()); ++k)
        block->rows.push_back(static_cast<std::uint32_t>(kernels::point_width * rows[k]));
    }
  }
}

std::size_t NeighbourList::without_own_images(std::uint32_t place, std::uint32_t* neighbours, std::size_t count) const {
  if (!own_images_in_reach_) return count;
  const auto slot = [&](std::uint32_t of) { return points_.slot(of / kernels::point_width); };
  return static_cast<std::size_t>(
      std::remove_if(neighbours, neighbours + count, [&](std::uint32_t other) { return slot(other) == slot(place); }) - neighbours);
}

void NeighbourList::fill(Block& block, std::vector<std::uint32_t>& found) const {
  block.lengths.clear();
  std::size_t end = 0;
  for (const std::uint32_t place : block.rows) {
    const double* position = points_.points() + place;
    for (std::size_t s = 0; s < points_.species(); ++s) {
      const kernels::NeighbourQuery query{{position[0], position[1], position[2]},
                                          reaches_[block.species * points_.species() + s],
                                          place / static_cast<std::uint32_t>(kernels::point_width)};
      std::size_t count = 0;
      while ((count = table_->points_within(points_.grid(s), query, found.data() + end, found.size() - end)) > found.size() - end)
        found.resize(2 * found.size() + 1024);
      count = without_own_images(place, found.data() + end, count);
      if (found.size() < end + padded(count)) found.resize(end + padded(count));
      std::fill_n(found.begin() + static_cast<std::ptrdiff_t>(end + count), padded(count) - count, place);
      block.lengths.push_back(static_cast<std::uint32_t>(count));
      end += padded(count);
    }
  }
  block.neighbours.assign(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(end));
}

void NeighbourList::share_out() {
  std::size_t total = 0, part = 0, so_far = 0;
  for (const Block& block : blocks_) total += block.neighbours.size();
  first_blocks_.assign(static_cast<std::size_t>(threads_) + 1, blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    // A part begins with the block in whose first half its share begins.
    while (part < static_cast<std::size_t>(threads_) &&
           so_far + blocks_[b].neighbours.size() / 2 >= part_begin(total, static_cast<int>(part), threads_))
      first_blocks_[part++] = b;
    so_far += blocks_[b].neighbours.size();
  }
}

std::size_t NeighbourList::neighbours() const {
  std::size_t count = 0;
  for (const Block& block : blocks_)
    for (const std::uint32_t length : block.lengths) count += length;
  return count;
}

std::size_t NeighbourList::memory() const {
  std::size_t bytes = points_.memory() + made_at_.capacity() * sizeof(double);
  for (const Block& block : blocks_)
    bytes +=
        sizeof(Block) + (block.rows.capacity() + block.neighbours.capacity() + block.lengths.capacity()) * sizeof(std::uint32_t);
  return bytes;
}

void NeighbourList::exchange(Archive& archive) {
  archive.field("list_made_at", made_at_);
  if (archive.reading() && !made_at_.empty()) rebuild(AlignedArray(made_at_));
}

}  // namespace lanescape
