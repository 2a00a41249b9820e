#include "run_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <optional>

#include "core/error.hpp"

namespace lanescape::program {
namespace {

// The value of `--name VALUE` or `--name=VALUE`.
std::optional<std::string> value_of(const std::vector<std::string>& arguments, const std::string& name) {
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    if (arguments[k] == name && k + 1 < arguments.size()) return arguments[k + 1];
    if (arguments[k].starts_with(name + "=")) return arguments[k].substr(name.size() + 1);
  }
  return std::nullopt;
}

bool is_given(const std::vector<std::string>& arguments, const std::string& name) {
  return std::any_of(arguments.begin(), arguments.end(),
                     [&](const std::string& a) { return a == name || a.starts_with(name + "="); });
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
  arguments.push_back(name);
  if (const auto* list = node.as_array())
    for (const auto& item : *list) append_value(arguments, item, where);
  else
    append_value(arguments, node, where);
}

void refuse_flags_besides_resume(const std::vector<std::string>& arguments) {
  static constexpr std::array allowed = {"--resume", "--threads", "--quiet"};
  for (const std::string& argument : arguments) {
    if (!argument.starts_with("--")) continue;
    const std::string name = argument.substr(0, argument.find('='));
    if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
      throw_bad_input(fmt::format("{} is not allowed with --resume: only --threads and --quiet are, the rest is the run's own", name));
  }
}

}  // namespace

std::vector<std::string> with_run_file(const std::vector<std::string>& arguments, const CLI::App& program) {
  if (arguments.empty() || is_given(arguments, "--help") || is_given(arguments, "-h")) return arguments;
  const auto resume = value_of(arguments, "--resume");
  const auto config = resume ? std::optional(*resume + "/run.toml") : value_of(arguments, "--config");
  if (!config) return arguments;
  const auto named = program.get_subcommands([&](const CLI::App* app) { return app->get_name() == arguments.front(); });
  if (named.empty()) return arguments;  // CLI11 knows what to say
  const CLI::App* subcommand = named.front();
  if (resume) refuse_flags_besides_resume(arguments);

  toml::table table;
  try {
    table = toml::parse_file(*config);
  } catch (const toml::parse_error& error) {
    const auto line = error.source().begin.line;
    throw_bad_input(line > 0 ? fmt::format("{}:{}: not a run file: {}", *config, line, error.description())
                             : fmt::format("{}: cannot be read: {}", *config, resume ? "there is no run to resume" : error.description()));
  }
  std::vector<std::string> extended = arguments;
  for (const auto& [key, node] : table) {
    const std::string name = fmt::format("--{}", key.str());
    const std::string where = fmt::format("{}:{}: {}", *config, node.source().begin.line, key.str());
    if (name == "--config" || name == "--resume" || subcommand->get_option_no_throw(name) == nullptr)
      throw_bad_input(fmt::format("{} is not an option of {}, see lanescape {} --help", where, arguments.front(), arguments.front()));
    if (name == "--out" && resume) continue;
    if (!is_given(arguments, name)) append_option(extended, name, node, where);
  }
  return extended;
}

}  // namespace lanescape::program
