#include "configuration/hard_sphere_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/error.hpp"
#include "core/length_unit.hpp"

namespace lanescape {

std::vector<double> HardSphereModel::radii_of(const std::vector<int>& species_of_particles) const {
  std::vector<double> radii;
  radii.reserve(species_of_particles.size());
  for (const int s : species_of_particles) radii.push_back(radius(static_cast<std::size_t>(s)));
  return radii;
}

double HardSphereModel::largest_size() const { return *std::max_element(diameters.begin(), diameters.end()); }

double HardSphereModel::length_unit() const { return length_unit_of(largest_size()); }

void HardSphereModel::check() const {
  check_species();
  if (diameters.size() != species.size())
    throw_bad_input(fmt::format("model {}: {} species need {} diameters, {} are given", name, species.size(), species.size(),
                                diameters.size()));
  for (std::size_t s = 0; s < species.size(); ++s)
    if (!(diameters[s] >= smallest_diameter && diameters[s] <= largest_diameter))
      throw_bad_input(fmt::format("species {}: diameter {} is not allowed, it must be from {} to {}", species[s].name, diameters[s],
                                  smallest_diameter, largest_diameter));
}

HardSphereModel hard_sphere() {
  HardSphereModel model;
  model.name = "hard-sphere";
  model.species = {{"Ar", 1.0, 1.0}};
  model.diameters = {1.0};
  return model;
}

HardSphereModel hard_sphere_binary() {
  HardSphereModel model;
  model.name = "hard-sphere-binary";
  model.species = {{"Xe", 1.0, 0.5}, {"Ar", 1.0, 0.5}};
  model.diameters = {1.4, 1.0};
  return model;
}

double packing_fraction(const Configuration& configuration) {
  double cubes = 0.0;
  for (const double r : configuration.radii) cubes += r * r * r;
  return 4.0 / 3.0 * std::numbers::pi * cubes / configuration.box.volume();
}

double cube_edge(const Configuration& spheres, double fraction) {
  return std::cbrt(packing_fraction(spheres) / fraction * spheres.box.volume());
}

}  // namespace lanescape
