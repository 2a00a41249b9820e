#include "io/xyz_comment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace lanescape::xyz {
namespace {

constexpr double orthorhombic_tolerance = 1e-12;  // of the edge; the residue of rotating a cell to the axes

// Whether the format gives this key a meaning.
bool is_reserved(std::string_view key) {
  const std::string name = lower(key);
  return name == "lattice" || name == "properties" || name == "pbc";
}

// A value in quotes, with backslash escapes.
std::string take_quoted(std::string_view& rest) {
  const char quote = rest.front();
  std::string value;
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (rest[i] == quote) {
      rest.remove_prefix(i + 1);
      return value;
    }
    if (rest[i] == '\\' && i + 1 < rest.size()) {
      ++i;
      value += rest[i] == 'n' ? '\n' : rest[i];
    } else {
      value += rest[i];
    }
  }
  throw Refusal{fmt::format("quote without an end at {}: a value is closed by the quote that opens it", printable(rest))};
}

// An array in brackets or braces, kept as text.
std::string take_bracketed(std::string_view& rest) {
  int depth = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i] == '[' || rest[i] == '{') ++depth;
    if (rest[i] == ']' || rest[i] == '}') --depth;
    if (depth == 0) {
      std::string value(rest.substr(0, i + 1));
      rest.remove_prefix(i + 1);
      return value;
    }
  }
  throw Refusal{fmt::format("bracket without an end at {}: a value is closed by the bracket that opens it", printable(rest))};
}

// Whether the text begins with "key =".
bool begins_with_key(std::string_view rest) {
  const std::size_t end = std::min(rest.find_first_of(" \t=\"'[{"), rest.size());
  const std::size_t next = rest.find_first_not_of(blanks, end);
  return end > 0 && next != std::string_view::npos && rest[next] == '=';
}

// An empty text at the end of the line and in `a= b=1`, which ASE writes for an empty text.
std::string take_value(std::string_view& rest) {
  const bool separated = !rest.empty() && blanks.find(rest[0]) != std::string_view::npos;
  skip_blanks(rest);
  if (rest.empty()) return {};
  if (rest[0] == '"' || rest[0] == '\'') return take_quoted(rest);
  if (rest[0] == '[' || rest[0] == '{') return take_bracketed(rest);
  if (separated && begins_with_key(rest)) return {};
  return std::string(take_word(rest));
}

std::string take_key(std::string_view& rest) {
  std::string key;
  if (rest[0] == '"' || rest[0] == '\'') {
    key = take_quoted(rest);
  } else {
    key = rest.substr(0, rest.find_first_of(" \t="));
    rest.remove_prefix(key.size());
  }
  if (key.empty()) throw Refusal{fmt::format("value without a key at '{}': key=value is needed", printable(rest))};
  return key;
}

using Pairs = std::vector<std::pair<std::string, std::string>>;

Pairs parse_pairs(std::string_view rest) {
  Pairs pairs;
  for (;;) {
    skip_blanks(rest);
    if (rest.empty()) return pairs;
    std::string key = take_key(rest);
    std::string value = "T";
    if (const std::size_t next = rest.find_first_not_of(blanks); next != std::string_view::npos && rest[next] == '=') {
      rest.remove_prefix(next + 1);
      value = take_value(rest);
    }
    pairs.emplace_back(std::move(key), std::move(value));
  }
}

// Takes a key of the format out of the pairs.
std::optional<std::string> take_reserved(Pairs& pairs, std::string_view key) {
  const bool usual = std::any_of(pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.first == key; });
  std::optional<std::string> value;
  std::erase_if(pairs, [&](auto& pair) {
    if (usual ? pair.first != key : lower(pair.first) != lower(key)) return false;
    if (value && *value != pair.second)
      throw Refusal{fmt::format("{} is given twice, \"{}\" and \"{}\": one value is allowed", key, printable(*value),
                                printable(pair.second))};
    value = std::move(pair.second);
    return true;
  });
  return value;
}

// The parts of a list: blanks, commas and brackets, also nested ones, separate them.
std::vector<std::string_view> parts_of(std::string_view text) {
  constexpr std::string_view separators = " \t\n,[]{}";
  std::vector<std::string_view> parts;
  for (std::size_t begin; (begin = text.find_first_not_of(separators)) != std::string_view::npos;) {
    text.remove_prefix(begin);
    parts.push_back(text.substr(0, text.find_first_of(separators)));
    text.remove_prefix(parts.back().size());
  }
  return parts;
}

}  // namespace

