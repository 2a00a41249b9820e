#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "kernel_table.hpp"
#include "neighbour/kept_array.hpp"
#include "neighbour/pair_points.hpp"
#include "neighbour/pair_rows.hpp"

namespace lanescape {

// The largest number of boxes within a cutoff along a periodic axis, and away from the origin of the box.
inline constexpr double max_boxes_in_cutoff = 32.0;
inline constexpr double max_boxes_away = 1e9;

struct PairFinderOptions {
  std::vector<double> cutoffs;  // species x species, symmetric; 0: such pairs are never listed
  std::array<bool, 3> periodic{true, true, true};
  Point origin{};
  bool half = false, sorted = true;
  bool first = true, second = true, shifts = true, separations = true, distances = true, segments = false;  // what is wanted
  int threads = 1;
};

// Views of the finder's arrays; what is not wanted is empty.
struct FoundPairs {
  std::size_t count = 0;
  std::span<const std::int64_t> first, second;
  std::span<const std::int32_t> shifts;  // 3 per pair
  std::span<const double> separations;   // 3 per pair
  std::span<const double> distances;
  std::span<const std::int64_t> segments;  // rows + 1: the first pair of each, and the number of pairs
};

// Finds pairs within a cutoff and keeps its memory. Rows are searched in the order of space, each list of neighbours then goes to
// its place in the arrays. Results do not depend on the number of threads nor, if sorted, on the instruction set.
class PairFinder {
 public:
  PairFinder(PairFinderOptions options, const kernels::KernelTable& table);

  // Pairs i j that are never listed, in either direction.
  void exclude(std::span<const std::pair<std::int64_t, std::int64_t>> pairs);

  void set_particles(std::span<const double> positions, const Point& edges, std::span<const std::int32_t> species);
  FoundPairs pairs();
  // Neighbours of positions that are no particles; `first` numbers the positions.
  FoundPairs neighbours(std::span<const double> positions, std::span<const std::int32_t> species);

 private:
  struct Part {
    KeptArray<std::uint32_t> numbers, found, spare;
    std::array<KeptArray<float>, 3> columns;
    KeptArray<double> separations;
    std::size_t room = 0, group_room = 0, longest = 0;
  };

  void check_space(const Point& edges) const;
  void check_particles(std::span<const double> positions, std::span<const std::int32_t> species, const char* what) const;
  Point greatest_of(std::span<const double> positions) const;
  PairRule rule(bool between_particles) const;
  FoundPairs find(const PairRow* rows, std::size_t count, const PairRule& rule, bool half);
  void search(int part, const PairRow* rows, std::size_t count, const PairRule& rule, bool half);
  std::size_t first_row(std::size_t count, int part) const;
  // The end of the group of rows that starts at `begin`: those near each other.
  std::size_t group_end(const PairRow* rows, std::size_t begin, std::size_t end) const;
  // Appends the points near each row of a group to the `used` numbers of a part.
  void search_group(Part& part, const PairRow* rows, std::size_t begin, std::size_t end, std::size_t used);
  void keep_later(const PairRow& row, std::uint32_t* numbers, std::uint32_t& count) const;
  void keep(const PairRule& rule, const PairRow& row, std::uint32_t* numbers, std::uint32_t& count) const;
  void place_rows(const PairRow* rows, std::size_t count);
  void write(int part, const PairRow* rows, std::size_t count, const PairRule& rule);
  PairArrays make_room(std::size_t pairs);

  PairFinderOptions options_;
  const kernels::KernelTable* table_;
  std::size_t species_ = 1;
  double cutoff_ = 0.0;  // the greatest
  bool is_ready_ = false;
  PairSpace space_;
  PairPoints points_;
  std::vector<double> positions_;
  std::vector<std::int32_t> particle_species_;
  std::vector<std::pair<std::int64_t, std::int64_t>> exclusions_;
  std::vector<std::size_t> first_excluded_;
  std::vector<std::int64_t> excluded_;
  std::vector<Part> parts_;
  KeptArray<std::uint32_t> counts_;
  KeptArray<std::uint8_t> doubtful_;
  KeptArray<std::int64_t> segments_;
  KeptArray<PairRow> query_rows_;
  KeptArray<std::int64_t> first_, second_;
  KeptArray<std::int32_t> shifts_;
  KeptArray<double> separations_, distances_;
  PairArrays arrays_;
};

}  // namespace lanescape
