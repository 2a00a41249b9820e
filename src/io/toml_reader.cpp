#include "io/toml_reader.hpp"

#include <cmath>
#include <cstdint>
#include <optional>

namespace lanescape {

const NumberRange finite_number{[](double x) { return std::isfinite(x); }, "a finite number"};
const NumberRange positive_number{[](double x) { return std::isfinite(x) && x > 0.0; }, "a finite number above 0"};
const NumberRange non_negative_number{[](double x) { return std::isfinite(x) && x >= 0.0; }, "a finite number of at least 0"};
const NumberRange unit_interval{[](double x) { return x >= 0.0 && x <= 1.0; }, "a number from 0 to 1"};

void TomlReader::refuse(const toml::node& at, const std::string& what_and_allowed) const {
  throw_bad_input(fmt::format("{}:{}: {}", file_, std::max<std::size_t>(at.source().begin.line, 1), what_and_allowed));
}

void TomlReader::allow_keys(const toml::table& table, const std::vector<std::string_view>& keys) const {
  for (const auto& [key, node] : table)
    if (std::find(keys.begin(), keys.end(), key.str()) == keys.end()) {
      const std::size_t line = key.source().begin.line;
      throw_bad_input(fmt::format("{}:{}: unknown key '{}': allowed are {}", file_, line, key.str(), fmt::join(keys, ", ")));
    }
}

const toml::node& TomlReader::need(const toml::table& table, std::string_view key) const {
  const toml::node* node = table.get(key);
  if (!node) refuse(table, fmt::format("'{}' is missing: it is needed here", key));
  return *node;
}

double TomlReader::number(const toml::node& node, std::string_view key, const NumberRange& range) const {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !range.contains(*value))
    refuse(node, value ? fmt::format("{} = {} is not allowed: {} is needed", key, *value, range.words)
                       : fmt::format("{} is no number: {} is needed", key, range.words));
  return *value + 0.0;  // -0.0 becomes 0: written as -0 it would be an integer, which has no sign
}

std::string TomlReader::text(const toml::node& node, std::string_view key) const {
  const auto value = node.value_exact<std::string>();
  if (!value) refuse(node, fmt::format("{} is no text: a text in quotes is needed", key));
  if (value->empty()) refuse(node, fmt::format("{} = \"\" is not allowed: a text with at least one character is needed", key));
  return *value;
}

std::vector<const toml::table*> TomlReader::tables(const toml::table& within, std::string_view key) const {
  const toml::node& node = need(within, key);
  const toml::array* array = node.as_array();
  if (!array || array->empty()) refuse(node, fmt::format("{} is not allowed: [[{}]] sections are needed", key, key));
  std::vector<const toml::table*> result;
  for (const toml::node& element : *array) {
    if (!element.is_table()) refuse(element, fmt::format("{} is not allowed: [[{}]] sections are needed", key, key));
    result.push_back(element.as_table());
  }
  return result;
}

}  // namespace lanescape
