#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/box.hpp"
#include "kernel_table.hpp"
#include "neighbour/sorted_cells.hpp"

namespace lanescape {

// Slots of overlapping pairs, first < second.
struct ContactPairs {
  const std::int32_t *places, *first, *second;
  std::size_t count;

  kernels::SpherePair operator[](std::size_t k) const { return {first[places[k]], second[places[k]]}; }
};

// r_ij - s_ij of two particles, nearest image [sigma].
double sphere_gap(const Configuration& configuration, std::size_t i, std::size_t j);
// Throws Error(bad_input) where a box edge is below twice the largest diameter: a sphere could touch two images of another.
void check_box_holds_spheres(const Configuration& configuration);
// The same, and naming pair and depth where two spheres overlap.
void check_no_overlap(const Configuration& configuration, const kernels::KernelTable& table);

// How HardSphereOverlap finds its pairs: the kernels look at all of them, or the cells of a grid name those to be looked at.
enum class SpherePairSearch { by_size, all_pairs, cells };

// Overlaps of hard spheres, whatever configuration comes; decisions are exact (kernels::SphereInput), and results have the same
// bits on each instruction set and with each search. Coordinates are in the layout's order. Holds scratch memory: each thread needs
// its own.
class HardSphereOverlap {
 public:
  // `radii` per particle in the user's order. By size, the search is what costs less at that number of particles; large systems
  // cost O(N).
  HardSphereOverlap(const Box& box, const ParticleLayout& layout, const std::vector<double>& radii,
                    const kernels::KernelTable& table, SpherePairSearch search = SpherePairSearch::by_size);

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
  bool cells_pay(double reach) const;
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

// The same for a configuration that moves little by little: a list of the pairs with r < s + skin, made anew as soon as some
// particle is skin/2 away from where it was when the list was made. Until then two particles have come nearer by less than
// the skin: no pair can be missed.
class HardSphereList {
 public:
  HardSphereList(HardSphereOverlap& spheres, double skin);

  bool any_overlap(const AlignedArray& positions);
  // The overlapping pairs, valid until the next call.
  ContactPairs find_contacts(const AlignedArray& positions);
  // Adds the fictitious forces between them to `force`.
  void add_contact_forces(kernels::ContactPotential potential, AlignedArray& force);

  std::uint64_t rebuilds() const { return rebuilds_; }
  std::size_t pairs() const { return list_.count; }

 private:
  void renew_where_due(const AlignedArray& positions);
  void rebuild(const AlignedArray& positions);

  HardSphereOverlap* spheres_;
  double skin_;
  AlignedArray made_at_;
  std::uint64_t rebuilds_ = 0;
  std::vector<std::int32_t, AlignedAllocator<std::int32_t>> first_, second_, places_;
  AlignedArray shift_[3], contact_;
  AlignedArray separation_[3], squared_, force_[3];
  kernels::SphereList list_{};
  kernels::SphereContacts contacts_{};
  std::size_t contact_count_ = 0;
};

}  // namespace lanescape
