#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <iostream>
#include <new>

#include "core/error.hpp"
#include "lanescape/lanescape.hpp"
#include "program.hpp"
#include "resume_or_start.hpp"
#include "run_file.hpp"

namespace {

using namespace lanescape;
using namespace lanescape::program;

// One line: line breaks in the message become blanks.
void complain(std::string message) {
  for (char& c : message)
    if (c == '\n' || c == '\r') c = ' ';
  std::cerr << "lanescape: " << message << '\n';
}

// Prints a result; the exit status that follows.
int printed(const std::string& result, int status) {
  std::cout << result << std::flush;
  if (std::cout) return status;
  complain("stdout: the result cannot be written");
  return internal_error;
}

int run(const std::vector<std::string>& arguments) {
  CLI::App app("Landscape geodesics of liquids and the kernels beneath them. Results are one JSON object on stdout.", "lanescape");
  app.set_version_flag("--version", version());
  app.get_formatter()->column_width(34);
  app.footer(
      "Exit status: 0 done, 1 the goal was not reached or figures failed, 2 bad input, 3 a defect,\n"
      "4 interrupted by SIGINT or SIGTERM: --resume continues.");
  const std::vector<Subcommand> subcommands = add_subcommands(app);
  try {
    CommandLine line = with_run_file(arguments, app);
    // CLI11 takes arguments in reverse.
    std::reverse(line.arguments.begin(), line.arguments.end());
    app.parse(line.arguments);
    if (const auto finished = line.begun.empty() ? std::nullopt : finished_run(line.begun))
      return printed(finished->result, finished->status);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help and --version
    complain(fmt::format("{} (see --help)", error.what()));
    return bad_input_status;
  }
  install_signal_handlers();
  for (const Subcommand& subcommand : subcommands) {
    if (!subcommand.app->parsed()) continue;
    int status = done;
    const Json result = subcommand.run(status);
    if (result.is_null()) return status;  // of a process that has served another one
    return printed(text_of_result(result) + '\n', status);
  }
  return internal_error;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (const Error& error) {
    complain(error.what());
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    complain("out of memory");
  } catch (const std::exception& error) {
    complain(fmt::format("internal error: {}", error.what()));
  }
  return internal_error;
}
