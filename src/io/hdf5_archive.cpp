#include "io/hdf5_archive.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <mutex>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "io/atomic_file.hpp"

namespace lanescape {
namespace {

constexpr std::uint64_t format_version = 1;
constexpr const char* version_attribute = "format_version";

// Up to here data live in the object header, which carries a checksum; beyond, in chunks with a Fletcher sum. [bytes]
constexpr std::size_t largest_compact = 8192;
constexpr std::size_t chunk_bytes = std::size_t{1} << 19;

// The lock of all archives, and silence for the library's error printer, which belongs to the process and is put back.
// Every archive is closed by its owner, so the library's own clean-up at exit is not needed; where a damaged object header was
// met, release 1.10 has lost memory that this clean-up then waits for, and complains on stderr. A host that used HDF5 before
// the first archive keeps the clean-up.
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

// An identifier of the library and the function that gives it back.
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

hid_t stored_type(const double*) { return H5T_IEEE_F64LE; }
hid_t stored_type(const std::uint64_t*) { return H5T_STD_U64LE; }
hid_t memory_type(const double*) { return H5T_NATIVE_DOUBLE; }
hid_t memory_type(const std::uint64_t*) { return H5T_NATIVE_UINT64; }
const char* type_words(const double*) { return "64-bit floating-point"; }
const char* type_words(const std::uint64_t*) { return "64-bit unsigned integer"; }

// One byte more than the text, so that the empty text has a size the library accepts. Bytes are kept, zeros included.
Handle string_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), size);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

Handle file_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // The first format in which every piece of metadata has a checksum, and no younger one than older readers know.
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110);
  // Locks fail on some network file systems; the rename is all the protection that is needed.
  H5Pset_file_locking(access.get(), false, true);
  return access;
}

// The memory of a file under construction, lent to the library's in-memory driver through its callbacks. It outlives the
// file: only closing gives the superblock its last state and checksum, and H5Fget_file_image of release 1.10 leaves a wrong one.
class FileMemory {
 public:
  FileMemory() = default;
  FileMemory(const FileMemory&) = delete;
  FileMemory& operator=(const FileMemory&) = delete;
  ~FileMemory() { std::free(data_); }

  void lend(hid_t access) {
    constexpr std::size_t increment = std::size_t{1} << 16;
    H5Pset_fapl_core(access, increment, false);
    H5FD_file_image_callbacks_t callbacks{};
    callbacks.image_malloc = [](std::size_t size, H5FD_file_image_op_t, void* self) { return resize(self, size); };
    callbacks.image_realloc = [](void*, std::size_t size, H5FD_file_image_op_t, void* self) { return resize(self, size); };
    callbacks.image_free = [](void*, H5FD_file_image_op_t, void*) { return herr_t{0}; };
    callbacks.udata_copy = [](void* self) { return self; };
    callbacks.udata_free = [](void*) { return herr_t{0}; };
    callbacks.udata = this;
    H5Pset_file_image_callbacks(access, &callbacks);
  }
  const char* data() const { return static_cast<const char*>(data_); }
  std::size_t size() const { return size_; }

 private:
  static void* resize(void* self, std::size_t size) {
    auto& memory = *static_cast<FileMemory*>(self);
    void* const data = std::realloc(memory.data_, size);
    if (data == nullptr) return nullptr;
    memory.size_ = size;
    return memory.data_ = data;
  }

  void* data_ = nullptr;
  std::size_t size_ = 0;
};

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

[[noreturn]] void throw_misuse(const std::string& message) { throw Error(ErrorCode::internal, message); }

// Names are links: a slash or a dot would lead elsewhere.
void check_name(std::string_view name) {
  if (name.empty() || name == "." || name.find('/') != std::string_view::npos || name.find('\0') != std::string_view::npos)
    throw_misuse(fmt::format("archive name '{}' is not allowed: it must be a plain word", name));
}

}  // namespace

struct Hdf5Writer::Impl {
  explicit Impl(const std::filesystem::path& path) : path_(path.string()), temporary_(path) {}

