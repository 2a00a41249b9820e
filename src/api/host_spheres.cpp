#include "api/host_spheres.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

#include "configuration/hard_sphere_model.hpp"
#include "core/error.hpp"
#include "interaction/sphere/check_overlap.hpp"

namespace lanescape {

Configuration host_spheres(std::span<const double> radii, const std::array<double, 3>& edges) {
  if (radii.empty()) throw_bad_input("no spheres were given: at least one is needed");
  for (std::size_t i = 0; i < radii.size(); ++i)
    if (!(2.0 * radii[i] >= smallest_diameter && 2.0 * radii[i] <= largest_diameter))
      throw_bad_input(fmt::format("radius {} of particle {} (from 0) is not allowed: it must be from {} to {}", radii[i], i,
                                  0.5 * smallest_diameter, 0.5 * largest_diameter));
  Configuration spheres{Box{edges}, std::vector<int>(radii.size(), 0), {}, {radii.begin(), radii.end()}};
  check_box_holds_spheres(spheres);
  return spheres;
}

}  // namespace lanescape
