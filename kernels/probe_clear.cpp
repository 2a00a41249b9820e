// Whether a probe has room: checks distances only, before any energy is computed.

#include "grid_columns.hpp"
#include "kernel_declarations.hpp"
#include "loops/pair_vector.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
namespace {

// True if no point of a species is nearer than `reach`. The position's own column is checked first, because points that are too
// near are mostly there.
bool is_clear(const ProbeSpecies& points, double reach, const double* position) noexcept {
  const Vector x = broadcast(position[0]), y = broadcast(position[1]), z = broadcast(position[2]);
  const Vector limit = broadcast(reach * reach);
  const std::size_t low_z = cell_along(points, 2, position[2] - reach), high_z = cell_along(points, 2, position[2] + reach);
  const auto column_is_clear = [&](std::size_t cx, std::size_t cy) {
    const std::uint32_t* first = points.first + (cx * points.cells[1] + cy) * (points.cells[2] + 1);
    const std::uint32_t end = first[high_z + 1];
    for (std::uint32_t k = first[low_z]; k < end; k += lanes) {
      const Displacement d{x - load_unaligned(points.x + k), y - load_unaligned(points.y + k), z - load_unaligned(points.z + k)};
      if (any(both(less(squared_length(d), limit), lanes_below(static_cast<std::ptrdiff_t>(end - k))))) return false;
    }
    return true;
  };
  const std::size_t own_x = cell_along(points, 0, position[0]), own_y = cell_along(points, 1, position[1]);
  if (!column_is_clear(own_x, own_y)) return false;
  const std::size_t last_x = cell_along(points, 0, position[0] + reach), last_y = cell_along(points, 1, position[1] + reach);
  for (std::size_t cx = cell_along(points, 0, position[0] - reach); cx <= last_x; ++cx)
    for (std::size_t cy = cell_along(points, 1, position[1] - reach); cy <= last_y; ++cy)
      if ((cx != own_x || cy != own_y) && !column_is_clear(cx, cy)) return false;
  return true;
}

}  // namespace

std::size_t probe_first_clear(const ProbeInput& in, const double* clearances, const double* positions, std::size_t count) noexcept {
  for (std::size_t k = 0; k < count; ++k) {
    bool clear = true;
    for (std::size_t s = 0; s < in.species_count && clear; ++s) clear = is_clear(in.species[s], clearances[s], positions + 3 * k);
    if (clear) return k;
  }
  return count;
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
