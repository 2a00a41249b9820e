#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/box.hpp"
#include "io/xyz_text.hpp"

// The second line of a frame: key=value pairs, three of them with a meaning.
namespace lanescape::xyz {

// The values of a comment line. Lattice, Properties and pbc may be written in other cases, unless the usual spelling is there too:
// `lattice=fcc` beside `Lattice="..."` is an ordinary key. Where one of the three is repeated, the values must be the same. Of
// other keys the last value counts.
struct Comment {
  std::optional<std::string> lattice, properties, periodic;
  std::map<std::string, std::string> info;  // all other pairs
};
Comment parse_comment(std::string_view rest);
// The value; `example` is what the message asks for where there is none.
const std::string& required(const std::optional<std::string>& value, const std::string& example);
// The value of Lattice: nine numbers, or the three edges. Blanks, commas and brackets separate them.
Box parse_lattice(std::string_view text);
// The value of pbc: three of T, true, 1 and F, false, 0, or one for all axes.
std::array<bool, 3> parse_periodic(std::string_view text);

// Adds " key=value" in quotes where needed; throws Error(bad_input) for what could not be read back.
void append_pair(std::string& comment, const std::string& key, const std::string& value);

}  // namespace lanescape::xyz