Comment parse_comment(std::string_view rest) {
  Pairs pairs = parse_pairs(rest);
  Comment comment;
  comment.lattice = take_reserved(pairs, "Lattice");
  comment.properties = take_reserved(pairs, "Properties");
  comment.periodic = take_reserved(pairs, "pbc");
  for (auto& [key, value] : pairs) comment.info.insert_or_assign(std::move(key), std::move(value));
  return comment;
}

const std::string& required(const std::optional<std::string>& value, const std::string& example) {
  if (!value) throw Refusal{fmt::format("the comment line has no {}: {} is needed", example, example)};
  return *value;
}

Box parse_lattice(std::string_view text) {
  constexpr std::string_view allowed =
      "nine numbers of an orthorhombic box are needed, \"Lx 0 0 0 Ly 0 0 0 Lz\" with edges above 0";
  std::vector<double> cell;
  for (const std::string_view part : parts_of(text)) {
    if (cell.size() == 9) throw Refusal{fmt::format("Lattice has more than 9 numbers: {}", allowed)};
    cell.push_back(parse_finite(part, "Lattice component"));
  }
  // The specification reads three numbers as the diagonal.
  if (cell.size() == 3) cell = {cell[0], 0.0, 0.0, 0.0, cell[1], 0.0, 0.0, 0.0, cell[2]};
  if (cell.size() != 9) throw Refusal{fmt::format("Lattice has {}: {}", counted(cell.size(), "number"), allowed)};
  Box box;
  for (std::size_t row = 0; row < 3; ++row) {
    box.length[row] = cell[4 * row];
    if (!(box.length[row] > 0.0)) throw Refusal{fmt::format("Lattice edge {} is {}: {}", row + 1, box.length[row], allowed)};
    for (std::size_t column = 0; column < 3; ++column)
      if (column != row && std::abs(cell[3 * row + column]) > orthorhombic_tolerance * box.length[row])
        throw Refusal{
            fmt::format("Lattice is not orthorhombic, vector {} has a component {}: {}", row + 1, cell[3 * row + column], allowed)};
  }
  return box;
}

std::array<bool, 3> parse_periodic(std::string_view text) {
  const std::vector<std::string_view> words = parts_of(text);
  std::vector<bool> axes;
  for (const std::string_view word : words) {
    const std::string axis = lower(word);
    const bool periodic = axis == "t" || axis == "true" || axis == "1";
    if (periodic || axis == "f" || axis == "false" || axis == "0") axes.push_back(periodic);
  }
  if (axes.size() != words.size() || (axes.size() != 1 && axes.size() != 3))
    throw Refusal{fmt::format("pbc \"{}\" is not allowed: T (periodic) or F (open) along each axis is needed, as in \"T T T\"",
                              printable(text))};
  if (axes.size() == 1) axes.resize(3, axes[0]);
  return {axes[0], axes[1], axes[2]};
}

void append_pair(std::string& comment, const std::string& key, const std::string& value) {
  const bool bad_key = key.empty() || key.find_first_of(" \t\n\r=\"'\\[]{}") != std::string::npos;
  if (bad_key || is_reserved(key))
    throw_bad_input(
        fmt::format("'{}' cannot be a key of extended XYZ: a word other than Lattice, Properties and pbc, without quotes, "
                    "brackets and = is allowed",
                    printable(key)));
  if (std::any_of(value.begin(), value.end(), [](char c) { return c >= 0 && c < ' ' && c != '\n' && c != '\t'; }))
    throw_bad_input(
        fmt::format("the value '{}' of {} cannot be written: control characters are not allowed", printable(value), key));
  comment += ' ' + key + '=';
  if (!value.empty() && value.find_first_of(" \t\n=\"'\\[]{},") == std::string::npos) {
    comment += value;
    return;
  }
  comment += '"';
  for (const char c : value) {
    if (c == '"' || c == '\\') comment += '\\';
    if (c == '\n')
      comment += "\\n";
    else
      comment += c;
  }
  comment += '"';
}

}  // namespace lanescape::xyz
