#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "neighbour/kept_array.hpp"
#include "views/pair.hpp"

namespace lanescape {

// Neighbour lists as a host has made them, of points that are particles or ghosts: images of particles, and particles of others.
struct HostLists {
  std::span<const int> species;            // of each point; below 0: it interacts with nothing
  std::span<const int> rows;               // the points that have a list
  const int* const* neighbours = nullptr;  // of point i: neighbours[i], lengths[i] of them
  const int* lengths = nullptr;
  std::uint32_t mask = ~0U;  // the bits of a neighbour that number a point
};

// Throws Error(bad_input), naming the row, for points that do not exist.
void check_lists(const HostLists& lists, int threads);

// Lists of a host as kernels take them: rows by species, in blocks that threads share; their neighbours by species, in whole
// vectors.
class HostRows {
 public:
  // Whose rows hold a listed pair: those of the point that lists it, or those of both.
  enum class Ends { listing, both };
  // The neighbours that count: all; points with a list of their own; points without.
  enum class Partners { all, with_list, ghosts };

  HostRows(std::size_t species, Ends ends, Partners partners) : species_(species), ends_(ends), partners_(partners) {}

  // Lists that check_lists() has seen.
  void assign(const HostLists& lists, int threads);

  std::size_t block_count() const { return blocks_.size(); }
  std::size_t species_of(std::size_t block) const { return blocks_[block].species; }
  // `points`: records of kernels::point_width doubles in the host's order.
  kernels::NeighbourRows rows_of(std::size_t block, const double* points) const;
  static constexpr std::size_t block_rows = 32;
  static constexpr std::size_t most_species = 255;

 private:
  struct Block {
    std::size_t species, first_row, row_count, first_neighbour;
  };
  static constexpr std::uint8_t none = 255;

  void find_keys(const HostLists& lists);
  // Sorts these points by species, each with room for `needed(point)` neighbours, a multiple of slot_padding, and cuts them into
  // blocks.
  template <class Needed>
  void cut_into_blocks(const HostLists& lists, std::span<const int> points, Needed needed);
  void fill(const HostLists& lists, const Block& block);
  void assign_both_ends(const HostLists& lists);
  void assign_both_ends_of_one_species(const HostLists& lists);
  void make_rows_of_both_ends(const HostLists& lists);
  // Those that count.
  void find_pairs(const HostLists& lists);

  std::size_t species_;
  Ends ends_;
  Partners partners_;
  std::vector<std::uint8_t> keys_;  // of each point as a neighbour: its species, or `none`
  bool one_key_ = false;            // all of them are 0
  std::vector<std::uint32_t> rows_;
  std::vector<Block> blocks_;
  KeptArray<std::uint32_t> neighbours_, lengths_;
  // Scratch of both ends: pairs; how many of each species each point has, and where the next one goes; points that have any.
  struct Pair {
    std::uint32_t first, second;
  };
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> counts_;
  std::vector<std::uint32_t*> next_;
  std::vector<int> points_;
};

}  // namespace lanescape
