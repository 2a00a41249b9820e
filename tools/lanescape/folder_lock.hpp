#pragma once

#include <filesystem>
#include <utility>

namespace lanescape::program {

// Keeps other runs out of a folder until it is destroyed or the process ends, however it ends: nothing is left behind. File systems
// without locks, such as some network ones, do not keep them out.
class FolderLock {
 public:
  // No folder.
  FolderLock() = default;
  // Throws Error(bad_input) if another run holds it.
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(FolderLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FolderLock& operator=(FolderLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FolderLock();

 private:
  int descriptor_ = -1;
};

}  // namespace lanescape::program
