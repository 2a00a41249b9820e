#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/box.hpp"
#include "io/xyz_text.hpp"

// The second line of a frame: key=value pairs, three of them with a meaning.
namespace lanescape::xyz {

using Info = std::map<std::string, std::string>;

// All pairs of a comment line; the three keys with a meaning, lattice, properties and pbc, come in lower case.
Info parse_comment(std::string_view rest);
// Takes a pair out of `info`; `example` is what a message asks for where there is none.
std::string take_key(Info& info, const char* key, const char* example);
// The value of Lattice.
Box parse_lattice(std::string_view text);
// The value of pbc.
void check_periodic(std::string_view text);

// Adds " key=value" in quotes where needed; throws Error(bad_input) for what could not be read back.
void append_pair(std::string& comment, const std::string& key, const std::string& value);

}  // namespace lanescape::xyz
