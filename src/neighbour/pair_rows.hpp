#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/point.hpp"
#include "kernel_table.hpp"
#include "neighbour/kept_array.hpp"
#include "neighbour/pair_points.hpp"

namespace lanescape {

// Which of the points near a row are its neighbours: d < cutoff with D = (r_j - r_i) + S L, each operation rounded to double, in
// the order of ASE's neighbor_list. Pairs at the cutoff are therefore the same in both, on every instruction set.
struct PairRule {
  Point edges{};                    // of the box; 0 along open axes
  std::span<const double> cutoffs;  // species x species; 0: such a pair is never listed
  std::size_t species = 1;
  // Particles that are no neighbours of particle i: excluded[k] for k from first_excluded[i]. Empty: none.
  std::span<const std::size_t> first_excluded;
  std::span<const std::int64_t> excluded;

  // Whether points within the cutoff are neighbours without further questions.
  bool is_plain() const { return species == 1 && first_excluded.empty(); }
};

// Where pairs are written; null: not wanted.
struct PairArrays {
  std::int64_t *first = nullptr, *second = nullptr;
  std::int32_t* shifts = nullptr;                       // 3 per pair
  double *separations = nullptr, *distances = nullptr;  // 3 and 1 per pair
};

// Removes those points that are no neighbours of a row; returns how many are left, in the same order.
std::size_t keep_neighbours(const PairRule& rule, const PairRow& row, const PairPoint* points, std::uint32_t* numbers,
                            std::size_t count);

// Writes the pairs of a row with these points from place `begin` of each array on. `spare` has room for three numbers per point.
void write_pairs(const PairRule& rule, const PairRow& row, const PairPoint* points, std::span<const std::uint32_t> numbers,
                 const PairArrays& out, std::size_t begin, double* spare);

// Sorts numbers below 2^31, all different; `spare` has room for them and 32 more, as `numbers` has.
void sort_numbers(std::uint32_t* numbers, std::size_t count, std::uint32_t* spare, const kernels::KernelTable& table);

}  // namespace lanescape
