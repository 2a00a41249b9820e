#include "core/coordinate_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "core/error.hpp"

namespace lanescape {

void check_edges(std::span<const double> edges) {
  for (const double edge : edges)
    if (!(edge >= least_edge && edge <= greatest_edge))
      throw_bad_input(fmt::format("box edge {} is not allowed: it must be from {} to {}", edge, least_edge, greatest_edge));
}

void check_periodic(const Box& box, std::string_view work) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!box.periodic[axis])
      throw_bad_input(
          fmt::format("{} are not allowed in a box that is open along {}: it must be periodic along all axes", work, "xyz"[axis]));
}

void check_finite(std::span<const double> coordinates) {
  for (const double x : coordinates)
    if (!std::isfinite(x)) throw_bad_input(fmt::format("coordinate {} of a particle is not allowed: it must be finite", x));
}

void check_finite_particles(std::span<const double> interleaved) {
  for (std::size_t k = 0; k < interleaved.size(); ++k)
    if (!std::isfinite(interleaved[k]))
      throw_bad_input(fmt::format("{} coordinate {} of particle {} (from 0) is not allowed: it must be finite", "xyz"[k % 3],
                                  interleaved[k], k / 3));
}

}  // namespace lanescape
