#include "core/byte_archive.hpp"

#include <fmt/format.h>

#include <cstring>

#include "core/error.hpp"

namespace lanescape {

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
