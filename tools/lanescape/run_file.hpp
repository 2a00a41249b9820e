#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace lanescape::program {

// The command line with the options of its run file added: those of --config FILE that are not given as flags (flags win), or with
// --resume DIR those of DIR/run.toml. Beside --resume only options that change no result are allowed. Throws Error(bad_input) with
// file and line for a run file that cannot be read or names an unknown option, and what CLI11 throws for the command line.
std::vector<std::string> with_run_file(const std::vector<std::string>& arguments, CLI::App& program);

}  // namespace lanescape::program
