#include "output_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "io/atomic_file.hpp"

namespace lanescape::program {
namespace fs = std::filesystem;

OutputFolder::OutputFolder(fs::path path, bool resume) : path_(std::move(path)) {
  if (resume && !fs::exists(path_)) throw_bad_input(fmt::format("{}: there is no run to resume", path_.string()));
  if (!resume && fs::exists(path_ / "run.toml"))
    throw_bad_input(fmt::format("{}: holds a run already: continue it with --resume, or name another folder", path_.string()));
  for (fs::path folder = path_; !folder.empty() && !fs::exists(folder); folder = folder.parent_path()) made_here_.push_back(folder);
  std::reverse(made_here_.begin(), made_here_.end());
  prepare_output_folder(path_);
  lock_ = FolderLock(path_);
  fs::create_directories(checkpoints());
  // Of a run that was killed, even before it had written run.toml.
  for (const fs::path& folder : {path_, checkpoints()}) remove_unfinished_files(folder);
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})), lock_(std::move(other.lock_)), made_here_(std::exchange(other.made_here_, {})) {}

OutputFolder& OutputFolder::operator=(OutputFolder&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(lock_, other.lock_);
  std::swap(made_here_, other.made_here_);
  return *this;
}

OutputFolder::~OutputFolder() {
  if (!exists()) return;
  std::error_code ignored;
  // Of folders only empty ones are removed.
  fs::remove(checkpoints(), ignored);
  if (fs::exists(checkpoints(), ignored)) return;
  for (auto made = made_here_.rbegin(); made != made_here_.rend(); ++made) fs::remove(*made, ignored);
}

void OutputFolder::write_run_file(const std::string& subcommand, toml::table resolved) {
  resolved.insert_or_assign("subcommand", subcommand);
  write("run.toml", [&](std::ostream& out) {
    out << "# The options this run was made with; lanescape " << subcommand << " --config run.toml repeats it.\n"
        << resolved << '\n';
  });
}

void OutputFolder::write(const std::string& name, const std::function<void(std::ostream&)>& writer) {
  if (!exists()) return;
  const fs::path file = path_ / name;
  const bool there = fs::exists(file);
  write_atomically(file, writer);
  if (!there) made_here_.push_back(file);
}

}  // namespace lanescape::program
