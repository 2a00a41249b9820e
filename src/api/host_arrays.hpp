#pragma once

#include <lanescape/potential.hpp>

#include <cstddef>
#include <span>

#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"

namespace lanescape {

// Throw Error(bad_input) where an array of the host has not the length that N particles need.
void check_positions(std::size_t given, std::size_t particles);
void check_positions(const Vectors<const double>& given, std::size_t particles);  // null pointers too
void check_room(const char* what, std::size_t given, std::size_t needed);
void check_forces(const Vectors<double>& given, std::size_t particles);
// Throws Error(bad_input) naming the coordinate; slow, for this message.
void name_what_is_not_finite(const Vectors<const double>& host);

// Arrays of a host, in the user's order, and the library's, in the layout's. Keeps the memory of both directions.
class HostArrays {
 public:
  explicit HostArrays(const ParticleLayout& layout) : layout_(layout), positions_(layout.dimension(), 0.0), gradient_(positions_) {}

  const ParticleLayout& layout() const { return layout_; }
  // Throws Error(bad_input) for another number of particles, and naming a coordinate that is not finite.
  const AlignedArray& positions(const Vectors<const double>& host);
  AlignedArray& gradient() { return gradient_; }
  AlignedArray& energies();  // of each slot
  // Throws Error(bad_input) for outputs that have no room for these particles.
  void check_room_of(const Outputs& outputs) const;
  // Writes dV/dr, or -dV/dr, of the array above to the host; there is room.
  void write_gradient(std::span<double> host) const;
  void write_forces(const Vectors<double>& host) const;
  void add_forces(const Vectors<double>& host) const;
  void write_energies(std::span<double> host) const;

 private:
  // put(component of the host's, of the gradient)
  template <class Put>
  void for_each_force(const Vectors<double>& host, Put put) const;

  ParticleLayout layout_;
  AlignedArray positions_, gradient_, energies_;
};

}  // namespace lanescape
