#include "run_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/error.hpp"
#include "options.hpp"

namespace lanescape::program {
namespace {

// The option with this name in a run file; null if there is none.
const CLI::Option* find_option(const CLI::App& subcommand, const std::string& key) {
  if (key == "help" || key == "config" || key == "resume") return nullptr;
  for (const CLI::Option* option : subcommand.get_options())
    if (option->check_lname(key) || (option->get_positional() && CLI::detail::to_lower(option->get_name()) == key)) return option;
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
  if (const auto* list = node.as_array())
    for (const auto& item : *list) append_value(arguments, item, where);
  else
    append_value(arguments, node, where);
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

}  // namespace

std::vector<std::string> with_run_file(const std::vector<std::string>& arguments, CLI::App& program) {
  const CLI::App& subcommand = parsed_subcommand(arguments, program);
  const auto given = [&](const char* name) { return subcommand.get_option(name)->count() > 0; };
  const bool resume = given("--resume");
  if (!resume && !given("--config")) return arguments;
  const auto file = resume ? subcommand.get_option("--resume")->as<std::string>() + "/run.toml"
                           : subcommand.get_option("--config")->as<std::string>();
  if (resume) refuse_options_besides_resume(subcommand);

  RunFileArguments from_file;
  const std::string& name = subcommand.get_name();
  for (const auto& [key, node] : read_run_file(file, resume)) {
    const std::string where = fmt::format("{}:{}: {}", file, node.source().begin.line, key.str());
    if (key == "subcommand") {
      const std::string other = node.value_or(std::string("?"));
      if (other != name)
        throw_bad_input(fmt::format("{} is {}, this is {}: the run file belongs to the former", where, other, name));
      continue;
    }
    const CLI::Option* option = find_option(subcommand, std::string(key.str()));
    if (option == nullptr) throw_bad_input(fmt::format("{} is not an option of {}, see lanescape {} --help", where, name, name));
    if (option->count() == 0 && !(resume && key == "out")) from_file.add(*option, node, where);
  }
  // Positional arguments come first: CLI11 would take them for more values of the option before them.
  std::vector<std::string> extended = {arguments.front()};
  for (const auto* part : {&from_file.positionals, &from_file.added}) extended.insert(extended.end(), part->begin(), part->end());
  extended.insert(extended.end(), arguments.begin() + 1, arguments.end());
  return extended;
}

}  // namespace lanescape::program
