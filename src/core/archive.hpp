#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/aligned_array.hpp"

namespace lanescape {

// A state is written to an archive and read from it. Each state has one member `void exchange(Archive&)` that names its fields
// once; the archive knows the direction. Doubles keep every bit.
class Archive {
 public:
  virtual ~Archive() = default;

  virtual bool reading() const = 0;
  virtual void field(std::string_view name, double& value) = 0;
  virtual void field(std::string_view name, std::uint64_t& value) = 0;
  virtual void field(std::string_view name, std::string& value) = 0;
  virtual void field(std::string_view name, std::vector<double>& value) = 0;
  virtual void field(std::string_view name, AlignedArray& value) = 0;
  virtual void field(std::string_view name, std::vector<std::uint64_t>& value) = 0;

  // Fields until the matching leave() belong to a group of that name.
  virtual void enter(std::string_view group) = 0;
  virtual void leave() = 0;
};

// An enumeration as a number.
template <class Enum>
void exchange_enum(Archive& archive, std::string_view name, Enum& value) {
  auto number = static_cast<std::uint64_t>(value);
  archive.field(name, number);
  value = static_cast<Enum>(number);
}

}  // namespace lanescape
