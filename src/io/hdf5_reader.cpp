#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "io/hdf5_archive.hpp"
#include "io/hdf5_handles.hpp"
#include "io/whole_file.hpp"

namespace lanescape {

using namespace hdf5;

struct Hdf5Reader::Impl {
  explicit Impl(const std::filesystem::path& path) : path_(path.string()) {}

  [[noreturn]] void refuse(std::string_view name, std::string_view what_and_allowed) const {
    throw_bad_input(fmt::format("{}: field {} {}", path_, groups_.path_of(name), what_and_allowed));
  }

  void open() {
    if (const auto fault = fault_of_file(path_)) throw_bad_input(fmt::format("{}: {}: a whole archive is needed", path_, *fault));
    const Handle access = file_access();
    file_ = Handle(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose);
    if (!file_.valid()) throw_bad_input(fmt::format("{}: it is whole, but cannot be read as HDF5: an archive is needed", path_));
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

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) : impl_(opened<Impl>(path)) {}

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
