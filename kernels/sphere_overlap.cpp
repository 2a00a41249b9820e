// Which hard spheres overlap, over all pairs: used for a configuration that has no list yet.
//
// Coordinates become 32-bit fractions of the box. Their differences wrap around as the box does, so the nearest image costs nothing
// and 16 pairs fit a vector. A single-precision filter finds every pair that can overlap and a few that do not. Each of these is
// decided in double precision by the one formula that all instruction sets share.

#include "kernel_declarations.hpp"
#include "simd/simd.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
namespace {

constexpr std::size_t row_tile = sphere_pair_rows;
constexpr double whole_box = 4294967296.0;
// Error bounds of the filter: a few roundings of 2^-24 each in r^2 and s^2, and a few units of the fractions. One unit comes from
// each rounding, the rest from coordinates up to 10^6 boxes away.
constexpr double relative_margin = 2e-6, fraction_margin = 8.0;

// Nearest-image separation of two slots along one axis.
inline double nearest(double from, double to, double length) noexcept {
  const double d = to - from;
  return d - length * std::nearbyint(d / length);
}

inline double squared_distance(const SphereInput& in, std::size_t i, std::size_t j) noexcept {
  const double dx = nearest(in.positions[i], in.positions[j], in.box[0]);
  const double dy = nearest(in.positions[in.slots + i], in.positions[in.slots + j], in.box[1]);
  const double dz = nearest(in.positions[2 * in.slots + i], in.positions[2 * in.slots + j], in.box[2]);
  return (dx * dx + dy * dy) + dz * dz;
}

inline bool within(const SphereInput& in, double reach, std::size_t i, std::size_t j) noexcept {
  const double range = (in.radii[i] + in.radii[j]) + reach;
  return squared_distance(in, i, j) < range * range;
}

// Fills the scratch arrays and writes to `scale` the factors from fractions to the filter's unit of length. In a cube that unit is
// the fraction itself and the factors are 1. Returns whether all coordinates are finite.
bool prepare(const SphereInput& in, double reach, float* scale) noexcept {
  const bool cubic = in.box[0] == in.box[1] && in.box[1] == in.box[2];
  const double longest =
      in.box[0] < in.box[1] ? (in.box[1] < in.box[2] ? in.box[2] : in.box[1]) : (in.box[0] < in.box[2] ? in.box[2] : in.box[0]);
  const double per_sigma = whole_box / longest;
  Vector sum = broadcast(0.0);  // not finite where a coordinate is not
  for (std::size_t axis = 0; axis < 3; ++axis) {
    scale[axis] = cubic ? 1.0F : static_cast<float>(in.box[axis] / longest);
    const Vector inverse = broadcast(1.0 / in.box[axis]);
    for (std::size_t i = 0; i < in.slots; i += lanes) {
      const Vector scaled = load(in.positions + axis * in.slots + i) * inverse;
      sum += scaled;
      store_fractions(in.fractions + axis * in.float_slots + i, scaled);
    }
    for (std::size_t i = in.slots; i < in.float_slots; ++i) in.fractions[axis * in.float_slots + i] = 0;
  }
  for (std::size_t i = 0; i < in.slots; ++i)
    in.reaches[i] = static_cast<float>((in.radii[i] + 0.5 * reach) * per_sigma * (1.0 + relative_margin) + fraction_margin);
  for (std::size_t i = in.slots; i < in.float_slots; ++i) in.reaches[i] = static_cast<float>(__builtin_nan(""));
  return 0.0 * reduce_add(sum) == 0.0;
}

// Bits of the columns in one vector that may be within reach of row i.
template <bool cubic>
inline std::uint32_t near_columns(const SphereInput& in, const float* scale, std::size_t i, std::size_t j) noexcept {
  FloatVector d[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int32_t* f = in.fractions + axis * in.float_slots;
    d[axis] = wrapped_difference(f + j, f[i]);
    if constexpr (!cubic) d[axis] = d[axis] * broadcast<FloatVector>(scale[axis]);
  }
  const FloatVector range = load(in.reaches + j) + broadcast<FloatVector>(in.reaches[i]);
  const FloatVector squared = multiply_add(d[2], d[2], multiply_add(d[1], d[1], d[0] * d[0]));
  return bits(less(squared, range * range));
}

// Calls visit(i, j), i < j, for every pair that passes the filter, until a call returns true.
template <bool cubic, class Visit>
inline bool any_near_pair(const SphereInput& in, const float* scale, Visit visit) noexcept {
  const auto each = [&](std::uint32_t mask, std::size_t i, std::size_t j) {
    for (; mask != 0; mask &= mask - 1) {
      const std::size_t column = j + static_cast<std::size_t>(__builtin_ctz(mask));
      if (column > i && visit(i, column)) return true;
    }
    return false;
  };
  for (std::size_t i = 0; i < in.slots; i += row_tile) {
    const std::size_t diagonal = i / float_lanes * float_lanes;
    for (std::size_t row = i; row < i + row_tile; ++row) {
      // Bits of columns up to the row itself are cleared: (2 << k) - 1 has the lowest k + 1 bits set.
      const std::uint32_t upper = ~((2U << (row - diagonal)) - 1U);
      const std::uint32_t mask = near_columns<cubic>(in, scale, row, diagonal) & upper;
      if (mask != 0 && each(mask, row, diagonal)) return true;
    }
    for (std::size_t j = diagonal + float_lanes; j < in.float_slots; j += float_lanes) {
      std::uint32_t mask[row_tile];
#pragma GCC unroll 4
      for (std::size_t r = 0; r < row_tile; ++r) mask[r] = near_columns<cubic>(in, scale, i + r, j);
      if ((mask[0] | mask[1] | mask[2] | mask[3]) == 0) continue;
      for (std::size_t r = 0; r < row_tile; ++r)
        if (mask[r] != 0 && each(mask[r], i + r, j)) return true;
    }
  }
  return false;
}

// Also true where a coordinate is not finite.
template <class Visit>
inline bool any_near_pair(const SphereInput& in, double reach, Visit visit) noexcept {
  float scale[3];
  if (!prepare(in, reach, scale)) return true;
  const bool cubic = in.box[0] == in.box[1] && in.box[1] == in.box[2];
  return cubic ? any_near_pair<true>(in, scale, visit) : any_near_pair<false>(in, scale, visit);
}

}  // namespace

