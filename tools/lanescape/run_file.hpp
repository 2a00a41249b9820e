#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "io/toml.hpp"

namespace lanescape::program {

// A command line with the options of its run file added.
struct CommandLine {
  std::vector<std::string> arguments;
  std::filesystem::path begun;  // folder of --resume-or-start with a run that may have ended, else empty
};

// Adds the options of --config FILE that are not given as flags (flags win), or with --resume DIR those of DIR/run.toml. Beside
// --resume only options that change no result are allowed. --resume-or-start DIR becomes --resume where DIR holds a run, whose
// options then must not differ from those given, and --out elsewhere. Throws Error(bad_input) with file and line for a run file
// that cannot be read or names an unknown option, and what CLI11 throws for the command line.
CommandLine with_run_file(const std::vector<std::string>& arguments, CLI::App& program);

// The name of an option in run files.
std::string key_of(const CLI::Option& option);
// The values of an entry of a run file as arguments. `where` begins the message that refuses other kinds of values.
std::vector<std::string> values_of(const toml::node& node, const std::string& where);

}  // namespace lanescape::program
