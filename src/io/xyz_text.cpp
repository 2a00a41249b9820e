#include "io/xyz_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace lanescape::xyz {

std::string printable(std::string_view text) {
  std::string result(text.substr(0, 40));
  for (char& c : result)
    if (std::iscntrl(static_cast<unsigned char>(c))) c = '?';
  return text.size() > result.size() ? result + "..." : result;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

void skip_blanks(std::string_view& rest) { rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size())); }

std::string_view take_word(std::string_view& rest) {
  skip_blanks(rest);
  const std::string_view word = rest.substr(0, rest.find_first_of(blanks));
  rest.remove_prefix(word.size());
  return word;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t end; (end = text.find(separator)) != std::string_view::npos; text.remove_prefix(end + 1))
    parts.push_back(text.substr(0, end));
  parts.push_back(text);
  return parts;
}

double parse_finite(std::string_view word, std::string_view what) {
  const auto value = parse<double>(word);
  if (!value || !std::isfinite(*value))
    throw Refusal{fmt::format("{} '{}' is not allowed: a finite number is needed", what, printable(word))};
  return *value;
}

double parse_positive(std::string_view word, std::string_view what) {
  const auto value = parse<double>(word);
  if (!value || !(*value > 0.0) || !std::isfinite(*value))
    throw Refusal{fmt::format("{} '{}' is not allowed: a finite number above 0 is needed", what, printable(word))};
  return *value;
}

}  // namespace lanescape::xyz
