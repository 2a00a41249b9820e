#pragma once

#include <array>
#include <span>

#include "configuration/configuration.hpp"

namespace lanescape {

// Spheres of one species without positions. Throws Error(bad_input) for none, radii out of range and a box that does not hold them.
Configuration host_spheres(std::span<const double> radii, const std::array<double, 3>& edges);

}  // namespace lanescape
