#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "archived_state.hpp"
#include "core/byte_archive.hpp"
#include "io/hdf5_archive.hpp"
#include "io/whole_file.hpp"
#include "run/path_file.hpp"
#include "targets.hpp"

// Archives. Behind a checksum that was made for the bytes HDF5 sees them, as it would see a file that someone has made to do harm.
namespace lanescape::fuzz {
namespace {

constexpr std::size_t trailer_bytes = 32;

using testing::ArchivedState;

// Long enough that one array lies in chunks.
ArchivedState some_state() {
  return {.time = 1.5,
          .step = 7,
          .name = "kob-andersen",
          .positions = std::vector<double>(1100, 0.25),
          .velocities = {},
          .order = {2, 0, 1}};
}

std::string whole_archive() {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("lanescape-fuzz-" + std::to_string(::getpid()) + ".h5");
  ArchivedState state = some_state();
  Hdf5Writer writer(path);
  state.exchange(writer);
  writer.commit();
  std::ifstream in(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  std::filesystem::remove(path);
  return bytes;
}

std::string without_trailer(const std::string& bytes) { return bytes.substr(0, bytes.size() - trailer_bytes); }

void read_state(std::string_view bytes) {
  const MemoryFile file(bytes);
  ArchivedState state;
  Hdf5Reader reader(file.path());
  state.exchange(reader);
}

void read_path(std::string_view bytes) {
  const MemoryFile file(bytes);
  read_path_file(file.path());
}

void read_bytes(std::string_view bytes) {
  ArchivedState state;
  ByteReader reader(bytes);
  state.exchange(reader);
}

void behind_checksum(void (*reader)(std::string_view), std::string_view bytes) {
  refusing(reader, std::string(bytes) + trailer_of(bytes));
}

// As ByteWriter ends its bytes: FNV-1a.
std::string with_host_checksum(std::string_view bytes) {
  std::uint64_t sum = 0xcbf29ce484222325;
  for (const char byte : bytes) sum = (sum ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  return std::string(bytes) + std::string(reinterpret_cast<const char*>(&sum), sizeof sum);
}

}  // namespace

void read_archive_as_it_is(std::string_view bytes) { refusing(read_state, bytes); }
void read_archive_behind_checksum(std::string_view bytes) { behind_checksum(read_state, bytes); }
void read_path_behind_checksum(std::string_view bytes) { behind_checksum(read_path, bytes); }
void read_host_state(std::string_view bytes) {
  refusing(read_bytes, bytes);
  refusing(read_bytes, with_host_checksum(bytes));
}

std::vector<std::string> archive_seeds() { return {whole_archive()}; }
std::vector<std::string> bare_archive_seeds() { return {without_trailer(whole_archive())}; }

std::vector<std::string> path_seeds() {
  std::vector<std::string> seeds;
  for (const std::string& bytes : files_in("tests/data", ".h5", 100'000)) seeds.push_back(without_trailer(bytes));
  return seeds;
}

std::vector<std::string> host_state_seeds() {
  ArchivedState state = some_state();
  ByteWriter writer;
  state.exchange(writer);
  const std::string bytes = writer.bytes();
  return {bytes, bytes.substr(0, bytes.size() - sizeof(std::uint64_t))};
}

}  // namespace lanescape::fuzz
