#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "core/box.hpp"
#include "core/slot_work.hpp"
#include "kernel_table.hpp"
#include "neighbour/exclusions.hpp"
#include "neighbour/kept_array.hpp"
#include "neighbour/list_frame.hpp"
#include "neighbour/periodic_points.hpp"

namespace lanescape {

// A neighbour list: for each particle all others and their images within cutoff plus skin, species by species. A particle's own
// images are omitted by default: their energy is a constant, except for sites in states.
// The list is rebuilt once a particle is half the skin away from where it was at the last rebuild (ListFrame), so no pair within
// the cutoff is missed. Neither particles that are shifted by whole boxes nor small changes of the box count as displacements.
//
// Rows are cut into blocks of fixed size, which threads share. The list depends on nothing but positions and box of the last
// rebuild: archiving them preserves the bits.
class NeighbourList {
 public:
  // The representation of points: kernels in mixed precision need integers too.
  enum class Coordinates { floating, floating_and_fixed };
  // The points listed: those in reach; with a particle's own images in reach; all points: brute force, to check the list.
  enum class Members { others, with_own_images, every_point };

  // `cutoffs`: species x species, symmetric [sigma].
  NeighbourList(const Box& box, const ParticleLayout& layout, const std::vector<double>& cutoffs, double skin,
                const kernels::KernelTable& table, int threads, Coordinates coordinates = Coordinates::floating,
                Members members = Members::others);

  // Call it before the list is used at new positions (layout's order, wrapped or not), to which `move` brings the particles, if there
  // is one.
  void update(const AlignedArray& positions, const SlotWork& move = {});
  // Takes another box for the next update(). Rebuilds the list then only if this one does not outlast the change.
  void set_box(const Box& box);
  // Leaves these pairs out of the next lists, with no other than their nearest image when a list is made; null: none. Pairs may be
  // as near as they like.
  void set_exclusions(std::shared_ptr<const Exclusions> exclusions);
  // The next update() rebuilds the list.
  void forget() { frame_.forget(); }

  // Copies value [stride x slot] of each particle into the fourth number of its points' records, until the next rebuild.
  void set_values(const AlignedArray& per_slot, std::size_t stride);

  std::size_t species() const { return points_.species(); }
  std::size_t points() const { return points_.size(); }
  std::size_t block_count() const { return blocks_.size(); }
  std::size_t species_of(std::size_t block) const { return blocks_[block].species; }
  kernels::NeighbourRows rows_of(std::size_t block) const;
  // The array that holds a block's neighbours, and the offset of the first. For arrays of the same shape.
  std::size_t arrays() const { return writers_.size(); }
  std::size_t array_of(std::size_t block) const { return blocks_[block].array; }
  std::size_t first_neighbour(std::size_t block) const { return blocks_[block].first_neighbour; }
  std::size_t array_size(std::size_t array) const { return writers_[array].end + kernels::slot_padding; }
  // The unit of the points as integers; 0 without them [sigma].
  double fixed_unit() const { return points_.fixed_unit(); }
  // Parts for each thread: what is left over when a thread has ended is small.
  static constexpr std::size_t parts_of_thread = 8;
  // The largest number of rows in a block.
  static constexpr std::size_t block_rows = 32;
  // The slot of the particle that the point at this offset is, or is an image of.
  std::uint32_t slot_at(std::uint32_t place) const { return points_.slot(place / kernels::point_width); }
  // Blocks [first_block(part), first_block(part + 1)) are about the same work for each part. There are several parts for each
  // thread.
  std::size_t first_block(std::size_t part) const { return first_blocks_[part]; }
  std::size_t parts() const { return first_blocks_.size() - 1; }
  int threads() const { return threads_; }

  std::uint64_t rebuilds() const { return rebuilds_; }
  // Neighbours over all rows, each pair from both ends, skin included.
  std::size_t neighbours() const;
  // Memory of list, points and scratch arrays [bytes].
  std::size_t memory() const;

  // Archives where the list was made; reading rebuilds it there.
  void exchange(Archive& archive);

