#include "options.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "core/error.hpp"

namespace lanescape::program {
namespace {

// What is wrong with the text of a whole number; empty if nothing is, as CLI11 wants it. The range that an option allows is checked
// where it is known.
template <class Integer>
std::string whole_number_fault(const std::string& text) {
  Integer value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || text.empty() || error == std::errc::invalid_argument)
    return fmt::format("'{}' is not allowed: a whole number {}in plain digits is needed", text,
                       std::is_unsigned_v<Integer> ? "without a sign " : "");
  if (error != std::errc()) return fmt::format("'{}' is not allowed: it is too large for any count", text);
  return "";
}

std::string number_fault(const std::string& text) {
  return number_in(text) ? "" : fmt::format("'{}' is not allowed: a number is needed, such as 2.5 or 1e-3", text);
}

template <class T>
void write(toml::table& table, const std::string& key, const T& value) {
  if constexpr (std::is_same_v<T, int>) {
    table.insert_or_assign(key, static_cast<std::int64_t>(value));
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    // TOML's integers have a sign; a text reads back to the same number.
    if (value <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
      table.insert_or_assign(key, static_cast<std::int64_t>(value));
    else
      table.insert_or_assign(key, std::to_string(value));
  } else if constexpr (std::is_same_v<T, std::string>) {
    if (!value.empty()) table.insert_or_assign(key, value);
  } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
    toml::array array;
    for (const auto& text : value) array.push_back(text);
    if (!array.empty()) table.insert_or_assign(key, std::move(array));
  } else {
    table.insert_or_assign(key, value);
  }
}

template <class T>
void write(toml::table& table, const std::string& key, const std::optional<T>& value) {
  if (value) write(table, key, *value);
}

}  // namespace

std::optional<double> number_in(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || end != text.c_str() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::string> list_of(const std::string& text, const char* option) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end == begin) throw_bad_input(fmt::format("{}: '{}' is not allowed: values between commas are needed", option, text));
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

double number_of(const std::string& text, const char* option) {
  if (const std::optional<double> value = number_in(text)) return *value;
  throw_bad_input(fmt::format("{}: '{}' is not allowed: a number is needed", option, text));
}

// CLI11 gives hidden options no name.
std::string name_of(const CLI::Option& option) {
  return option.get_lnames().empty() ? option.get_name() : "--" + option.get_lnames().front();
}

Options::Options(CLI::App& program, const std::string& name, const std::string& description)
    : app_(program.add_subcommand(name, description)) {}

template <class T>
Options::Entry& Options::keep(CLI::Option* option, const std::string& key, T& value) {
  Entry& entry = entries_.emplace_back();
  entry.app = app_;
  entry.option = option;
  entry.write = [key, &value](toml::table& table) { program::write(table, key, value); };
  if (!group_.empty()) entry.needs.push_back(group_);
  return entry;
}

template <class T>
Options::Entry& Options::add(const std::string& name, T& value, const std::string& description) {
  CLI::Option* option = app_->add_option(name, value, description)->capture_default_str();
  // CLI11 2.1 takes an empty text for no value or zero, and brings counts that are negative or too large into range.
  if constexpr (std::is_same_v<T, std::uint64_t> || std::is_same_v<T, std::optional<std::uint64_t>>)
    option->check(&whole_number_fault<std::uint64_t>);
  if constexpr (std::is_same_v<T, int>) option->check(&whole_number_fault<int>);
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>>) option->check(&number_fault);
  return keep(option, name.substr(2), value);
}

template <class T>
Options::Entry& Options::add_positional(const std::string& name, T& value, const std::string& description) {
  return keep(app_->add_option(name, value, description), CLI::detail::to_lower(name), value);
}

template Options::Entry& Options::add(const std::string&, int&, const std::string&);
template Options::Entry& Options::add(const std::string&, double&, const std::string&);
template Options::Entry& Options::add(const std::string&, std::uint64_t&, const std::string&);
template Options::Entry& Options::add(const std::string&, std::string&, const std::string&);
template Options::Entry& Options::add(const std::string&, std::optional<double>&, const std::string&);
template Options::Entry& Options::add(const std::string&, std::optional<std::uint64_t>&, const std::string&);
template Options::Entry& Options::add(const std::string&, std::optional<std::string>&, const std::string&);
template Options::Entry& Options::add(const std::string&, std::vector<std::string>&, const std::string&);
template Options::Entry& Options::add_positional(const std::string&, std::string&, const std::string&);
template Options::Entry& Options::add_positional(const std::string&, std::vector<std::string>&, const std::string&);

Options::Entry& Options::add_flag(const std::string& name, bool& value, const std::string& description) {
  return keep(app_->add_flag(name, value, description), name.substr(2), value);
}

void Options::add_unsaved(const std::string& name, std::string& value, const std::string& description) {
  app_->add_option(name, value, description);
}

void Options::add_unsaved(const std::string& name, bool& value, const std::string& description) {
  app_->add_flag(name, value, description);
}

void Options::exclude(const std::string& one, const std::string& other) {
  app_->get_option(one)->excludes(app_->get_option(other));
}

void Options::add_synonym_of_default(const std::string& name, const std::string& description) {
  app_->add_flag_function(name, [](std::int64_t) {}, description)->disable_flag_override();
}

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

Options::Entry& Options::Entry::excludes(const std::string& other) {
  option->excludes(app->get_option(other));
  return *this;
}

Options::Entry& Options::Entry::described(const std::string& description) {
  option->description(description);
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

}  // namespace lanescape::program
