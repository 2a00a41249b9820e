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

// Overlaps of hard spheres over all pairs, by the kernels of one instruction set; decisions are exact (kernels::SphereInput) and
// the same on each. Coordinates are in the layout's order. Holds scratch memory: each thread needs its own.
class HardSphereOverlap {
 public:
  // `radii` per particle in the user's order.
  HardSphereOverlap(const Box& box, const ParticleLayout& layout, const std::vector<double>& radii,
                    const kernels::KernelTable& table);

  bool any_overlap(const AlignedArray& positions) { return table_->sphere_any_overlap(input(positions)); }
  // The smallest r_ij - s_ij [sigma]; infinity for a single particle.
  double smallest_gap(const AlignedArray& positions) { return table_->sphere_smallest_gap(input(positions)); }
  // Slots of all pairs with r_ij < s_ij + reach, i < j, valid until the next call.
  const std::vector<kernels::SpherePair>& pairs_within(const AlignedArray& positions, double reach);

  const Box& box() const { return box_; }
  const AlignedArray& radii() const { return radii_; }  // per slot, NaN for padding
  const kernels::KernelTable& table() const { return *table_; }

 private:
  kernels::SphereInput input(const AlignedArray& positions);

  const kernels::KernelTable* table_;
  Box box_;
  AlignedArray radii_;
  std::vector<std::int32_t, AlignedAllocator<std::int32_t>> fractions_;
  std::vector<float, AlignedAllocator<float>> reaches_;
  std::vector<kernels::SpherePair> pairs_;
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
