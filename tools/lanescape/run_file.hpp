#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace lanescape::program {

// The command line with the options of its run file put in: those of --config FILE that are not given as flags (flags win), or
// with --resume DIR those of DIR/run.toml. With --resume only options that change no result may be given besides. Throws
// Error(bad_input) for a run file that cannot be read or names an unknown option, with file and line, and what CLI11 throws for the
// command line itself.
std::vector<std::string> with_run_file(const std::vector<std::string>& arguments, CLI::App& program);

}  // namespace lanescape::program
