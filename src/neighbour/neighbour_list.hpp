#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "core/box.hpp"
#include "kernel_table.hpp"
#include "neighbour/half_skin.hpp"
#include "neighbour/periodic_points.hpp"

namespace lanescape {

// Who is near whom: for every particle all others and their images within a cutoff and a skin, species by species. A particle's own
// images are left out, unless asked for: what they do to it is a constant, but for what follows its state.
// The list is made anew as soon as some particle is half the skin from where it was when the list was made: until then two
// particles have come nearer by less than the skin, so that no pair within the cutoff is ever missed.
//
// Rows are cut into blocks of fixed size, which threads share. The list depends on the positions it was made at, and on nothing
// else: they are what has to be archived for the same bits.
class NeighbourList {
 public:
  // What its points are given as: as integers too for kernels in mixed precision.
  enum class Coordinates { floating, floating_and_fixed };
  // Whose points are listed: those in reach; with a particle's own images in reach; every point, for who trusts no list.
  enum class Members { others, with_own_images, every_point };

  // `cutoffs`: species x species, symmetric [sigma].
  NeighbourList(const Box& box, const ParticleLayout& layout, const std::vector<double>& cutoffs, double skin,
                const kernels::KernelTable& table, int threads, Coordinates coordinates = Coordinates::floating,
                Members members = Members::others);

  // To be called before the list is used at new positions (layout's order, wrapped or not).
  void update(const AlignedArray& positions);

  // Puts value [stride x slot] of each particle into the fourth number of its points' records, until the list is made anew.
  void set_values(const AlignedArray& per_slot, std::size_t stride);

  std::size_t species() const { return points_.species(); }
  std::size_t points() const { return points_.size(); }
  std::size_t block_count() const { return blocks_.size(); }
  std::size_t species_of(std::size_t block) const { return blocks_[block].species; }
  kernels::NeighbourRows rows_of(std::size_t block) const;
  // Where a block's neighbours are: which of so many arrays, one for each part, and from where on. For arrays of the same form.
  std::size_t array_of(std::size_t block) const { return blocks_[block].part; }
  std::size_t first_neighbour(std::size_t block) const { return blocks_[block].first_neighbour; }
  std::size_t array_size(std::size_t array) const { return neighbours_[array].size(); }
  // Of the points as integers, 0 if they are not given as such [sigma].
  double fixed_unit() const { return points_.fixed_unit(); }
  // The most rows a block has.
  static constexpr std::size_t block_rows = 32;
  // The slot of the particle that the point at a place is, or is an image of.
  std::uint32_t slot_at(std::uint32_t place) const { return points_.slot(place / kernels::point_width); }
  // Blocks [first_block(part), first_block(part + 1)) are about as much work for every part, one per thread.
  std::size_t first_block(int part) const { return first_blocks_[static_cast<std::size_t>(part)]; }
  int parts() const { return threads_; }

  std::uint64_t rebuilds() const { return rebuilds_; }
  // Neighbours over all rows, each pair from both ends, skin included.
  std::size_t neighbours() const;
  // Of list, points and what it takes to make them [bytes].
  std::size_t memory() const;

  // The positions the list was made at; reading makes it anew there.
  void exchange(Archive& archive);

 private:
  struct Block {
    std::size_t species, first_row, row_count;  // rows of that species
    std::size_t first_segment;                  // in lengths_
    std::size_t part, first_neighbour;          // in neighbours_[part]
    std::size_t padded_neighbours;
  };
  void rebuild(const AlignedArray& positions);
  void cut_into_blocks();
  void fill(Block& block, std::size_t part, std::size_t begin);
  std::size_t without_own_images(std::uint32_t place, std::uint32_t* neighbours, std::size_t count) const;
  void share_out();

  const kernels::KernelTable* table_;
  std::size_t slots_;
  std::vector<double> reaches_;  // cutoff and skin, species x species
  HalfSkin half_skin_;
  bool own_images_left_out_;  // there are some in reach
  double everywhere_;         // reach that finds every point, 0 if only those near are listed
  int threads_;
  PeriodicPoints points_;
  std::vector<Block> blocks_;
  std::vector<std::size_t> first_blocks_;
  double expected_per_row_ = 0.0;                         // places, padding included
  std::vector<AlignedVector<std::uint32_t>> neighbours_;  // of all blocks that a part has made
  AlignedVector<std::uint32_t> lengths_;                  // of all blocks
  std::uint64_t rebuilds_ = 0;
};

// So many threads are worth their waiting for one another, some microseconds per evaluation, of those that are wanted.
int useful_threads(std::size_t particles, int wanted);

}  // namespace lanescape
