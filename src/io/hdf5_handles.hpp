#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// What the writer and the reader of archives share: owners of handles of the HDF5 library.
namespace lanescape::hdf5 {

inline constexpr std::uint64_t format_version = 1;
inline constexpr const char* version_attribute = "format_version";

// Holds the lock of all archives and silences the library's error printer, which belongs to the process, until the end of the
// scope. Every archive is closed by its owner, so the library's clean-up at exit is not needed. After a damaged object header,
// release 1.10 leaks memory for which that clean-up waits and complains on stderr, so it is disabled. A host that used HDF5 before
// the first archive keeps it.
class Session {
 public:
  Session() : lock_(mutex()) {
    H5Eget_auto2(H5E_DEFAULT, &printer_, &printer_data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() { H5Eset_auto2(H5E_DEFAULT, printer_, printer_data_); }

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    static const herr_t without_exit_handler = H5dont_atexit();
    static_cast<void>(without_exit_handler);
    return instance;
  }

  std::lock_guard<std::mutex> lock_;
  H5E_auto2_t printer_ = nullptr;
  void* printer_data_ = nullptr;
};

// An identifier of the library and the function that releases it.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      close();
      id_ = std::exchange(other.id_, -1);
      close_ = other.close_;
    }
    return *this;
  }
  ~Handle() { close(); }

  // False where the library fails to close.
  bool close() {
    const hid_t id = std::exchange(id_, -1);
    return id < 0 || close_(id) >= 0;
  }
  hid_t get() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

inline hid_t stored_type(const double*) { return H5T_IEEE_F64LE; }
inline hid_t stored_type(const std::uint64_t*) { return H5T_STD_U64LE; }
inline hid_t memory_type(const double*) { return H5T_NATIVE_DOUBLE; }
inline hid_t memory_type(const std::uint64_t*) { return H5T_NATIVE_UINT64; }
inline const char* type_words(const double*) { return "64-bit floating-point"; }
inline const char* type_words(const std::uint64_t*) { return "64-bit unsigned integer"; }

// The type of a text of `size` bytes with its terminator. Bytes are kept, zeros included.
Handle string_type(std::size_t size);
Handle file_access();

// The open groups from the root down, and the path that messages give.
class GroupStack {
 public:
  void push(std::string_view name, Handle group) {
    names_.emplace_back(name);
    groups_.push_back(std::move(group));
  }
  void pop() {
    names_.pop_back();
    groups_.pop_back();
  }
  void clear() {
    while (!at_root()) pop();
  }
  bool at_root() const { return groups_.empty(); }
  hid_t current(const Handle& file) const { return at_root() ? file.get() : groups_.back().get(); }
  std::string path_of(std::string_view name) const {
    std::string path;
    for (const std::string& group : names_) path += '/' + group;
    return path + '/' + std::string(name);
  }

 private:
  std::vector<std::string> names_;
  std::vector<Handle> groups_;
};

// An archive's implementation with its file opened, under the lock. If that fails its handles are released under the lock too.
template <class Impl>
std::unique_ptr<Impl> opened(const std::filesystem::path& path) {
  auto impl = std::make_unique<Impl>(path);
  const Session session;
  try {
    impl->open();
  } catch (...) {
    impl.reset();
    throw;
  }
  return impl;
}

[[noreturn]] void throw_misuse(const std::string& message);
// Names are links: a slash or a dot would lead elsewhere.
void check_name(std::string_view name);

}  // namespace lanescape::hdf5
