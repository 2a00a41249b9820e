#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "io/atomic_file.hpp"
#include "io/hdf5_archive.hpp"
#include "io/hdf5_handles.hpp"
#include "io/whole_file.hpp"

namespace lanescape {

using namespace hdf5;

namespace {

// Up to here data live in the object header, which carries a checksum; beyond, in chunks with a Fletcher sum. [bytes]
constexpr std::size_t largest_compact = 8192;
constexpr std::size_t chunk_bytes = std::size_t{1} << 19;

}  // namespace

namespace hdf5 {

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

}  // namespace hdf5

namespace {

// How an object is made: the same state makes the same file.
Handle without_times(hid_t kind) {
  Handle creation(H5Pcreate(kind), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  return creation;
}

}  // namespace

struct Hdf5Writer::Impl {
  explicit Impl(const std::filesystem::path& path) : path_(path.string()), temporary_(path) {}

  void open() {
    const Handle access = file_access();
    memory_.lend(access.get());
    file_ =
        Handle(H5Fcreate(temporary_.path().c_str(), H5F_ACC_TRUNC, without_times(H5P_FILE_CREATE).get(), access.get()), H5Fclose);
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
    const Handle creation = without_times(H5P_DATASET_CREATE);
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

Hdf5Writer::Hdf5Writer(const std::filesystem::path& path) : impl_(opened<Impl>(path)) {}

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
  Handle handle(H5Gcreate2(impl_->groups_.current(impl_->file_), std::string(group).c_str(), H5P_DEFAULT,
                           without_times(H5P_GROUP_CREATE).get(), H5P_DEFAULT),
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

void Hdf5Writer::commit(const std::filesystem::path& old_as) {
  std::size_t size = 0;
  {
    const Session session;
    impl_->need_open("commit");
    if (!impl_->groups_.at_root())
      throw_misuse(fmt::format("{}: commit() inside group {}", impl_->path_, impl_->groups_.path_of("")));
    size = impl_->finish();
  }
  const std::string_view content(impl_->memory_.data(), size);
  impl_->temporary_.write([&](std::ostream& out) { out << content << trailer_of(content); });
  impl_->temporary_.commit(old_as);
}

}  // namespace lanescape
