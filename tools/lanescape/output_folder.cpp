#include "output_folder.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/error.hpp"
#include "io/atomic_file.hpp"

namespace lanescape::program {
namespace fs = std::filesystem;

OutputFolder::OutputFolder(fs::path path, bool resume) : path_(std::move(path)) {
  const bool there = fs::exists(path_);
  if (resume && !there) throw_bad_input(fmt::format("{}: there is no run to resume", path_.string()));
  if (!resume && fs::exists(path_ / "run.toml"))
    throw_bad_input(fmt::format("{}: holds a run already: continue it with --resume, or name another folder", path_.string()));
  prepare_output_folder(path_);
  made_here_ = !there;
  fs::create_directories(checkpoints());
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})), made_here_(std::exchange(other.made_here_, false)) {}

OutputFolder& OutputFolder::operator=(OutputFolder&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(made_here_, other.made_here_);
  return *this;
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (exists() && made_here_) {
    fs::remove_all(path_, ignored);
  } else if (exists()) {
    // Removes the folder only if no checkpoint was written.
    fs::remove(checkpoints(), ignored);
  }
}

void OutputFolder::write_run_file(const std::string& subcommand, const toml::table& resolved) {
  write("run.toml", [&](std::ostream& out) {
    out << "# The options this run was made with; lanescape " << subcommand << " --config run.toml repeats it.\n" << resolved << '\n';
  });
}

void OutputFolder::write(const std::string& name, const std::function<void(std::ostream&)>& writer) {
  if (exists()) write_atomically(path_ / name, writer);
}

}  // namespace lanescape::program
