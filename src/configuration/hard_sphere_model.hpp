#pragma once

#include <cstddef>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/mixture.hpp"

namespace lanescape {

constexpr double smallest_diameter = 1e-6, largest_diameter = 1e6;  // [sigma]; volumes and their sums stay normal numbers

// Additive hard spheres: i and j overlap where r_ij < s_ij = (s_i + s_j)/2. Touching is not overlapping.
struct HardSphereModel : Mixture {
  std::vector<double> diameters;  // per species [sigma]

  double radius(std::size_t species_index) const { return 0.5 * diameters[species_index]; }
  double largest_size() const;  // diameter [sigma]
  // The unit of length for its spheres [sigma].
  double length_unit() const;
  // One radius per particle [sigma].
  std::vector<double> radii_of(const std::vector<int>& species_of_particles) const;
  // Throws Error(bad_input) unless each species is sound and has a diameter in this range.
  void check() const;
};

// One component of diameter 1, written Ar.
HardSphereModel hard_sphere();
// Equal numbers of large spheres, diameter 1.4, written Xe, and small ones, diameter 1, written Ar.
HardSphereModel hard_sphere_binary();

// (4 pi / 3V) sum r_i^3 of a configuration with radii.
double packing_fraction(const Configuration& configuration);
// The edge of the cube in which these spheres have this packing fraction [sigma].
double cube_edge(const Configuration& spheres, double packing_fraction);

}  // namespace lanescape
