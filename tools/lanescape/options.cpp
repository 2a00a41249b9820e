#include "options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"

namespace lanescape::program {

Options::Entry& Options::Entry::only_for(std::vector<Scope> scopes) {
  needs.push_back(std::move(scopes));
  return *this;
}

Options::Entry& Options::Entry::refused(std::string reason) {
  refusal = std::move(reason);
  option->group("");  // not listed by --help
  return *this;
}

Options::Entry& Options::Entry::required() {
  option->required();
  return *this;
}

std::string Options::Entry::fault(const RunKinds& kinds) const {
  if (!refusal.empty()) return refusal;
  for (const std::vector<Scope>& allowed : needs) {
    const RunKind* other = nullptr;
    bool met = false;
    std::string names;
    for (const Scope& scope : allowed) {
      names += (names.empty() ? "" : " and ") + std::string(scope.name);
      for (const RunKind& kind : kinds) {
        if (kind.scope.axis != scope.axis) continue;
        other = &kind;
        met = met || kind.scope.name == scope.name;
      }
    }
    if (met) continue;
    if (other == nullptr) throw std::logic_error(fmt::format("{}: the run does not say what it is", name_of(*option)));
    return fmt::format("{}: it is for {}", other->because, names);
  }
  return {};
}

Options::Entry& Options::at(std::string_view name) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return name_of(*e.option) == name; });
  if (found == entries_.end()) throw std::logic_error(fmt::format("there is no option {}", name));
  return *found;
}

void Options::settle(RunKinds kinds) {
  kinds_ = std::move(kinds);
  for (const Entry& entry : entries_) {
    if (entry.option->count() == 0) continue;
    const std::string fault = entry.fault(kinds_);
    if (!fault.empty()) throw_bad_input(fmt::format("{} is not allowed {}", name_of(*entry.option), fault));
  }
}

toml::table Options::resolved() const {
  toml::table table;
  for (const Entry& entry : entries_)
    if (entry.fault(kinds_).empty()) entry.write(table);
  return table;
}

std::string Options::count_fault(const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool sound = error == std::errc() && end == text.data() + text.size();
  return sound ? "" : "'" + text + "' is not allowed: a whole number from 0 to 18446744073709551615 is needed";
}

std::string Options::number_fault(const std::string& text) { return text.empty() ? "'' is not allowed: a number is needed" : ""; }

void Options::write(toml::table& table, const std::string& key, std::uint64_t value) {
  // TOML's integers have a sign; a text is read back just the same.
  if (value <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
    table.insert_or_assign(key, static_cast<std::int64_t>(value));
  else
    table.insert_or_assign(key, std::to_string(value));
}

void Options::write(toml::table& table, const std::string& key, const std::string& value) {
  if (!value.empty()) table.insert_or_assign(key, value);
}

void Options::write(toml::table& table, const std::string& key, const std::vector<std::string>& values) {
  toml::array array;
  for (const auto& value : values) array.push_back(value);
  if (!array.empty()) table.insert_or_assign(key, std::move(array));
}

}  // namespace lanescape::program
