#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace lanescape {

// A value of an enumeration and its word in options and files.
template <class Enum>
struct EnumWord {
  Enum value;
  const char* word;
};

template <class Enum, std::size_t n>
const char* word_of(const EnumWord<Enum> (&words)[n], Enum value) {
  for (const auto& entry : words)
    if (entry.value == value) return entry.word;
  return "";
}

// Throws Error(bad_input) with `what` the word is of and the allowed words: "unknown image rule 'x': allowed are all, minimum".
template <class Enum, std::size_t n>
Enum parse_word(const EnumWord<Enum> (&words)[n], std::string_view what, std::string_view word) {
  std::string allowed;
  for (const auto& entry : words) {
    if (word == entry.word) return entry.value;
    allowed += (allowed.empty() ? "" : ", ") + std::string(entry.word);
  }
  throw_bad_input("unknown " + std::string(what) + " '" + std::string(word) + "': allowed are " + allowed);
}

}  // namespace lanescape
