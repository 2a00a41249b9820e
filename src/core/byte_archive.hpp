#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/archive.hpp"

namespace lanescape {

// A state as bytes in memory, for hosts that keep it in files of their own. Fields lie one after the other with their names, in
// this machine's byte order, and a checksum at the end.
class ByteWriter final : public Archive {
 public:
  bool reading() const override { return false; }
  void field(std::string_view name, double& value) override { put(name, &value, 1); }
  void field(std::string_view name, std::uint64_t& value) override { put(name, &value, 1); }
  void field(std::string_view name, std::string& value) override { put(name, value.data(), value.size()); }
  void field(std::string_view name, std::vector<double>& value) override { put(name, value.data(), value.size()); }
  void field(std::string_view name, AlignedArray& value) override { put(name, value.data(), value.size()); }
  void field(std::string_view name, std::vector<std::uint64_t>& value) override { put(name, value.data(), value.size()); }
  void enter(std::string_view) override {}
  void leave() override {}

  std::string bytes() const;

 private:
  template <class T>
  void put(std::string_view name, const T* values, std::size_t count) {
    put_text(name);
    const std::uint64_t size = count * sizeof(T);
    bytes_.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes_.append(reinterpret_cast<const char*>(values), size);
  }
  void put_text(std::string_view text) {
    bytes_.push_back(static_cast<char>(text.size()));
    bytes_.append(text);
  }

  std::string bytes_;
};

// Throws Error(bad_input) for bytes that are no state of what reads them, before anything is read if they were changed. Arrays keep
// their sizes: an object reads the state of one like itself.
class ByteReader final : public Archive {
 public:
  explicit ByteReader(std::string_view bytes);

  bool reading() const override { return true; }
  void field(std::string_view name, double& value) override { get_number(name, value); }
  void field(std::string_view name, std::uint64_t& value) override { get_number(name, value); }
  void field(std::string_view name, std::string& value) override { value = std::string(get(name)); }
  void field(std::string_view name, std::vector<double>& value) override { get_array(name, value); }
  void field(std::string_view name, AlignedArray& value) override { get_array(name, value); }
  void field(std::string_view name, std::vector<std::uint64_t>& value) override { get_array(name, value); }
  void enter(std::string_view) override {}
  void leave() override {}

 private:
  std::string_view take(std::size_t count, std::string_view name);
  std::string_view get(std::string_view name);
  template <class T>
  void get_number(std::string_view name, T& value) {
    copy(name, get(name), &value, sizeof value);
  }
  template <class Array>
  void get_array(std::string_view name, Array& values) {
    copy(name, get(name), values.data(), values.size() * sizeof values[0]);
  }
  static void copy(std::string_view name, std::string_view bytes, void* to, std::size_t size);

  std::string_view rest_;
};

}  // namespace lanescape
