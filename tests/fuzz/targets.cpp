#include "targets.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "core/error.hpp"

namespace lanescape::fuzz {

const std::vector<Target>& all_targets() {
  static const std::vector<Target> targets = {{"extended_xyz", read_extended_xyz, extended_xyz_seeds},
                                              {"model", read_model, model_seeds},
                                              {"command_line", read_command_line, command_line_seeds},
                                              {"run_folder", read_run_folder, run_folder_seeds},
                                              {"archive", read_archive_as_it_is, archive_seeds},
                                              {"archive_content", read_archive_behind_checksum, bare_archive_seeds},
                                              {"path_content", read_path_behind_checksum, path_seeds},
                                              {"host_state", read_host_state, host_state_seeds}};
  return targets;
}

const Target& find_target(std::string_view name) {
  std::string names;
  for (const Target& target : all_targets()) {
    if (name == target.name) return target;
    names += names.empty() ? target.name : std::string(", ") + target.name;
  }
  throw std::invalid_argument("no target '" + std::string(name) + "': there are " + names);
}

std::vector<std::string> files_in(const std::string& folder, std::string_view suffix, std::size_t longest) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(LANESCAPE_SOURCE_DIR) / folder))
    if (entry.path().string().ends_with(suffix) && entry.file_size() <= longest) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> contents;
  for (const auto& path : paths) {
    std::ifstream in(path, std::ios::binary);
    contents.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return contents;
}

MemoryFile::MemoryFile(std::string_view bytes) : descriptor_(::memfd_create("fuzz", 0)) {
  if (descriptor_ < 0 || ::write(descriptor_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
    std::perror("fuzz: no file in memory");
    std::abort();
  }
}
MemoryFile::~MemoryFile() { ::close(descriptor_); }

void refusing(void (*reader)(std::string_view), std::string_view bytes) {
  try {
    reader(bytes);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_input || std::string_view(error.what()).empty()) throw;
  }
}

}  // namespace lanescape::fuzz
