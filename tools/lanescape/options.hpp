#pragma once

#include <toml++/toml.h>
#include <CLI/CLI.hpp>
#include <cstdint>
#include <deque>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace lanescape::program {

// One kind of run: a mode, a family of models, a method. An option may be declared to have an effect in some kinds of one axis
// only.
struct Scope {
  std::string_view axis;
  std::string_view name;  // ends the message "it is for ..."
};

// What a run is on one axis, and the words of a message for that: "with --scan", "without --out".
struct RunKind {
  Scope scope;
  std::string because;
};
using RunKinds = std::vector<RunKind>;

// The run is of this kind if the condition holds, else of no kind of that axis.
inline RunKind kind_if(bool holds, const Scope& scope, std::string if_so, std::string if_not) {
  return holds ? RunKind{scope, std::move(if_so)} : RunKind{{scope.axis, ""}, std::move(if_not)};
}

// What a run is, as its parts say it.
inline RunKinds joined(std::initializer_list<RunKinds> parts) {
  RunKinds all;
  for (const RunKinds& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// "--name", or FILE of a positional one. CLI11 gives hidden options no name.
inline std::string name_of(const CLI::Option& option) {
  return option.get_lnames().empty() ? option.get_name() : "--" + option.get_lnames().front();
}

// Kinds that several subcommands know.
inline constexpr Scope runs_with_a_folder{"folder", "runs with --out"};
inline constexpr Scope soft_models{"family", "soft models"}, hard_spheres{"family", "hard spheres"};

// The options of one subcommand: CLI11 reads them from the command line. This class knows which kinds of run each is for, and
// writes those that have an effect into the resolved run file, under the same names.
class Options {
 public:
  // One option, to be qualified where it is added.
  class Entry {
   public:
    // The option has an effect in these kinds of run only, all of one axis. Several calls must all be met.
    Entry& only_for(std::vector<Scope> scopes);
    // The subcommand does not use the option, which belongs to a group that it shares with others: hidden, and always refused.
    Entry& refused(std::string reason);
    Entry& required();

   private:
    friend class Options;
    CLI::Option* option;
    std::function<void(toml::table&)> write;
    std::vector<std::vector<Scope>> needs;
    std::string refusal;

    // Why the option has no effect in this run, or nothing.
    std::string fault(const RunKinds& kinds) const;
  };

  explicit Options(CLI::App& app) : app_(&app) {}

  template <class T>
  Entry& add(const std::string& name, T& value, const std::string& description) {
    CLI::Option* option = app_->add_option(name, value, description)->capture_default_str();
    // CLI11 2.1 takes an empty text for no value or zero, and brings counts that are negative or too large into range.
    if constexpr (std::is_same_v<T, std::uint64_t> || std::is_same_v<T, std::optional<std::uint64_t>>) option->check(&count_fault);
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>>) option->check(&number_fault);
    return keep(option, name.substr(2), value);
  }
  // FILE or FILES, under the same name in small letters in the run file.
  template <class T>
  Entry& add_positional(const std::string& name, T& value, const std::string& description) {
    return keep(app_->add_option(name, value, description), CLI::detail::to_lower(name), value);
  }
  Entry& add_flag(const std::string& name, bool& value, const std::string& description) {
    return keep(app_->add_flag(name, value, description), name.substr(2), value);
  }

  // The option of that name, which has been added.
  Entry& at(std::string_view name);
  // All options added from now on are for these kinds of run only, until end_group().
  void begin_group(std::vector<Scope> scopes) { group_ = std::move(scopes); }
  void end_group() { group_.clear(); }

  // Says what the run is. Throws Error(bad_input) if an option was given, on the command line or in a run file, that has no effect
  // in it.
  void settle(RunKinds kinds);
  // The options that have an effect in the run, with their final values.
  toml::table resolved() const;
  CLI::App& app() { return *app_; }

 private:
  template <class T>
  Entry& keep(CLI::Option* option, const std::string& key, T& value) {
    Entry& entry = entries_.emplace_back();
    entry.option = option;
    entry.write = [key, &value](toml::table& table) { Options::write(table, key, value); };
    if (!group_.empty()) entry.needs.push_back(group_);
    return entry;
  }

  // What is wrong with the text of a number; empty where nothing is, as CLI11 wants it.
  static std::string count_fault(const std::string& text);
  static std::string number_fault(const std::string& text);

  static void write(toml::table& table, const std::string& key, bool value) { table.insert_or_assign(key, value); }
  static void write(toml::table& table, const std::string& key, double value) { table.insert_or_assign(key, value); }
  static void write(toml::table& table, const std::string& key, int value) {
    table.insert_or_assign(key, static_cast<std::int64_t>(value));
  }
  static void write(toml::table& table, const std::string& key, std::uint64_t value);
  static void write(toml::table& table, const std::string& key, const std::string& value);
  static void write(toml::table& table, const std::string& key, const std::vector<std::string>& values);
  template <class T>
  static void write(toml::table& table, const std::string& key, const std::optional<T>& value) {
    if (value) write(table, key, *value);
  }

  CLI::App* app_;
  std::deque<Entry> entries_;
  std::vector<Scope> group_;
  RunKinds kinds_;
};

}  // namespace lanescape::program
