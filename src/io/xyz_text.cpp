#include "io/xyz_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <locale>
#include <sstream>

namespace lanescape::xyz {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace

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

std::string counted(std::size_t count, std::string_view what) { return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s"); }

// Most of the time of reading goes here; find_first_of() would call memchr() for each character.
void skip_blanks(std::string_view& rest) {
  const auto word = std::find_if_not(rest.begin(), rest.end(), is_blank);
  rest.remove_prefix(static_cast<std::size_t>(word - rest.begin()));
}

std::string_view take_word(std::string_view& rest) {
  skip_blanks(rest);
  const auto end = std::find_if(rest.begin(), rest.end(), is_blank);
  const std::string_view word = rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
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

std::optional<double> parse_real(std::string_view word) {
  if (const auto value = parse<double>(word)) return value;
  std::string text(word);
  for (char& c : text)
    if (c == 'd' || c == 'D') c = 'e';
  if (const auto value = parse<double>(text)) return value;
  const bool is_decimal = text.find_first_not_of("+-.0123456789eE") == std::string::npos;
  // from_chars does not say on which side a number is out of range; streams refuse large ones only.
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  double value = 0.0;
  if (is_decimal && in >> value && in.peek() == std::char_traits<char>::eof()) return value;
  return std::nullopt;
}

double parse_finite(std::string_view word, std::string_view what) {
  const auto value = parse_real(word);
  if (!value || !std::isfinite(*value))
    throw Refusal{fmt::format("{} '{}' is not allowed: a finite number is needed", what, printable(word))};
  return *value;
}

double parse_positive(std::string_view word, std::string_view what) {
  const auto value = parse_real(word);
  if (!value || !(*value > 0.0) || !std::isfinite(*value))
    throw Refusal{fmt::format("{} '{}' is not allowed: a finite number above 0 is needed", what, printable(word))};
  return *value;
}

}  // namespace lanescape::xyz
