#include "core/byte_archive.hpp"

#include <fmt/format.h>

#include <cstring>

#include "core/error.hpp"

namespace lanescape {
namespace {

// FNV-1a, 64 bits.
std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t sum = 0xcbf29ce484222325;
  for (const char byte : bytes) sum = (sum ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  return sum;
}

}  // namespace

std::string ByteWriter::bytes() const {
  const std::uint64_t sum = checksum(bytes_);
  return bytes_ + std::string(reinterpret_cast<const char*>(&sum), sizeof sum);
}

ByteReader::ByteReader(std::string_view bytes) {
  std::uint64_t sum = 0;
  if (bytes.size() >= sizeof sum) {
    rest_ = bytes.substr(0, bytes.size() - sizeof sum);
    std::memcpy(&sum, bytes.data() + rest_.size(), sizeof sum);
  }
  if (bytes.size() < sizeof sum || sum != checksum(rest_))
    throw_bad_input("state: its bytes were cut or changed: those that were saved are needed");
}

std::string_view ByteReader::take(std::size_t count, std::string_view name) {
  if (rest_.size() < count)
    throw_bad_input(fmt::format("state: it ends before '{}': the whole state of an object is needed", name));
  const std::string_view taken = rest_.substr(0, count);
  rest_.remove_prefix(count);
  return taken;
}

std::string_view ByteReader::get(std::string_view name) {
  const auto length = static_cast<unsigned char>(take(1, name).front());
  if (const std::string_view found = take(length, name); found != name)
    throw_bad_input(fmt::format("state: '{}' was expected: it belongs to an object of another kind", name));
  std::uint64_t size = 0;
  std::memcpy(&size, take(sizeof size, name).data(), sizeof size);
  return take(size, name);
}

void ByteReader::copy(std::string_view name, std::string_view bytes, void* to, std::size_t size) {
  if (bytes.size() != size)
    throw_bad_input(fmt::format("state: '{}' has another size: it belongs to an object of another kind", name));
  if (size != 0) std::memcpy(to, bytes.data(), size);
}

}  // namespace lanescape
