#include "interaction/sphere/check_overlap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"

namespace lanescape {

double sphere_gap(const Configuration& configuration, std::size_t i, std::size_t j) {
  const Point d = configuration.box.nearest_image(difference(configuration.position(j), configuration.position(i)));
  return std::sqrt(dot(d, d)) - (configuration.radii[i] + configuration.radii[j]);
}

void check_box_holds_spheres(const Configuration& configuration) {
  check_edges(configuration.box.length);
  const double largest = 2.0 * *std::max_element(configuration.radii.begin(), configuration.radii.end());
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!(configuration.box.length[axis] >= 2.0 * largest))
      throw_bad_input(fmt::format("box edge {} along axis {} is not allowed: at least twice the largest diameter {} is needed",
                                  configuration.box.length[axis], axis + 1, largest));
}

void check_no_overlap(const Configuration& configuration, const kernels::KernelTable& table) {
  check_box_holds_spheres(configuration);
  // With one species, slot k is particle k.
  const ParticleLayout layout(std::vector<int>(configuration.size(), 0), 1);
  HardSphereOverlap spheres(configuration.box, layout, configuration.radii, table);
  const auto& pairs = spheres.pairs_within(layout.to_slots(configuration.positions), 0.0);
  if (pairs.empty()) return;
  const auto gap = [&](const kernels::SpherePair& pair) {
    return sphere_gap(configuration, static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second));
  };
  const auto deepest = *std::min_element(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) { return gap(a) < gap(b); });
  throw_bad_input(fmt::format("particles {} and {} overlap by {}: spheres may touch but not overlap ({} such pairs)", deepest.first,
                              deepest.second, -gap(deepest), pairs.size()));
}

}  // namespace lanescape
