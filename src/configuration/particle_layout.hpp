#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "configuration/configuration.hpp"
#include "core/aligned_array.hpp"
#include "views/layout.hpp"

namespace lanescape {

// Particles sorted by columns of the box along z, about three particles wide, and by z within each column. Positions x0 y0 z0 x1
// ... are finite.
std::vector<std::size_t> order_in_space(std::span<const double> positions, const Box& box);

// The library's own order of particles: species in blocks, each padded to whole vectors, coordinates as three arrays of
// `slots` doubles in one AlignedArray (all x, all y, all z). Padding slots hold zeros. Public data are in the user's
// order; only this class translates.
class ParticleLayout {
 public:
  // Keeps the user's order within a species. All constructors throw what check_species() throws.
  ParticleLayout(const std::vector<int>& species, std::size_t species_count);
  // Sorts large systems (`sorted_from` particles or more) by position within a species, as neighbour lists sort their
  // points: particles near in space are then near in memory, until they diffuse away.
  static ParticleLayout in_space_order(const Configuration& configuration, std::size_t species_count);
  static constexpr std::size_t sorted_from = 2000;
  // Within a species in the order of these particles, each of which is named once.
  static ParticleLayout in_order(const Configuration& configuration, std::size_t species_count,
                                 std::span<const std::size_t> particles);
  // Within a species in the user's order, whatever the size.
  static ParticleLayout in_users_order(const Configuration& configuration, std::size_t species_count);

  std::size_t size() const { return slot_of_.size(); }  // N
  std::size_t slots() const { return slots_; }          // padded
  std::size_t dimension() const { return 3 * slots_; }  // length of every coordinate array
  const std::vector<kernels::SpeciesBlock>& blocks() const { return blocks_; }
  std::size_t slot_of(std::size_t particle) const { return slot_of_[particle]; }
  std::vector<std::size_t> order() const;  // particles in the order of their slots
  // One per slot, zero for padding; empty where the configuration has none [sigma].
  const AlignedArray& diameters() const { return diameters_; }

  // The same layout with diameters in another unit of length.
  ParticleLayout in_unit(double unit) const;

  // Convert 3N interleaved user coordinates to slots, and back.
  AlignedArray to_slots(std::span<const double> interleaved) const;
  std::vector<double> to_user(const AlignedArray& coordinates) const;
  // The same into memory of the caller: dimension() numbers, of which padding is left as it is, and 3N.
  void put_slots(std::span<const double> interleaved, AlignedArray& coordinates) const;
  void put_user(const AlignedArray& coordinates, std::span<double> interleaved) const;
  // One value per slot, from one per particle in the user's order; padding slots get `padding`.
  AlignedArray per_slot(std::span<const double> per_particle, double padding) const;

 private:
  ParticleLayout() = default;
  // Slots in the order of `particles`.
  void assign(const std::vector<int>& species, std::size_t species_count, std::span<const std::size_t> particles);

  std::vector<std::size_t> slot_of_;
  std::vector<kernels::SpeciesBlock> blocks_;
  std::size_t slots_ = 0;
  AlignedArray diameters_;
};

}  // namespace lanescape