  void open() {
    const Handle access = file_access();
    memory_.lend(access.get());
    file_ = Handle(H5Fcreate(temporary_.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate2(file_.get(), version_attribute, H5T_STD_U64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    if (!attribute.valid() || H5Awrite(attribute.get(), H5T_NATIVE_UINT64, &format_version) < 0)
      throw_misuse(fmt::format("{}: the HDF5 library cannot make a file", path_));
  }

  void need_open(std::string_view name) const {
    if (!file_.valid()) throw_misuse(fmt::format("{}: {} comes after commit()", path_, name));
    check_name(name);
  }

  // `count` elements; a scalar where `shape` is H5S_SCALAR.
  void write(std::string_view name, hid_t stored, hid_t memory, H5S_class_t shape, std::size_t count, const void* data) {
    const std::size_t size = H5Tget_size(stored);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation.get(), false);  // the same state makes the same file
    const hsize_t extent = count;
    if (count * size <= largest_compact) {
      H5Pset_layout(creation.get(), H5D_COMPACT);
    } else {
      const hsize_t chunk = std::clamp<std::size_t>(chunk_bytes / size, 1, count);
      H5Pset_chunk(creation.get(), 1, &chunk);
      H5Pset_fletcher32(creation.get());
      shape = H5S_SIMPLE;  // only arrays have chunks; a long text becomes an array of one
    }
    const Handle space(shape == H5S_SCALAR ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &extent, nullptr), H5Sclose);
    const Handle set(H5Dcreate2(groups_.current(file_), std::string(name).c_str(), stored, space.get(), H5P_DEFAULT, creation.get(),
                                H5P_DEFAULT),
                     H5Dclose);
    if (!set.valid() || (count > 0 && H5Dwrite(set.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0))
      throw_misuse(fmt::format("{}: field {} cannot be stored: each name once and data that fit into memory are allowed", path_,
                               groups_.path_of(name)));
  }

  template <class Number>
  void scalar(std::string_view name, const Number& value) {
    const Session session;
    need_open(name);
    write(name, stored_type(&value), memory_type(&value), H5S_SCALAR, 1, &value);
  }

  template <class Array>
  void array(std::string_view name, const Array& value) {
    const Session session;
    need_open(name);
    write(name, stored_type(value.data()), memory_type(value.data()), H5S_SIMPLE, value.size(), value.data());
  }

  // Ends the file and gives its length in memory_.
  std::size_t finish() {
    groups_.clear();
    const bool flushed = H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) >= 0;
    const ssize_t size = H5Fget_file_image(file_.get(), nullptr, 0);
    const bool closed = file_.close();
    if (!flushed || !closed || size <= 0 || static_cast<std::size_t>(size) > memory_.size())
      throw_misuse(fmt::format("{}: the HDF5 library cannot finish the file", path_));
    return static_cast<std::size_t>(size);
  }

  std::string path_;
  TemporaryFile temporary_;
  FileMemory memory_;
  Handle file_;
  GroupStack groups_;
};

Hdf5Writer::Hdf5Writer(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {
  const Session session;
  try {
    impl_->open();
  } catch (...) {
    impl_.reset();  // still under the lock
    throw;
  }
}

Hdf5Writer::~Hdf5Writer() {
  const Session session;
  impl_.reset();
}

void Hdf5Writer::field(std::string_view name, double& value) { impl_->scalar(name, value); }
void Hdf5Writer::field(std::string_view name, std::uint64_t& value) { impl_->scalar(name, value); }
void Hdf5Writer::field(std::string_view name, std::vector<double>& value) { impl_->array(name, value); }
void Hdf5Writer::field(std::string_view name, AlignedArray& value) { impl_->array(name, value); }
void Hdf5Writer::field(std::string_view name, std::vector<std::uint64_t>& value) { impl_->array(name, value); }

void Hdf5Writer::field(std::string_view name, std::string& value) {
  const Session session;
  impl_->need_open(name);
  const Handle type = string_type(value.size() + 1);
  impl_->write(name, type.get(), type.get(), H5S_SCALAR, 1, value.c_str());
}

void Hdf5Writer::enter(std::string_view group) {
  const Session session;
  impl_->need_open(group);
  Handle handle(H5Gcreate2(impl_->groups_.current(impl_->file_), std::string(group).c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                H5Gclose);
  if (!handle.valid())
    throw_misuse(
        fmt::format("{}: group {} cannot be made: each name once is allowed", impl_->path_, impl_->groups_.path_of(group)));
  impl_->groups_.push(group, std::move(handle));
}

void Hdf5Writer::leave() {
  const Session session;
  if (impl_->groups_.at_root()) throw_misuse(fmt::format("{}: leave() without enter()", impl_->path_));
  impl_->groups_.pop();
}

void Hdf5Writer::commit() {
  std::size_t size = 0;
  {
    const Session session;
    impl_->need_open("commit");
    if (!impl_->groups_.at_root())
      throw_misuse(fmt::format("{}: commit() inside group {}", impl_->path_, impl_->groups_.path_of("")));
    size = impl_->finish();
  }
  impl_->temporary_.write([&](std::ostream& out) { out.write(impl_->memory_.data(), static_cast<std::streamsize>(size)); });
  impl_->temporary_.commit();
}

struct Hdf5Reader::Impl {
  explicit Impl(const std::filesystem::path& path) : path_(path.string()) {}

  [[noreturn]] void refuse(std::string_view name, std::string_view what_and_allowed) const {
    throw_bad_input(fmt::format("{}: field {} {}", path_, groups_.path_of(name), what_and_allowed));
  }

  void open() {
    std::error_code error;
    const auto status = std::filesystem::status(path_, error);
    if (!std::filesystem::exists(status))
      throw_bad_input(fmt::format("{}: there is no such file: an HDF5 archive is needed", path_));
    if (!std::filesystem::is_regular_file(status))
      throw_bad_input(fmt::format("{}: it is no regular file: an HDF5 archive is needed", path_));
    const Handle access = file_access();
    file_ = Handle(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose);
    if (!file_.valid())
      throw_bad_input(
          fmt::format("{}: it cannot be read as HDF5, or is cut short or damaged: a whole, readable archive is needed", path_));
    check_version();
  }

  void check_version() const {
    const Handle attribute(H5Aopen(file_.get(), version_attribute, H5P_DEFAULT), H5Aclose);
    const Handle type(attribute.valid() ? H5Aget_type(attribute.get()) : -1, H5Tclose);
    const Handle space(attribute.valid() ? H5Aget_space(attribute.get()) : -1, H5Sclose);
    std::uint64_t version = 0;
    if (!type.valid() || H5Tequal(type.get(), H5T_STD_U64LE) <= 0 || H5Sget_simple_extent_type(space.get()) != H5S_SCALAR ||
        H5Aread(attribute.get(), H5T_NATIVE_UINT64, &version) < 0)
      throw_bad_input(fmt::format("{}: it has no root attribute {}: an archive of format {} is needed", path_, version_attribute,
                                  format_version));
    if (version != format_version)
      throw_bad_input(fmt::format("{}: {} is {}: only {} is allowed", path_, version_attribute, version, format_version));
  }

  // An open dataset with what is needed to judge it.
  struct Set {
    Handle set, type, space;
    std::size_t count = 0;
    bool scalar = false;
  };

  Set open_set(std::string_view name) const {
    check_name(name);
    const std::string link(name);
    if (H5Lexists(groups_.current(file_), link.c_str(), H5P_DEFAULT) == 0) refuse(name, "is missing: it is needed");
    Set result;
    result.set = Handle(H5Dopen2(groups_.current(file_), link.c_str(), H5P_DEFAULT), H5Dclose);
    if (!result.set.valid()) refuse(name, "cannot be opened: a whole dataset is needed");
    result.type = Handle(H5Dget_type(result.set.get()), H5Tclose);
    result.space = Handle(H5Dget_space(result.set.get()), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(result.space.get());
    const hssize_t count = H5Sget_simple_extent_npoints(result.space.get());
    if (!result.type.valid() || rank < 0 || rank > 1 || count < 0)
      refuse(name, "has the wrong shape: one value or one row is needed");
    result.scalar = H5Sget_simple_extent_type(result.space.get()) == H5S_SCALAR;
    result.count = static_cast<std::size_t>(count);
    // Memory is asked for what the file really holds, not for what its header claims.
    const hsize_t stored = H5Dget_storage_size(result.set.get());
    if (result.count > stored / std::max<std::size_t>(H5Tget_size(result.type.get()), 1))
      refuse(name, "is incomplete: all of its data are needed");
    return result;
  }

  void read(std::string_view name, const Set& set, hid_t memory, void* data) const {
    if (set.count > 0 && H5Dread(set.set.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
      refuse(name, "cannot be read, it is cut short or damaged: a whole archive is needed");
  }

  template <class Number>
  Set open_numbers(std::string_view name, const Number* tag) const {
    Set set = open_set(name);
    if (H5Tequal(set.type.get(), stored_type(tag)) <= 0)
      refuse(name, fmt::format("has the wrong type: little-endian {} is needed", type_words(tag)));
    return set;
  }

  template <class Number>
  void scalar(std::string_view name, Number& value) const {
    const Session session;
    const Set set = open_numbers(name, &value);
    if (!set.scalar) refuse(name, "is a row: a single value is needed");
    read(name, set, memory_type(&value), &value);
  }

  template <class Array>
  void array(std::string_view name, Array& value) const {
    const Session session;
    const Set set = open_numbers(name, value.data());
    if (set.scalar) refuse(name, "is a single value: a row is needed");
    Array read_values(set.count);
    read(name, set, memory_type(value.data()), read_values.data());
    value = std::move(read_values);
  }

  std::string path_;
  Handle file_;
  GroupStack groups_;
};

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {
  const Session session;
  try {
    impl_->open();
  } catch (...) {
    impl_.reset();  // still under the lock
    throw;
  }
}

Hdf5Reader::~Hdf5Reader() {
  const Session session;
  impl_.reset();
}

void Hdf5Reader::field(std::string_view name, double& value) { impl_->scalar(name, value); }
void Hdf5Reader::field(std::string_view name, std::uint64_t& value) { impl_->scalar(name, value); }
void Hdf5Reader::field(std::string_view name, std::vector<double>& value) { impl_->array(name, value); }
void Hdf5Reader::field(std::string_view name, AlignedArray& value) { impl_->array(name, value); }
void Hdf5Reader::field(std::string_view name, std::vector<std::uint64_t>& value) { impl_->array(name, value); }

void Hdf5Reader::field(std::string_view name, std::string& value) {
  const Session session;
  const Impl::Set set = impl_->open_set(name);
  if (H5Tget_class(set.type.get()) != H5T_STRING || H5Tis_variable_str(set.type.get()) != 0 || set.count != 1)
    impl_->refuse(name, "has the wrong type: one string of fixed length is needed");
  std::string text(H5Tget_size(set.type.get()), '\0');
  impl_->read(name, set, set.type.get(), text.data());
  text.pop_back();  // the terminator
  value = std::move(text);
}

void Hdf5Reader::enter(std::string_view group) {
  const Session session;
  check_name(group);
  const std::string link(group);
  const hid_t parent = impl_->groups_.current(impl_->file_);
  if (H5Lexists(parent, link.c_str(), H5P_DEFAULT) == 0) impl_->refuse(group, "is missing: a group is needed");
  Handle handle(H5Gopen2(parent, link.c_str(), H5P_DEFAULT), H5Gclose);
  if (!handle.valid()) impl_->refuse(group, "cannot be opened: a whole group is needed");
  impl_->groups_.push(group, std::move(handle));
}

void Hdf5Reader::leave() {
  const Session session;
  if (impl_->groups_.at_root()) throw_misuse(fmt::format("{}: leave() without enter()", impl_->path_));
  impl_->groups_.pop();
}

}  // namespace lanescape
