#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/toml.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lanescape::program {

// One kind of run: a mode, a family of models, a method. An option may be declared to have an effect in some kinds of one axis
// only.
struct Scope {
  std::string_view axis;
  std::string_view name;  // ends the message "it is for ..."
};

// The kind of a run on one axis, and the words of a message for it: "with --scan", "without --out".
struct RunKind {
  Scope scope;
  std::string because;
};
using RunKinds = std::vector<RunKind>;

// The run is of this kind if the condition holds, else of no kind of that axis.
inline RunKind kind_if(bool holds, const Scope& scope, std::string if_so, std::string if_not) {
  return holds ? RunKind{scope, std::move(if_so)} : RunKind{{scope.axis, ""}, std::move(if_not)};
}

// The kinds of a run from its parts.
inline RunKinds joined(std::initializer_list<RunKinds> parts) {
  RunKinds all;
  for (const RunKinds& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// The number that is the whole of a text; nothing if it is none. Numbers too small for a double are 0, too large ones infinite.
std::optional<double> number_in(const std::string& text);
// The same; Error(bad_input) where there is none, which names the option.
double number_of(const std::string& text, const char* option);
// The parts of a text between commas; the message for an empty one names the option.
std::vector<std::string> list_of(const std::string& text, const char* option);

// "--name", or FILE of a positional one. CLI11 gives hidden options no name.
std::string name_of(const CLI::Option& option);

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
    // Not together with that option, which was added before.
    Entry& excludes(const std::string& other);
    // Other words for --help, where a subcommand means something else by an option that it shares with others.
    Entry& described(const std::string& description);

   private:
    friend class Options;
    CLI::App* app;
    CLI::Option* option;
    std::function<void(toml::table&)> write;
    std::vector<std::vector<Scope>> needs;
    std::string refusal;

    // Why the option has no effect in this run, or nothing.
    std::string fault(const RunKinds& kinds) const;
  };

  // Adds the subcommand to the program.
  Options(CLI::App& program, const std::string& name, const std::string& description);

  // T is a number, a text, std::optional of one of these, or a list of texts; the instances are in options.cpp.
  template <class T>
  Entry& add(const std::string& name, T& value, const std::string& description);
  // FILE or FILES, under the same name in small letters in the run file.
  template <class T>
  Entry& add_positional(const std::string& name, T& value, const std::string& description);
  Entry& add_flag(const std::string& name, bool& value, const std::string& description);
  // Options that are no part of the resolved run file.
  void add_unsaved(const std::string& name, std::string& value, const std::string& description);
  void add_unsaved(const std::string& name, bool& value, const std::string& description);
  // Not both of these options, of which one is no part of the resolved run file.
  void exclude(const std::string& one, const std::string& other);
  // A flag that names what is done without it too.
  void add_synonym_of_default(const std::string& name, const std::string& description);

  // The added option with this name.
  Entry& at(std::string_view name);
  // All options added from now on are for these kinds of run only, until end_group().
  void begin_group(std::vector<Scope> scopes) { group_ = std::move(scopes); }
  void end_group() { group_.clear(); }

  // Sets the kinds of the run. Throws Error(bad_input) if an option was given, on the command line or in a run file, that has no
  // effect in it.
  void settle(RunKinds kinds);
  // The options that have an effect in the run, with their final values.
  toml::table resolved() const;
  CLI::App& app() { return *app_; }

 private:
  template <class T>
  Entry& keep(CLI::Option* option, const std::string& key, T& value);

  CLI::App* app_;
  std::deque<Entry> entries_;
  std::vector<Scope> group_;
  RunKinds kinds_;
};

}  // namespace lanescape::program
