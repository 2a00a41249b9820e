#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "configuration/mixture.hpp"
#include "io/toml_reader.hpp"

// What model files of every kind share.
namespace lanescape {

// The sections [[species]]; `keys` are those that a species of this kind of model may have.
std::vector<Species> read_species(const TomlReader& toml, const std::vector<std::string_view>& keys);
std::size_t species_index(const TomlReader& toml, const toml::node& node, const Mixture& mixture);
// species = ["A", "B"] of a section.
std::array<std::size_t, 2> read_species_pair(const TomlReader& toml, const toml::table& pair, const Mixture& mixture);

// A text as TOML writes it, in quotes.
std::string quoted(const std::string& text);
// The lines that a file of this kind starts with.
std::string model_header(const Mixture& mixture, std::string_view kind);
// A section [[species]].
std::string species_section(const Species& species);

}  // namespace lanescape
