#include "io/hdf5_handles.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace lanescape::hdf5 {

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

void throw_misuse(const std::string& message) { throw Error(ErrorCode::internal, message); }

void check_name(std::string_view name) {
  if (name.empty() || name == "." || name.find('/') != std::string_view::npos || name.find('\0') != std::string_view::npos)
    throw_misuse(fmt::format("archive name '{}' is not allowed: it must be a plain word", name));
}

}  // namespace lanescape::hdf5
