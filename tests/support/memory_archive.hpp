#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/archive.hpp"

namespace lanescape::testing {

// Keeps fields in memory. Throws if a name is written twice, or is read but was not written with that type.
class MemoryArchive final : public Archive {
 public:
  // Switches to reading, from the outermost group.
  void rewind() {
    reading_ = true;
    groups_.clear();
  }
  bool reading() const override { return reading_; }
  void field(std::string_view name, double& value) override { keep(name, value); }
  void field(std::string_view name, std::uint64_t& value) override { keep(name, value); }
  void field(std::string_view name, std::string& value) override { keep(name, value); }
  void field(std::string_view name, std::vector<double>& value) override { keep(name, value); }
  void field(std::string_view name, AlignedArray& value) override { keep(name, value); }
  void field(std::string_view name, std::vector<std::uint64_t>& value) override { keep(name, value); }
  void enter(std::string_view group) override { groups_.emplace_back(group); }
  void leave() override { groups_.pop_back(); }

 private:
  template <class Value>
  void keep(std::string_view name, Value& value) {
    std::string path;
    for (const std::string& group : groups_) path += group + '/';
    path += name;
    if (reading_)
      value = std::get<Value>(fields_.at(path));
    else if (!fields_.emplace(path, value).second)
      throw std::logic_error(path + " is written twice");
  }

  using Field = std::variant<double, std::uint64_t, std::string, std::vector<double>, AlignedArray, std::vector<std::uint64_t>>;
  bool reading_ = false;
  std::vector<std::string> groups_;
  std::map<std::string, Field> fields_;
};

// Copies the state of one object to another through an archive.
template <class From, class To>
void hand_on(From& from, To& to) {
  MemoryArchive archive;
  from.exchange(archive);
  archive.rewind();
  to.exchange(archive);
}

}  // namespace lanescape::testing
