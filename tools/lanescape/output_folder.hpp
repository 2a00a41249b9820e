#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace lanescape::program {

// The folder of --out or --resume. Nothing is left behind by a run that turns out to have bad input: until keep() is called,
// the destructor removes what this run has made, unless there are checkpoints to resume from.
class OutputFolder {
 public:
  // No folder: every other call does nothing.
  OutputFolder() = default;
  // Made where missing and proved writable; throws Error(bad_input). A folder that holds another run is refused unless resumed.
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
  std::vector<std::filesystem::path> made_here_;  // folders and files, in the order they were made
};

}  // namespace lanescape::program