 private:
  struct Block {
    std::size_t species, first_row, row_count;  // rows of that species
    std::size_t first_segment;                  // in lengths_
    std::size_t array, first_neighbour;         // of the writer that has made it
    std::size_t padded_neighbours;
  };
  // The columns near those that rows are in, and memory for copies of points there.
  struct Nearby {
    KeptArray<std::uint32_t> first_cells;
    KeptArray<double> cells;
    kernels::NearColumns columns{};
    KeptArray<float> coordinates;  // one after the other
    KeptArray<std::uint32_t> offsets;
  };
  // What is written for a part of the blocks: their neighbours; and scratch of the search.
  struct alignas(64) Writer {
    KeptArray<std::uint32_t> neighbours;
    std::size_t end = 0;
    // Of each species what is near the rows that search.
    std::vector<Nearby> nearby;
    std::vector<kernels::NearPoints> near;  // of each species
    void make_room(std::size_t more);
  };
  // A column of cells of the rows' own species.
  struct Column {
    std::size_t x, y;
    bool operator==(const Column&) const = default;
  };
  // Rows of a block that follow each other in a column and search together.
  struct RowGroup {
    std::size_t count;
    std::array<kernels::GroupRow, kernels::most_group_rows> rows;
  };
  void rebuild(const AlignedArray& positions);
  // For a new list in this box.
  void prepare(const Box& box);
  bool moved_too_far(const AlignedArray& positions, const SlotWork& move);
  // Whether that was due to whole boxes alone, which are then taken out.
  bool take_out_boxes(const AlignedArray& positions);
  void cut_into_blocks(const ParticleLayout& layout);
  // Reach of a search from a row of one species for points of another.
  double reach(std::size_t from, std::size_t of) const { return std::max(reaches_[from * species() + of], everywhere_); }
  void fill(Block& block, Writer& writer);
  // `grid`: that of the rows' own species.
  Column column_of(std::uint32_t place, const kernels::PointGrid& grid) const;
  RowGroup group_at(const Block& block, std::size_t row, const Column& column, const kernels::PointGrid& grid) const;
  // Finds the columns near one of a species.
  void look_around(const Column& column, std::size_t species, Writer& writer) const;
  // Copies the points of a species near a group; returns their number.
  std::size_t copy_near(const RowGroup& group, std::size_t of, Writer& writer) const;
  // Takes out of rows that were just put into a list what does not belong there; returns what they then take up.
  std::size_t shorten(const RowGroup& group, std::uint32_t* neighbours, std::uint32_t* lengths) const;
  std::size_t without_own_images(std::uint32_t place, std::uint32_t* neighbours, std::size_t count) const;
  std::size_t without_excluded(std::uint32_t place, std::uint32_t* neighbours, std::size_t count) const;
  // Cuts blocks into parts of about the same work(block).
  template <class Work>
  void share_out(Work work);
  double expected_per_row(std::size_t species) const;  // offsets, padding included

  const kernels::KernelTable* table_;
  std::size_t slots_;
  std::vector<double> reaches_;  // cutoff and skin, species x species
  Members members_;
  ListFrame frame_;
  AlignedArray boxes_before_;  // scratch
  std::shared_ptr<const Exclusions> exclusions_;
  bool own_images_left_out_ = false;  // and some are in reach
  double everywhere_ = 0.0;           // reach that finds all points, 0 if only those near are listed
  int threads_;
  PeriodicPoints points_;
  std::vector<Block> blocks_;
  std::vector<std::size_t> first_blocks_;
  std::vector<double> counts_;        // particles of each species
  std::vector<double> expected_;      // padded neighbours of a row of each species
  std::vector<Writer> writers_;       // one for each part
  KeptArray<std::uint32_t> lengths_;  // of all blocks
  std::size_t segments_ = 0;
  std::uint64_t rebuilds_ = 0;
};

// The number of threads, at most `wanted`, that pay for their synchronisation of some microseconds per evaluation.
int useful_threads(std::size_t particles, int wanted);

}  // namespace lanescape
