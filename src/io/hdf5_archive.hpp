#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/archive.hpp"

namespace lanescape {

// A state as an HDF5 file: groups are HDF5 groups, fields are datasets of little-endian 64-bit numbers or fixed-length
// strings, and every byte is covered by a checksum. A trailer (io/whole_file.hpp) shows that a file is whole before the library
// parses it. The library is not thread-safe; all archives share one lock.

// Nothing is seen under the path until commit(). The file is built in memory: a full disk is then met by our own write, where
// it can be reported, and not inside the library, which can neither close nor forget a file that it failed to write.
// The constructor throws Error(bad_input) where no file can be made; misuse (a field twice, an unmatched group, use after
// commit) throws Error(internal).
class Hdf5Writer final : public Archive {
 public:
  explicit Hdf5Writer(const std::filesystem::path& path);
  ~Hdf5Writer() override;

  bool reading() const override { return false; }
  void field(std::string_view name, double& value) override;
  void field(std::string_view name, std::uint64_t& value) override;
  void field(std::string_view name, std::string& value) override;
  void field(std::string_view name, std::vector<double>& value) override;
  void field(std::string_view name, AlignedArray& value) override;
  void field(std::string_view name, std::vector<std::uint64_t>& value) override;
  void enter(std::string_view group) override;
  void leave() override;

  // Writes, syncs and renames; the old file, if any, is replaced in one step, and keeps the other name if one is given. Ends the
  // archive.
  void commit(const std::filesystem::path& old_as = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// A field that is missing, of another type or shape, cut short or damaged throws Error(bad_input) naming file and field.
class Hdf5Reader final : public Archive {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path);
  ~Hdf5Reader() override;

  bool reading() const override { return true; }
  void field(std::string_view name, double& value) override;
  void field(std::string_view name, std::uint64_t& value) override;
  void field(std::string_view name, std::string& value) override;
  void field(std::string_view name, std::vector<double>& value) override;
  void field(std::string_view name, AlignedArray& value) override;
  void field(std::string_view name, std::vector<std::uint64_t>& value) override;
  void enter(std::string_view group) override;
  void leave() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lanescape
