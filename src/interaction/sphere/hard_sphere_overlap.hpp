#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/box.hpp"
#include "kernel_table.hpp"
#include "neighbour/sorted_cells.hpp"

namespace lanescape {

// How HardSphereOverlap finds pairs: a kernel tests all of them, or the cells of a grid name the candidates.
enum class SpherePairSearch { by_size, all_pairs, cells };

// Overlaps of hard spheres in any configuration, found from scratch. Decisions are exact (kernels::SphereInput): results have the
// same bits on each instruction set and with each search. Coordinates are in the layout's order. It holds scratch memory, so each
// thread needs its own.
class HardSphereOverlap {
 public:
  // `radii` per particle in the user's order. The search `by_size` takes the cheaper one for that number of particles; large
  // systems cost O(N).
  HardSphereOverlap(const Box& box, const ParticleLayout& layout, const std::vector<double>& radii,
                    const kernels::KernelTable& table, SpherePairSearch search = SpherePairSearch::by_size);

  // All throw Error(bad_input) for a coordinate that is not finite.
  bool any_overlap(const AlignedArray& positions);
  // The smallest r_ij - s_ij [sigma]; infinity for a single particle.
  double smallest_gap(const AlignedArray& positions);
  // Slots of all pairs with r_ij < s_ij + reach, i < j, in the order of kernels::SpherePair, valid until the next call.
  const std::vector<kernels::SpherePair>& pairs_within(const AlignedArray& positions, double reach);

  const Box& box() const { return box_; }
  const AlignedArray& radii() const { return radii_; }  // per slot, NaN for padding
  double largest_radius() const { return largest_radius_; }
  const kernels::KernelTable& table() const { return *table_; }

 private:
  kernels::SphereInput input(const AlignedArray& positions);
  bool cells_are_cheaper(double reach) const;
  SortedCells sorted(const AlignedArray& positions, double reach) const;
  template <class Visit>
  void for_each_near_pair(const AlignedArray& positions, double reach, Visit visit) const;
  void find_pairs_by_cells(const AlignedArray& positions, double reach);
  void find_pairs_among_all(const AlignedArray& positions, double reach);
  void sort_pairs();

  const kernels::KernelTable* table_;
  Box box_;
  SpherePairSearch search_;
  std::size_t particles_;
  AlignedArray radii_;
  double largest_radius_;
  std::vector<std::int32_t, AlignedAllocator<std::int32_t>> fractions_;
  std::vector<float, AlignedAllocator<float>> reaches_;
  std::vector<kernels::SpherePair> pairs_, unsorted_;
  std::vector<std::size_t> tile_ends_;
};

}  // namespace lanescape
