#pragma once

#include <cstddef>
#include <cstdint>

#include "views/layout.hpp"

// Hard spheres at rest: overlaps and fictitious forces.
namespace lanescape::kernels {

// Hard spheres in a periodic box. Two overlap if r^2 < (radius_i + radius_j)^2 with r^2 = (dx dx + dy dy) + dz dz of the nearest
// image. Every product and sum is rounded, so all instruction sets and the reference take the same decisions to the bit.
struct SphereInput {
  const double* positions;  // 3 x slots [sigma]; may be unwrapped
  const double* radii;      // slots [sigma]; NaN for padding, which never overlaps
  std::size_t slots;        // a multiple of slot_padding
  double box[3];            // edge lengths [sigma], each more than twice the largest reach
  std::int32_t* fractions;  // scratch: 3 x float_slots
  float* reaches;           // scratch: float_slots
  std::size_t float_slots;  // slots rounded up to 16
};

// Over all pairs, the order of pairs (i, j) is that of (i / sphere_pair_rows, j / KernelTable::sphere_pair_columns, i, j): the
// kernel's tiles. Sums over pairs have the same bits only in this order.
inline constexpr std::size_t sphere_pair_rows = 4;
// The number of pairs where coordinates are not finite.
inline constexpr std::size_t sphere_pairs_broken = ~std::size_t{0};
struct SpherePair {
  std::int32_t first, second;  // slots, first < second
};

// Pairs that may come to overlap, with the image in which they do; the lengths of the arrays are a multiple of slot_padding.
struct SphereList {
  const std::int32_t *first, *second;         // slots; any valid value for padding
  const double *shift_x, *shift_y, *shift_z;  // box lengths to subtract from x_second - x_first [sigma]
  const double* contact;                      // s_ij = radius_i + radius_j [sigma]; NaN for padding
  std::size_t count;                          // padding included
};

// The overlapping pairs of a list, as offsets into it. Separations r_second - r_first and their squares are kept for every pair of
// the list, overlapping or not: packing them would cost more than it saves.
struct SphereContacts {
  std::int32_t* places;                 // room for the list's count plus 2 slot_padding
  double *x, *y, *z, *squared;          // the list's count
  double *force_x, *force_y, *force_z;  // scratch for forces: the list's count
};

// Fictitious potential between overlapping spheres. Its forces give the direction of avoidance ([G] Eqs. 3.16-3.33).
enum class ContactPotential : std::uint32_t { harmonic, linear, cubic };

}  // namespace lanescape::kernels
