#include "plot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <iostream>
#include <string>

#include "program.hpp"

namespace lanescape::program {
namespace fs = std::filesystem;

namespace {

// Where plot.py may lie, from the program's own folder: an installation can be moved, and so can a build folder.
constexpr const char* script_places[] = {LANESCAPE_INSTALLED_PLOT_SCRIPT, "share/lanescape/plot.py"};

fs::path plot_script() {
  const fs::path own_folder = fs::read_symlink("/proc/self/exe").parent_path();
  for (const char* place : script_places)
    if (const fs::path script = (own_folder / place).lexically_normal(); fs::exists(script)) return script;
  throw_bad_input(fmt::format("--plot: {} is missing: the scripts installed with the program are needed",
                              (own_folder / script_places[0]).lexically_normal().string()));
}

// The Python of the build, which has matplotlib, or on another machine the first on PATH.
std::string python() { return access(LANESCAPE_PYTHON, X_OK) == 0 ? LANESCAPE_PYTHON : "python3"; }

// Runs plot.py without output: stdout belongs to the JSON result, and stderr to one line.
bool succeeds(const fs::path& script, const char* argument) {
  const std::string interpreter = python();
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    execlp(interpreter.c_str(), interpreter.c_str(), script.c_str(), argument, static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

void check_plots() {
  const fs::path script = plot_script();
  if (succeeds(script, "--help")) return;
  throw_bad_input(
      fmt::format("--plot: {} {} does not start: Python 3 with numpy and matplotlib is needed", python(), script.string()));
}

void draw_plots(const fs::path& folder, int& status) {
  const fs::path script = plot_script();
  if (succeeds(script, folder.c_str())) return;
  std::cerr << fmt::format("lanescape: --plot: no figures in {}: {} {} {} failed and says why where it is run alone\n",
                           folder.string(), python(), script.string(), folder.string());
  if (status == done) status = goal_not_reached;
}

}  // namespace lanescape::program
