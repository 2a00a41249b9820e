#pragma once

#include <filesystem>
#include <functional>
#include <ostream>

namespace lanescape {

// An empty file beside `target` that takes its place on commit() and disappears otherwise, so that readers see the old
// content or the new one, never a part. Errors are Error(bad_input) naming the target and the system's reason.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::filesystem::path target);
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  const std::filesystem::path& path() const { return temporary_; }
  // Writes through a stream; throws if any of it did not reach the system.
  void write(const std::function<void(std::ostream&)>& writer);
  // Content to disk, rename, folder entry to disk. With a name for it the old file stays beside the new one, where the file system
  // has hard links.
  void commit(const std::filesystem::path& old_as = {});

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

// TemporaryFile's write and commit in one go. What `writer` throws passes through and leaves the target as it was.
void write_atomically(const std::filesystem::path& target, const std::function<void(std::ostream&)>& writer);

// Removes what processes that were killed while they wrote have left in a folder. For one that no other process writes to.
void remove_unfinished_files(const std::filesystem::path& folder);

// Creates the folder with its parents where missing and proves that files can be made in it; else Error(bad_input).
void prepare_output_folder(const std::filesystem::path& folder);

}  // namespace lanescape
