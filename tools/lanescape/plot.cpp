#include "plot.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

namespace lanescape::program {

namespace {

// LANESCAPE_PLOT_SCRIPT in the environment, else beside an installed program, else in the source tree it was built from.
std::string plot_script() {
  if (const char* given = std::getenv("LANESCAPE_PLOT_SCRIPT")) return given;
  return std::filesystem::exists(LANESCAPE_INSTALLED_PLOT_SCRIPT) ? LANESCAPE_INSTALLED_PLOT_SCRIPT : LANESCAPE_PLOT_SCRIPT;
}

}  // namespace

void draw_plots(const std::filesystem::path& folder, const CommonOptions& common) {
  const std::string script_path = plot_script();
  const std::string folder_path = folder.string();
  const pid_t child = fork();
  if (child == 0) {
    // stdout belongs to the JSON result.
    dup2(STDERR_FILENO, STDOUT_FILENO);
    execl(LANESCAPE_PYTHON, LANESCAPE_PYTHON, script_path.c_str(), folder_path.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  const bool ended = child > 0 && waitpid(child, &status, 0) == child;
  if (!ended || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    say(common, fmt::format("the plots could not be drawn: {} {} {} failed", LANESCAPE_PYTHON, script_path, folder_path));
}

}  // namespace lanescape::program
