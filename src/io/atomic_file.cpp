#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace lanescape {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void refuse_writing(const fs::path& target, const std::string& why) {
  throw_bad_input(fmt::format("cannot write {}: {}; a writable place with free space is needed", target.string(), why));
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }
  bool valid() const { return fd_ >= 0; }

 private:
  int fd_;
};

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

// Some file systems cannot sync this kind of object and say EINVAL; there is nothing more to do for them.
void sync_to_disk(const fs::path& path, int flags, const fs::path& target) {
  const Descriptor descriptor(::open(path.c_str(), flags | O_CLOEXEC));
  if (!descriptor.valid() || (::fsync(descriptor.get()) != 0 && errno != EINVAL)) refuse_writing(target, reason(errno));
}

struct Created {
  fs::path path;
  int error;  // of the system; 0: the file is there, and empty
};

constexpr std::string_view temporary_prefix = ".lanescape-", temporary_suffix = ".tmp";

fs::path temporary_name(const fs::path& folder) {
  static std::atomic<unsigned> counter{0};
  return folder / fmt::format("{}{}-{}{}", temporary_prefix, ::getpid(), counter++, temporary_suffix);
}

// Gives a file a second name, in one step. A second link to the same file has no moment without a whole file under the first name.
void keep_beside(const fs::path& file, const fs::path& name) {
  const fs::path link = temporary_name(folder_of(name));
  if (::link(file.c_str(), link.c_str()) != 0) return;  // no such file yet, or no links here: nothing is kept
  static_cast<void>(::rename(link.c_str(), name.c_str()));
  ::unlink(link.c_str());  // still there where both are links to one file already: rename then does nothing
}

// Exclusive creation: another process, or the remains of one that was killed, keeps its own file. The usual mode and umask
// apply, which mkstemp would not give.
Created create_in(const fs::path& folder) {
  for (;;) {
    fs::path candidate = temporary_name(folder);
    const Descriptor descriptor(::open(candidate.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (descriptor.valid()) return {std::move(candidate), 0};
    if (errno != EEXIST) return {{}, errno};
  }
}

}  // namespace

TemporaryFile::TemporaryFile(fs::path target) : target_(std::move(target)) {
  std::error_code ignored;
  const fs::file_status status = fs::status(target_, ignored);
  // A rename would replace a device or fail late on a folder.
  if (target_.empty() || (fs::exists(status) && !fs::is_regular_file(status)))
    refuse_writing(target_.empty() ? "''" : target_, "it is not the name of a regular file");
  Created created = create_in(folder_of(target_));
  if (created.error != 0) refuse_writing(target_, reason(created.error));
  temporary_ = std::move(created.path);
}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  if (!committed_) fs::remove(temporary_, ignored);
}

void TemporaryFile::write(const std::function<void(std::ostream&)>& writer) {
  errno = 0;
  std::ofstream out(temporary_, std::ios::binary | std::ios::trunc);
  if (out) writer(out);
  out.close();
  if (!out) refuse_writing(target_, errno != 0 ? reason(errno) : "the stream failed");
}

void TemporaryFile::commit(const fs::path& old_as) {
  sync_to_disk(temporary_, O_WRONLY, target_);
  if (!old_as.empty()) keep_beside(target_, old_as);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) refuse_writing(target_, reason(errno));
  committed_ = true;
  sync_to_disk(folder_of(target_), O_RDONLY | O_DIRECTORY, target_);
}

void write_atomically(const fs::path& target, const std::function<void(std::ostream&)>& writer) {
  TemporaryFile file(target);
  file.write(writer);
  file.commit();
}

void remove_unfinished_files(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(temporary_prefix) && name.ends_with(temporary_suffix)) fs::remove(entry.path(), ignored);
  }
}

void prepare_output_folder(const fs::path& folder) {
  const auto refuse = [&](const std::string& why) {
    throw_bad_input(
        fmt::format("output folder '{}' cannot be used: {}; a folder in which files can be made is needed", folder.string(), why));
  };
  if (folder.empty()) refuse("the name is empty");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse(error.message());
  if (!fs::is_directory(folder, error)) refuse("it is not a folder");
  const Created probe = create_in(folder);
  if (probe.error != 0) refuse(reason(probe.error));
  // A full disk or a spent quota shows only when a byte is written.
  std::ofstream out(probe.path, std::ios::binary);
  out.put('\n');
  out.close();
  const bool written = !out.fail();
  fs::remove(probe.path, error);
  if (!written || error) refuse("a file made there cannot be written and removed");
}

}  // namespace lanescape
