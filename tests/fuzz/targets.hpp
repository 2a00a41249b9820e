#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

// Readers of what comes from outside, each fed with arbitrary bytes. A reader accepts them or throws Error(bad_input) with a
// message; whatever else it does is a defect.
namespace lanescape::fuzz {

struct Target {
  const char* name;
  void (*feed)(std::string_view bytes);
  std::vector<std::string> (*seeds)();  // input to start from
};

const std::vector<Target>& all_targets();
// Throws std::invalid_argument, with the names there are, for another one.
const Target& find_target(std::string_view name);

// Files under LANESCAPE_SOURCE_DIR with a suffix, no longer than `longest` bytes, in the order of their names.
std::vector<std::string> files_in(const std::string& folder, std::string_view suffix, std::size_t longest);

// Bytes as a file, for readers that take a path. It lives in memory.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes);
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile();
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

// Runs a reader; what it refuses is well, as long as the message says something.
void refusing(void (*reader)(std::string_view), std::string_view bytes);

// The targets.
void read_extended_xyz(std::string_view bytes);
void read_model(std::string_view bytes);
void read_command_line(std::string_view bytes);
void read_run_folder(std::string_view bytes);
void read_archive_as_it_is(std::string_view bytes);
void read_archive_behind_checksum(std::string_view bytes);
void read_path_behind_checksum(std::string_view bytes);
void read_host_state(std::string_view bytes);

std::vector<std::string> extended_xyz_seeds();
std::vector<std::string> model_seeds();
std::vector<std::string> command_line_seeds();
std::vector<std::string> run_folder_seeds();
std::vector<std::string> archive_seeds();
std::vector<std::string> bare_archive_seeds();
std::vector<std::string> path_seeds();
std::vector<std::string> host_state_seeds();

}  // namespace lanescape::fuzz
