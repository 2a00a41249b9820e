#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <toml++/toml.h>

namespace lanescape::program {

// The folder of --out or --resume. Nothing is left behind by a run that turns out to have bad input: until keep() is called,
// the destructor removes what this run has made.
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

  void write_run_file(const std::string& subcommand, const toml::table& resolved);
  void write(const std::string& name, const std::function<void(std::ostream&)>& writer);
  void keep() { made_here_ = false; }

 private:
  std::filesystem::path path_;
  bool made_here_ = false;  // the folder did not exist, and nothing in it is worth keeping yet
};

}  // namespace lanescape::program
