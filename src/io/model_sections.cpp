#include "io/model_sections.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace lanescape {
namespace {

constexpr std::size_t most_species = 64;

// Fractions are typed with few digits; the first species takes the rest anyway.
constexpr double fraction_tolerance = 1e-3;

std::string read_species_name(const TomlReader& toml, const toml::table& section, const std::vector<Species>& others) {
  const toml::node& node = toml.need(section, "name");
  std::string name = toml.text(node, "name");
  if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c <= ' ' || c == 127; }))
    toml.refuse(node, "the name of a species is a column in files: blanks are not allowed in it");
  for (const Species& other : others)
    if (other.name == name) toml.refuse(node, fmt::format("species {} is given twice: each once is allowed", name));
  return name;
}

}  // namespace

std::vector<Species> read_species(const TomlReader& toml, const std::vector<std::string_view>& keys) {
  const auto sections = toml.tables(toml.root(), "species");
  if (sections.size() > most_species)
    toml.refuse(*sections.back(), fmt::format("{} species are not allowed: at most {} are", sections.size(), most_species));
  std::vector<Species> result;
  std::size_t with_fraction = 0;
  double sum = 0.0;
  for (const toml::table* section : sections) {
    toml.allow_keys(*section, keys);
    Species species;
    species.name = read_species_name(toml, *section, result);
    species.mass = toml.number_or(*section, "mass", positive_number, species.mass);
    if (const toml::node* fraction = section->get("fraction")) {
      sum += species.fraction = toml.number(*fraction, "fraction", unit_interval);
      ++with_fraction;
    } else {
      species.fraction = 1.0 / static_cast<double>(sections.size());
    }
    result.push_back(species);
  }
  if (with_fraction != 0 && with_fraction != sections.size())
    toml.refuse(*sections.front(),
                fmt::format("{} of {} species have a fraction: all or none is allowed", with_fraction, sections.size()));
  if (with_fraction != 0 && std::abs(sum - 1.0) > fraction_tolerance)
    toml.refuse(*sections.front(), fmt::format("the fractions add up to {}: a sum of 1 is needed", sum));
  return result;
}

std::size_t species_index(const TomlReader& toml, const toml::node& node, const Mixture& mixture) {
  const std::string name = toml.text(node, "species");
  return toml.located(node, [&] { return static_cast<std::size_t>(mixture.find_species(name)); });
}

std::array<std::size_t, 2> read_species_pair(const TomlReader& toml, const toml::table& pair, const Mixture& mixture) {
  const toml::node& node = toml.need(pair, "species");
  const toml::array* names = node.as_array();
  if (!names || names->size() != 2) toml.refuse(node, "species is not allowed: a list of two names is needed, [\"A\", \"B\"]");
  return {species_index(toml, *names->get(0), mixture), species_index(toml, *names->get(1), mixture)};
}

std::string quoted(const std::string& text) {
  std::ostringstream out;
  out << toml::value<std::string>(text);
  return out.str();
}

std::string model_header(const Mixture& mixture, std::string_view kind) {
  return fmt::format("kind = \"{}\"\n", kind) + (mixture.name.empty() ? "" : fmt::format("name = {}\n", quoted(mixture.name)));
}

std::string species_section(const Species& species) {
  return fmt::format("\n[[species]]\nname = {}\nmass = {}\nfraction = {}\n", quoted(species.name), species.mass, species.fraction);
}

}  // namespace lanescape
