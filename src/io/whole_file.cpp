#include "io/whole_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <system_error>
#include <vector>

namespace lanescape {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers of the trailer are little-endian");

constexpr std::uint32_t trailer_version = 1;
constexpr std::string_view magic = "lanescape check\n";

// What lies in the file, in this order and without gaps. The checksum is over the content and everything before it in the trailer.
struct Trailer {
  char name[16];
  std::uint64_t length;  // of the content [bytes]
  std::uint32_t version;
  std::uint32_t checksum;
};
static_assert(sizeof(Trailer) == 32);
constexpr std::size_t unsummed = sizeof(std::uint32_t);

std::uint32_t summed(std::uint32_t sum, const void* bytes, std::size_t count) {
  return static_cast<std::uint32_t>(crc32_z(sum, static_cast<const Bytef*>(bytes), count));
}

// The checksum of the next `length` bytes and the trailer behind them; nothing if they cannot be read.
std::optional<std::uint32_t> checksum_of(std::istream& in, std::uint64_t length, const Trailer& trailer) {
  std::vector<char> block(std::size_t{1} << 16);
  std::uint32_t sum = 0;
  for (std::uint64_t left = length; left > 0;) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left, block.size()));
    if (!in.read(block.data(), static_cast<std::streamsize>(count))) return std::nullopt;
    sum = summed(sum, block.data(), count);
    left -= count;
  }
  return summed(sum, &trailer, sizeof trailer - unsummed);
}

}  // namespace

std::string trailer_of(std::string_view content) {
  Trailer trailer{{}, content.size(), trailer_version, 0};
  magic.copy(trailer.name, magic.size());
  trailer.checksum = summed(summed(0, content.data(), content.size()), &trailer, sizeof trailer - unsummed);
  std::string bytes(sizeof trailer, '\0');
  std::memcpy(bytes.data(), &trailer, sizeof trailer);
  return bytes;
}

std::optional<std::string> fault_of_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) return "there is no such file";
  if (!std::filesystem::is_regular_file(status)) return "it is no regular file";
  const std::uint64_t size = std::filesystem::file_size(file, error);
  std::ifstream in(file, std::ios::binary);
  if (error || !in) return "it cannot be read";
  Trailer trailer{};
  if (size >= sizeof trailer) {
    in.seekg(static_cast<std::streamoff>(size - sizeof trailer));
    if (!in.read(reinterpret_cast<char*>(&trailer), sizeof trailer)) return "it cannot be read";
  }
  if (std::string_view(trailer.name, sizeof trailer.name) != magic)
    return "it does not end with a checksum: it is cut short, or was not written by this version";
  if (trailer.version != trailer_version)
    return fmt::format("its trailer is of version {}: {} is needed", trailer.version, trailer_version);
  in.seekg(0);
  if (trailer.length != size - sizeof trailer || checksum_of(in, trailer.length, trailer) != trailer.checksum)
    return "it is damaged: its checksum does not match";
  return std::nullopt;
}

}  // namespace lanescape
