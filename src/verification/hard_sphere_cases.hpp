#pragma once

#include <string>
#include <vector>

#include "configuration/configuration.hpp"

namespace lanescape {

// Hard spheres to check kernels on. Every box edge is at least twice the largest diameter, as the kernels require.
struct HardSphereCase {
  std::string name;
  Configuration configuration;
};

// The fixed cases that tests and the program share: sizes (empty, one, odd, lane tails) of equal, binary and polydisperse spheres,
// separate and overlapping, in cubes and other boxes; pairs that touch to the bit; boxes from twice the largest diameter to 1000
// sigma.
std::vector<HardSphereCase> hard_sphere_cases();

}  // namespace lanescape
