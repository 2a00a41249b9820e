#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "io/toml.hpp"

namespace lanescape {

// Which numbers a key may have, and how a message puts it.
struct NumberRange {
  bool (*contains)(double);
  const char* words;
};
extern const NumberRange finite_number, positive_number, non_negative_number, unit_interval;

// Typed, checked access to a parsed TOML file. Every refusal throws Error(bad_input) with the file and the line of the node at
// fault.
class TomlReader {
 public:
  TomlReader(std::string file, const toml::table& root) : file_(std::move(file)), root_(root) {}

  const toml::table& root() const { return root_; }
  [[noreturn]] void refuse(const toml::node& at, const std::string& what_and_allowed) const;
  void allow_keys(const toml::table& table, const std::vector<std::string_view>& keys) const;
  const toml::node& need(const toml::table& table, std::string_view key) const;
  double number(const toml::node& node, std::string_view key, const NumberRange& range) const;
  double number(const toml::table& table, std::string_view key, const NumberRange& range) const {
    return number(need(table, key), key, range);
  }
  double number_or(const toml::table& table, std::string_view key, const NumberRange& range, double otherwise) const {
    const toml::node* node = table.get(key);
    return node ? number(*node, key, range) : otherwise;
  }
  std::string text(const toml::node& node, std::string_view key) const;
  // The sections [[key]], at least one.
  std::vector<const toml::table*> tables(const toml::table& within, std::string_view key) const;
  // Gives the errors of a library check, which does not know the file, a file and a line.
  template <class Action>
  auto located(const toml::node& at, Action action) const {
    try {
      return action();
    } catch (const Error& error) {
      refuse(at, error.what());
    }
  }

 private:
  std::string file_;
  const toml::table& root_;
};

}  // namespace lanescape
