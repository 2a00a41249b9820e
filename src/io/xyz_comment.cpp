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

std::string take_value(std::string_view& rest) {
  skip_blanks(rest);
  if (rest.empty()) throw Refusal{"key without a value at the end of the comment line: key=value is needed"};
  if (rest[0] == '"' || rest[0] == '\'') return take_quoted(rest);
  if (rest[0] == '[' || rest[0] == '{') return take_bracketed(rest);
  return std::string(take_word(rest));
}

}  // namespace

Info parse_comment(std::string_view rest) {
  Info info;
  for (;;) {
    skip_blanks(rest);
    if (rest.empty()) return info;
    std::string key;
    if (rest[0] == '"' || rest[0] == '\'') {
      key = take_quoted(rest);
    } else {
      key = rest.substr(0, rest.find_first_of(" \t="));
      rest.remove_prefix(key.size());
    }
    if (key.empty()) throw Refusal{fmt::format("value without a key at '{}': key=value is needed", printable(rest))};
    if (const std::string name = lower(key); name == "lattice" || name == "properties" || name == "pbc") key = name;
    const std::size_t next = rest.find_first_not_of(blanks);
    if (next == std::string_view::npos || rest[next] != '=') {
      info.emplace(std::move(key), "T");
      continue;
    }
    rest.remove_prefix(next + 1);
    std::string value = take_value(rest);
    if (!info.emplace(key, std::move(value)).second)
      throw Refusal{fmt::format("{} is given twice: each key once is allowed", printable(key))};
  }
}

std::string take_key(Info& info, const char* key, const char* example) {
  auto node = info.extract(key);
  if (!node) throw Refusal{fmt::format("the comment line has no {}: {} is needed", example, example)};
  return std::move(node.mapped());
}

Box parse_lattice(std::string_view text) {
  constexpr std::string_view allowed =
      "nine numbers of an orthorhombic box are needed, \"Lx 0 0 0 Ly 0 0 0 Lz\" with edges above 0";
  // {...} and [...] are older spellings of the quotes.
  if (text.size() >= 2 && (text.front() == '{' || text.front() == '[')) text = text.substr(1, text.size() - 2);
  std::vector<double> cell;
  for (std::string_view word; !(word = take_word(text)).empty();) {
    if (cell.size() == 9) throw Refusal{fmt::format("Lattice has more than 9 numbers: {}", allowed)};
    cell.push_back(parse_finite(word, "Lattice component"));
  }
  if (cell.size() != 9) throw Refusal{fmt::format("Lattice has {} numbers: {}", cell.size(), allowed)};
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

void check_periodic(std::string_view text) {
  const std::string_view whole = text;
  int axes = 0;
  bool periodic = true;
  if (text.size() >= 2 && (text.front() == '{' || text.front() == '[')) text = text.substr(1, text.size() - 2);
  for (std::string_view word; !(word = take_word(text)).empty(); ++axes)
    periodic = periodic && (lower(word) == "t" || lower(word) == "true");
  if (axes != 3 || !periodic)
    throw Refusal{fmt::format("pbc \"{}\" is not allowed: the box must be periodic along all axes, \"T T T\"", printable(whole))};
}

void append_pair(std::string& comment, const std::string& key, const std::string& value) {
  const std::string name = lower(key);
  const bool bad_key = key.empty() || key.find_first_of(" \t\n\r=\"'\\[]{}") != std::string::npos;
  if (bad_key || name == "lattice" || name == "properties" || name == "pbc")
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
