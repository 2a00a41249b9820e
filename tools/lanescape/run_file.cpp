#include "run_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/error.hpp"
#include "io/toml.hpp"
#include "options.hpp"
#include "resume_or_start.hpp"

namespace lanescape::program {
namespace {

// The option with this name in a run file; null if there is none.
const CLI::Option* find_option(const CLI::App& subcommand, const std::string& key) {
  if (key == "help" || key == "config" || key == "resume" || key == "resume-or-start") return nullptr;
  for (const CLI::Option* option : subcommand.get_options())
    if (option->check_lname(key) || (option->get_positional() && key_of(*option) == key)) return option;
  return nullptr;
}

void append_value(std::vector<std::string>& arguments, const toml::node& node, const std::string& where) {
  if (const auto* text = node.as_string())
    arguments.push_back(text->get());
  else if (const auto* whole = node.as_integer())
    arguments.push_back(fmt::format("{}", whole->get()));
  else if (const auto* real = node.as_floating_point())
    arguments.push_back(fmt::format("{}", real->get()));
  else
    throw_bad_input(fmt::format("{}: a number, a text, true, false or a list of these is allowed", where));
}

void append_option(std::vector<std::string>& arguments, const std::string& name, const toml::node& node, const std::string& where) {
  if (const auto* flag = node.as_boolean()) {
    if (flag->get()) arguments.push_back(name);
    return;
  }
  if (name.starts_with("--")) arguments.push_back(name);
  for (const std::string& value : values_of(node, where)) arguments.push_back(value);
}

void refuse_options_besides_resume(const CLI::App& subcommand) {
  static constexpr std::array allowed = {"--resume", "--threads", "--quiet"};
  for (const CLI::Option* option : subcommand.get_options())
    if (option->count() > 0 && std::find(allowed.begin(), allowed.end(), name_of(*option)) == allowed.end())
      throw_bad_input(fmt::format("{} is not allowed with --resume: only --threads and --quiet are, the rest is the run's own",
                                  name_of(*option)));
}

// The subcommand of a command line, some of whose options may still be missing.
const CLI::App& parsed_subcommand(const std::vector<std::string>& arguments, CLI::App& program) {
  try {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // as CLI11 takes them
    program.parse(reversed);
  } catch (const CLI::RequiredError&) {
    // The run file may have what is missing.
  }
  if (!program.get_subcommands().empty()) return *program.get_subcommands().front();
  std::string names;
  for (const CLI::App* app : program.get_subcommands([](const CLI::App*) { return true; }))
    names += (names.empty() ? "" : ", ") + app->get_name();
  throw_bad_input(
      fmt::format("'{}' is no subcommand: {} are allowed (see --help)", arguments.empty() ? "" : arguments.front(), names));
}

toml::table read_run_file(const std::string& file, bool resume) {
  // toml++ reads a folder as an empty file.
  if (std::filesystem::is_directory(file)) throw_bad_input(fmt::format("{}: it is a folder: a run file (TOML) is needed", file));
  try {
    return toml::parse_file(file);
  } catch (const toml::parse_error& error) {
    const auto line = error.source().begin.line;
    throw_bad_input(line > 0
                        ? fmt::format("{}:{}: not a run file: {}", file, line, error.description())
                        : fmt::format("{}: cannot be read: {}", file, resume ? "there is no run to resume" : error.description()));
  }
}

// Whether a value of a run file is the option's default. Run files of earlier versions also hold defaults of options without an
// effect.
bool is_default(const CLI::Option& option, const toml::node& node, const std::string& where) {
  if (node.is_array() || node.is_boolean() || option.get_default_str().empty()) return false;
  std::vector<std::string> value;
  append_value(value, node, where);
  return value.front() == option.get_default_str();
}

// Arguments of one entry of a run file: positional ones and the others.
struct RunFileArguments {
  std::vector<std::string> positionals, added;