bool sphere_any_overlap(const SphereInput& in) noexcept {
  return any_near_pair(in, 0.0, [&](std::size_t i, std::size_t j) { return within(in, 0.0, i, j); });
}

std::size_t sphere_pairs_within(const SphereInput& in, double reach, SpherePair* out, std::size_t capacity) noexcept {
  std::size_t count = 0;
  const bool broken = any_near_pair(in, reach, [&](std::size_t i, std::size_t j) {
    if (within(in, reach, i, j)) {
      if (count < capacity) out[count] = {static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)};
      ++count;
    }
    return false;
  });
  return broken ? sphere_pairs_broken : count;
}

double sphere_smallest_gap(const SphereInput& in) noexcept {
  const Vector none = broadcast(__builtin_inf());
  Vector smallest = none;
  Vector length[3];
  for (std::size_t axis = 0; axis < 3; ++axis) length[axis] = broadcast(in.box[axis]);
  for (std::size_t i = 0; i < in.slots; ++i) {
    for (std::size_t j = i / lanes * lanes; j < in.slots; j += lanes) {
      Vector d[3];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double* x = in.positions + axis * in.slots;
        d[axis] = load(x + j) - broadcast(x[i]);
        d[axis] = d[axis] - length[axis] * nearest_whole(d[axis] / length[axis]);
      }
      const Vector squared = (d[0] * d[0] + d[1] * d[1]) + d[2] * d[2];
      const Vector gap = square_root(squared) - (broadcast(in.radii[i]) + load(in.radii + j));
      // Comparisons with the NaN of padding are false. Columns up to the row itself are skipped.
      const Mask smaller =
          and_not(less(gap, smallest), lanes_below(static_cast<std::ptrdiff_t>(i + 1) - static_cast<std::ptrdiff_t>(j)));
      smallest = select(smaller, gap, smallest);
    }
  }
  return reduce_min(smallest);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
