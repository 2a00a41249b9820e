// The path finder's inner loop: which pairs of a short list overlap, the fictitious forces between them, and the next trial from
// these forces. The list holds every pair that can overlap while no particle has moved by more than half its skin. Its images are
// fixed, so no nearest image is searched.

#include "kernel_declarations.hpp"
#include "simd/simd.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
namespace {

struct Separation {
  Vector x, y, z, squared, contact;
  Mask overlapping;
};

// Products and sums are rounded one by one, as in sphere_overlap.cpp, so both files take the same decisions.
inline Separation separation(const SphereList& list, const double* positions, std::size_t slots, std::size_t k) noexcept {
  const auto along = [&](const double* x, const double* shift) {
    return (gather(x, list.second + k) - gather(x, list.first + k)) - load(shift + k);
  };
  Separation s;
  s.x = along(positions, list.shift_x);
  s.y = along(positions + slots, list.shift_y);
  s.z = along(positions + 2 * slots, list.shift_z);
  s.squared = (s.x * s.x + s.y * s.y) + s.z * s.z;
  s.contact = load(list.contact + k);
  s.overlapping = less(s.squared, s.contact * s.contact);
  return s;
}

}  // namespace

bool sphere_list_any_overlap(const SphereList& list, const double* positions, std::size_t slots) noexcept {
  for (std::size_t k = 0; k < list.count; k += lanes)
    if (any(separation(list, positions, slots, k).overlapping)) return true;
  return false;
}

std::size_t sphere_list_contacts(const SphereList& list, const double* positions, std::size_t slots,
                                 const SphereContacts& out) noexcept {
  std::size_t count = 0;
  for (std::size_t k = 0; k < list.count; k += lanes) {
    const Separation s = separation(list, positions, slots, k);
    store(out.x + k, s.x);
    store(out.y + k, s.y);
    store(out.z + k, s.z);
    store(out.squared + k, s.squared);
    count += compress_store_lanes(out.places + count, bits(s.overlapping), static_cast<std::int32_t>(k));
  }
  // Whole vectors of offsets are read, so the entries after the last one must be valid offsets too.
  for (std::size_t k = 0; k < lanes; ++k) out.places[count + k] = 0;
  return count;
}

void sphere_contact_forces(const SphereList& list, const SphereContacts& contacts, std::size_t count, ContactPotential potential,
                           double* force, std::size_t slots) noexcept {
  // First, the forces on the second sphere of each pair, packed.
  for (std::size_t n = 0; n < count; n += lanes) {
    const std::int32_t* const places = contacts.places + n;
    const Vector r = square_root(gather(contacts.squared, places)), s = gather(list.contact, places);
    Vector magnitude = s;                                                         // linear: s^2 (1 - x)
    if (potential == ContactPotential::harmonic) magnitude = s - r;               // s^2 (1 - x)^2 / 2
    if (potential == ContactPotential::cubic) magnitude = (r / s) * (s - r) * s;  // s^3 (x^3/3 - x^2/2 + 1/6)
    // Coincident centres get no force.
    const Vector per_length = magnitude * masked_reciprocal(less(broadcast(0.0), r), r);
    store(contacts.force_x + n, gather(contacts.x, places) * per_length);
    store(contacts.force_y + n, gather(contacts.y, places) * per_length);
    store(contacts.force_z + n, gather(contacts.z, places) * per_length);
  }
  for (std::size_t n = 0; n < count; ++n) {
    const auto k = static_cast<std::size_t>(contacts.places[n]);
    double *a = force + list.first[k], *b = force + list.second[k];
    a[0] -= contacts.force_x[n];
    b[0] += contacts.force_x[n];
    a[slots] -= contacts.force_y[n];
    b[slots] += contacts.force_y[n];
    a[2 * slots] -= contacts.force_z[n];
    b[2 * slots] += contacts.force_z[n];
  }
}

std::size_t sphere_avoidance_trial(double* trial, const double* position, double* sum, double* force, double step,
                                   std::size_t slots) noexcept {
  const Vector zero = broadcast(0.0);
  Vector squares[3] = {zero, zero, zero};
  for (std::size_t i = 0; i < slots; i += lanes)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Vector f = load(force + axis * slots + i);
      squares[axis] = multiply_add(f, f, squares[axis]);
    }
  const double squared = reduce_add((squares[0] + squares[1]) + squares[2]);
  const Vector weight = broadcast(squared > 0.0 ? 1.0 / __builtin_sqrt(squared) : 0.0);
  const Vector length = broadcast(step);
  Vector moving = zero;
  for (std::size_t i = 0; i < slots; i += lanes) {
    Vector f[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t at = axis * slots + i;
      f[axis] = multiply_add(weight, load(force + at), load(sum + at));
      store(sum + at, f[axis]);
      store(force + at, zero);
    }
    // Sums are of unit vectors in 3N space: a share below 1e-12 is rounding error and has no direction.
    const Vector norm = square_root(multiply_add(f[2], f[2], multiply_add(f[1], f[1], f[0] * f[0])));
    const Mask moves = less(broadcast(1e-12), norm);
    const Vector per_length = length * masked_reciprocal(moves, norm);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t at = axis * slots + i;
      store(trial + at, multiply_add(per_length, f[axis], load(position + at)));
    }
    moving = masked_increment(moving, moves);
  }
  return static_cast<std::size_t>(reduce_add(moving));
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
