#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lanescape {

struct Species {
  std::string name;       // chemical symbol used in files
  double mass = 1.0;      // [m]
  double fraction = 1.0;  // of the particles, for generated starts; floor(N fraction) each, the first species takes the rest
};

// The part that all kinds of models share.
struct Mixture {
  std::string name;
  std::vector<Species> species;

  // Index of a species by its name; throws Error(bad_input) listing the known names.
  int find_species(std::string_view symbol) const;
  bool has_equal_masses() const;
  std::vector<double> species_masses() const;
  // Of particles of these species.
  std::vector<double> masses_of(const std::vector<int>& species_of_particles) const;
  // Throws Error(bad_input) unless there are species, each with a unique name, a mass above 0 and a fraction from 0 to 1.
  void check_species() const;
};

// Throws Error(bad_input) naming the first particle whose species is not from 0 to count - 1.
void check_species(std::span<const int> species_of_particles, std::size_t count);

}  // namespace lanescape
