#include "configuration/mixture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace lanescape {
namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 32 || c == 127; }

}  // namespace

int Mixture::find_species(std::string_view symbol) const {
  std::string names;
  for (std::size_t s = 0; s < species.size(); ++s) {
    if (species[s].name == symbol) return static_cast<int>(s);
    names += (s ? ", " : "") + species[s].name;
  }
  throw_bad_input(fmt::format("unknown species '{}': model {} has {}", symbol, name, names));
}

bool Mixture::has_equal_masses() const {
  return std::all_of(species.begin(), species.end(), [&](const Species& s) { return s.mass == species.front().mass; });
}

std::vector<double> Mixture::species_masses() const {
  std::vector<double> masses;
  for (const Species& s : species) masses.push_back(s.mass);
  return masses;
}

std::vector<double> Mixture::masses_of(const std::vector<int>& species_of_particles) const {
  std::vector<double> masses;
  masses.reserve(species_of_particles.size());
  for (const int s : species_of_particles) masses.push_back(species[static_cast<std::size_t>(s)].mass);
  return masses;
}

void Mixture::check_species() const {
  if (std::any_of(name.begin(), name.end(), is_control))
    throw_bad_input("the name of a model is one line, without control characters");
  if (species.empty()) throw_bad_input(fmt::format("model {} has no species", name));
  for (const Species& s : species) {
    if (std::any_of(s.name.begin(), s.name.end(), [](char c) { return c == ' ' || is_control(c); }))
      throw_bad_input(fmt::format("model {}: the name of a species is a column in files: blanks are not allowed in it", name));
    if (!(s.mass > 0.0) || !std::isfinite(s.mass))
      throw_bad_input(fmt::format("species {}: mass {} is not allowed, it must be finite and above 0", s.name, s.mass));
    if (!(s.fraction >= 0.0 && s.fraction <= 1.0))
      throw_bad_input(fmt::format("species {}: fraction {} is not between 0 and 1", s.name, s.fraction));
    const auto namesakes =
        std::count_if(species.begin(), species.end(), [&](const Species& other) { return other.name == s.name; });
    if (s.name.empty() || namesakes != 1)
      throw_bad_input(fmt::format("species name '{}' must be given, and to one species only", s.name));
  }
}

void check_species(std::span<const int> species_of_particles, std::size_t count) {
  for (std::size_t i = 0; i < species_of_particles.size(); ++i)
    if (species_of_particles[i] < 0 || static_cast<std::size_t>(species_of_particles[i]) >= count)
      throw_bad_input(fmt::format("particle {}: species {} is not allowed: the model has {}, numbered from 0", i,
                                  species_of_particles[i], count));
}

}  // namespace lanescape
