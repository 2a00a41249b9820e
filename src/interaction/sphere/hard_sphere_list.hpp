#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/aligned_array.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"
#include "kernel_table.hpp"
#include "neighbour/half_skin.hpp"

namespace lanescape {

// Slots of overlapping pairs, first < second.
struct ContactPairs {
  const std::int32_t *offsets, *first, *second;
  std::size_t count;

  kernels::SpherePair operator[](std::size_t k) const { return {first[offsets[k]], second[offsets[k]]}; }
};

// Overlaps of hard spheres that move in small steps: a list holds the pairs with r < s + skin and is rebuilt as HalfSkin says, so
// that no pair is missed.
class HardSphereList {
 public:
  HardSphereList(HardSphereOverlap& spheres, double skin);

  bool any_overlap(const AlignedArray& positions);
  // The overlapping pairs, valid until the next call.
  ContactPairs find_contacts(const AlignedArray& positions);
  // Adds the fictitious forces of the pairs found last to `force`.
  void add_contact_forces(kernels::ContactPotential potential, AlignedArray& force);

  // Adds `force`, scaled to length 1 in 3N space, to `sum` and zeroes it. `trial` is `position` with each particle that has a sum
  // moved by `step` along it [sigma]. Returns how many particles moved ([G] Eqs. 3.29-3.33).
  std::size_t avoidance_trial(AlignedArray& trial, const AlignedArray& position, AlignedArray& sum, AlignedArray& force,
                              double step) const;

  std::uint64_t rebuilds() const { return rebuilds_; }
  std::size_t pairs() const { return list_.count; }

 private:
  void update(const AlignedArray& positions);
  void rebuild(const AlignedArray& positions);
  void make_room(std::size_t count);

  HardSphereOverlap* spheres_;
  HalfSkin half_skin_;
  std::uint64_t rebuilds_ = 0;
  std::vector<std::int32_t, AlignedAllocator<std::int32_t>> first_, second_, offsets_;
  AlignedArray shift_[3], contact_;
  AlignedArray separation_[3], squared_, force_[3];
  kernels::SphereList list_{};
  kernels::SphereContacts contacts_{};
  std::size_t contact_count_ = 0;
};

}  // namespace lanescape