  void add(const CLI::Option& option, const toml::node& node, const std::string& where) {
    if (!is_default(option, node, where))
      append_option(option.get_positional() ? positionals : added, name_of(option), node, where);
  }
};

// The arguments with those entries of a run file that they do not give themselves. `file` starts messages.
std::vector<std::string> with_entries(const std::vector<std::string>& arguments, const CLI::App& subcommand,
                                      const toml::table& table, const std::string& file, bool keeps_folder) {
  RunFileArguments from_file;
  const std::string& name = subcommand.get_name();
  for (const auto& [key, node] : table) {
    const std::string where = fmt::format("{}:{}: {}", file, node.source().begin.line, key.str());
    if (key == "subcommand") {
      const std::string other = node.value_or(std::string("?"));
      if (other != name)
        throw_bad_input(fmt::format("{} is {}, this is {}: the run file belongs to the former", where, other, name));
      continue;
    }
    const CLI::Option* option = find_option(subcommand, std::string(key.str()));
    if (option == nullptr) throw_bad_input(fmt::format("{} is not an option of {}, see lanescape {} --help", where, name, name));
    if (option->count() == 0 && !(keeps_folder && key == "out")) from_file.add(*option, node, where);
  }
  // Positional arguments come first: CLI11 would take them for more values of the option before them.
  std::vector<std::string> extended = {arguments.front()};
  for (const auto* part : {&from_file.positionals, &from_file.added}) extended.insert(extended.end(), part->begin(), part->end());
  extended.insert(extended.end(), arguments.begin() + 1, arguments.end());
  return extended;
}

bool given(const CLI::App& subcommand, const char* name) { return subcommand.get_option(name)->count() > 0; }

std::string value_of(const CLI::App& subcommand, const char* name) { return subcommand.get_option(name)->as<std::string>(); }

// The arguments with another option in the place of --resume-or-start DIR or --resume-or-start=DIR.
std::vector<std::string> with_folder_as(const char* name, std::vector<std::string> arguments) {
  static const std::string replaced = "--resume-or-start";
  for (std::string& argument : arguments)
    if (argument == replaced || argument.starts_with(replaced + "=")) argument.replace(0, replaced.size(), name);
  return arguments;
}

// `config`: the run file of --config, or nothing.
CommandLine resumed_or_started(const std::vector<std::string>& arguments, const CLI::App& subcommand, const toml::table& config) {
  const std::filesystem::path folder = value_of(subcommand, "--resume-or-start");
  if (folder.empty()) throw_bad_input("--resume-or-start: the name of a folder is needed");
  const std::string file = (folder / "run.toml").string();
  if (!std::filesystem::exists(file))
    return {with_folder_as("--out", with_entries(arguments, subcommand, config, value_of(subcommand, "--config"), true)), {}};
  const toml::table stored = read_run_file(file, true);
  const std::vector<std::string> extended = with_entries(arguments, subcommand, stored, file, true);
  refuse_contradictions(subcommand, stored, file);
  refuse_contradictions(subcommand, config, stored, file);
  // Figures come after the result, so they may be missing and are drawn again; of an engine's processes one alone prints the
  // result.
  const bool resumed_anyway = stored["plot"].value_or(false) || stored.contains("landscape");
  return {with_folder_as("--resume", extended), resumed_anyway ? std::filesystem::path() : folder};
}

}  // namespace

std::string key_of(const CLI::Option& option) {
  return option.get_lnames().empty() ? CLI::detail::to_lower(option.get_name()) : option.get_lnames().front();
}

std::vector<std::string> values_of(const toml::node& node, const std::string& where) {
  std::vector<std::string> values;
  if (const auto* flag = node.as_boolean())
    values.push_back(flag->get() ? "true" : "false");
  else if (const auto* list = node.as_array())
    for (const auto& item : *list) append_value(values, item, where);
  else
    append_value(values, node, where);
  return values;
}

CommandLine with_run_file(const std::vector<std::string>& arguments, CLI::App& program) {
  const CLI::App& subcommand = parsed_subcommand(arguments, program);
  if (given(subcommand, "--resume")) {
    refuse_options_besides_resume(subcommand);
    const std::string file = value_of(subcommand, "--resume") + "/run.toml";
    return {with_entries(arguments, subcommand, read_run_file(file, true), file, true), {}};
  }
  const std::string file = given(subcommand, "--config") ? value_of(subcommand, "--config") : "";
  const toml::table config = given(subcommand, "--config") ? read_run_file(file, false) : toml::table{};
  if (given(subcommand, "--resume-or-start")) return resumed_or_started(arguments, subcommand, config);
  return {with_entries(arguments, subcommand, config, file, false), {}};
}

}  // namespace lanescape::program
