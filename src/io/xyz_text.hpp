#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

// Words and numbers of a line of an extended XYZ file.
namespace lanescape::xyz {

inline constexpr std::string_view blanks = " \t";

// What is wrong with a piece of text; the reader adds file and line.
struct Refusal {
  std::string message;
};

// Text of the file as part of a one-line message: cut to 40 characters, without control characters.
std::string printable(std::string_view text);
std::string lower(std::string_view text);
// "1 column", "2 columns".
std::string counted(std::size_t count, std::string_view what);
void skip_blanks(std::string_view& rest);
// Cuts the first word off `rest`; empty at the end.
std::string_view take_word(std::string_view& rest);
std::vector<std::string_view> split(std::string_view text, char separator);

template <class Number>
std::optional<Number> parse(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);  // from_chars knows no plus sign
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

// As parse<double>(), but also Fortran's exponents, 1d0, and numbers so small that they round to zero.
std::optional<double> parse_real(std::string_view word);
double parse_finite(std::string_view word, std::string_view what);
double parse_positive(std::string_view word, std::string_view what);

}  // namespace lanescape::xyz
