#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "folder_lock.hpp"
#include "io/toml.hpp"

namespace lanescape::program {

// The folder of --out or --resume. A run with bad input leaves nothing behind: until keep() is called, the destructor removes what
// this run has made, unless there are checkpoints to resume from.
class OutputFolder {
 public:
  // No folder: every other call does nothing.
  OutputFolder() = default;
  // Makes a missing folder and checks that it is writable; throws Error(bad_input). Refuses a folder with another run unless
  // resumed, and one in which another run is at work.
  OutputFolder(std::filesystem::path path, bool resume);
  OutputFolder(OutputFolder&& other) noexcept;
  OutputFolder& operator=(OutputFolder&& other) noexcept;
  ~OutputFolder();

  bool exists() const { return !path_.empty(); }
  const std::filesystem::path& path() const { return path_; }
  // For checkpoints; empty where there is no folder.
  std::filesystem::path checkpoints() const { return exists() ? path_ / "checkpoint" : std::filesystem::path(); }

  void write_run_file(const std::string& subcommand, toml::table resolved);
  void write(const std::string& name, const std::function<void(std::ostream&)>& writer);
  void keep() { made_here_.clear(); }

 private:
  std::filesystem::path path_;
  FolderLock lock_;
  std::vector<std::filesystem::path> made_here_;  // folders and files, in the order they were made
};

}  // namespace lanescape::program
