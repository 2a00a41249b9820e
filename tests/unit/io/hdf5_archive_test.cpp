#include "io/hdf5_archive.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "archived_state.hpp"
#include "io/whole_file.hpp"
#include "test_files.hpp"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define LANESCAPE_LEAKS_ARE_CHECKED
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define LANESCAPE_LEAKS_ARE_CHECKED
#endif
#ifdef LANESCAPE_LEAKS_ARE_CHECKED
// HDF5 1.10 leaks memory when the checksum of an object header fails, as it does in the tests of damaged files.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }
#endif

namespace lanescape {
namespace {

using testing::content_of;
using testing::expect_contains;
using testing::FileSizeLimit;
using testing::refusal;
using testing::TemporaryFolder;

// Compared bit by bit.
struct State : testing::ArchivedState {
  friend bool operator==(const State& a, const State& b) {
    const auto same = [](const auto& x, const auto& y) {
      return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                        [](double p, double q) { return std::bit_cast<std::uint64_t>(p) == std::bit_cast<std::uint64_t>(q); });
    };
    return std::bit_cast<std::uint64_t>(a.time) == std::bit_cast<std::uint64_t>(b.time) && a.step == b.step && a.name == b.name &&
           same(a.positions, b.positions) && same(a.velocities, b.velocities) && a.order == b.order;
  }
};

// `count` numbers over the whole range of doubles.
State awkward_state(std::size_t count) {
  State state;
  state.time = std::bit_cast<double>(std::uint64_t{0xfff8dead0000beef});  // a quiet NaN with sign and payload
  state.step = std::numeric_limits<std::uint64_t>::max();
  state.name = std::string("kob-andersen \0 \xc3\xa9", 16);
  std::uint64_t bits = 0x9e3779b97f4a7c15;
  for (std::size_t i = 0; i < count; ++i) {
    bits = bits * 6364136223846793005u + 1442695040888963407u;
    state.positions.push_back(std::bit_cast<double>(bits));
    state.velocities.push_back(std::bit_cast<double>(~bits));
    state.order.push_back(bits);
  }
  if (count >= 4) {
    state.positions[0] = std::bit_cast<double>(std::uint64_t{0x7ff0000000000001});  // a signalling NaN
    state.positions[1] = -0.0;
    state.positions[2] = std::numeric_limits<double>::denorm_min();
    state.positions[3] = -std::numeric_limits<double>::infinity();
  }
  return state;
}

void write(State state, const std::filesystem::path& path) {
  Hdf5Writer writer(path);
  state.exchange(writer);
  writer.commit();
}

// Ends a file that another program has changed with its checksum, so that HDF5 gets to see it.
std::filesystem::path with_trailer(const std::filesystem::path& path) {
  std::string content = content_of(path);
  content += trailer_of(content);
  std::filesystem::remove(path);
  std::ofstream(path, std::ios::binary) << content;
  return path;
}

State read(const std::filesystem::path& path) {
  Hdf5Reader reader(path);
  State state;
  state.exchange(reader);
  return state;
}

// Small arrays are stored in the object header, large ones in one or several chunks.
TEST(Hdf5Archive, EveryBitComesBackAtEverySize) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "state.h5";
  for (const std::size_t count : {0u, 1u, 7u, 1024u, 1025u, 65536u, 65537u, 200001u}) {
    const State state = awkward_state(count);
    write(state, path);
    EXPECT_TRUE(read(path) == state) << count;
  }
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(Hdf5Archive, TextsOfEveryLengthComeBack) {
  const TemporaryFolder folder;
  for (const std::size_t size : {0u, 1u, 8191u, 8192u, 100000u}) {
    State state;
    state.name.assign(size, 'x');
    write(state, folder.path() / "state.h5");
    EXPECT_EQ(read(folder.path() / "state.h5").name, state.name);
  }
}

TEST(Hdf5Archive, TheSameStateGivesTheSameFile) {
  const TemporaryFolder folder;
  write(awkward_state(3000), folder.path() / "a.h5");
  write(awkward_state(3000), folder.path() / "b.h5");
  EXPECT_EQ(content_of(folder.path() / "a.h5"), content_of(folder.path() / "b.h5"));
}

TEST(Hdf5Archive, OldFieldsAreReplacedByWhatIsRead) {
  const TemporaryFolder folder;
  write(awkward_state(2), folder.path() / "state.h5");
  Hdf5Reader reader(folder.path() / "state.h5");
  State state = awkward_state(50);
  state.exchange(reader);
  EXPECT_TRUE(state == awkward_state(2));
}

TEST(Hdf5Archive, NothingIsSeenBeforeCommit) {
  const TemporaryFolder folder;
  const auto path = folder.file("state.h5", "old");
  State state = awkward_state(10);
  {
    Hdf5Writer writer(path);
    state.exchange(writer);
    EXPECT_EQ(content_of(path), "old");
  }
  EXPECT_EQ(content_of(path), "old");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(Hdf5Archive, TheOldFileKeepsTheOtherNameOfACommit) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "state.h5", old = folder.path() / "state.h5.previous";
  for (const std::size_t count : {1u, 2u, 3u}) {
    State state = awkward_state(count);
    Hdf5Writer writer(path);
    state.exchange(writer);
    writer.commit(old);
    EXPECT_TRUE(read(path) == state);
    EXPECT_EQ(std::filesystem::exists(old), count > 1);
  }
  EXPECT_TRUE(read(old) == awkward_state(2));
  EXPECT_EQ(folder.entries(), 2u);
}

TEST(Hdf5Archive, DirectionsAreTold) {
  const TemporaryFolder folder;
  write(State{}, folder.path() / "state.h5");
  EXPECT_TRUE(Hdf5Reader(folder.path() / "state.h5").reading());
  EXPECT_FALSE(Hdf5Writer(folder.path() / "state.h5").reading());
}

TEST(Hdf5Archive, ThreadsMayWriteAndReadTheirOwnArchives) {
  const TemporaryFolder folder;
  std::vector<std::thread> threads;
  std::vector<int> intact(4, 0);
  for (std::size_t t = 0; t < intact.size(); ++t)
    threads.emplace_back([&, t] {
      const auto path = folder.path() / std::to_string(t);
      for (int i = 0; i < 20; ++i) {
        write(awkward_state(100 + t), path);
        intact[t] += read(path) == awkward_state(100 + t);
      }
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(intact, std::vector<int>(4, 20));
}

TEST(Hdf5Archive, ThePrinterOfTheLibraryIsPutBack) {
  const TemporaryFolder folder;
  H5E_auto2_t before = nullptr, after = nullptr;
  void* data = nullptr;
  H5Eget_auto2(H5E_DEFAULT, &before, &data);
  write(State{}, folder.path() / "state.h5");
  H5Eget_auto2(H5E_DEFAULT, &after, &data);
  EXPECT_EQ(before, after);
  EXPECT_NE(after, nullptr);
}

TEST(Hdf5ArchiveRefusal, AMissingFieldIsNamedWithItsGroups) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "state.h5";
  write(State{}, path);
  Hdf5Reader reader(path);
  double value = 0.0;
  expect_contains(refusal([&] { reader.field("mass", value); }), path.string() + ": field /mass is missing");
  reader.enter("dynamics");
  expect_contains(refusal([&] { reader.field("mass", value); }), path.string() + ": field /dynamics/mass is missing");
  expect_contains(refusal([&] { reader.enter("absent"); }), path.string() + ": field /dynamics/absent is missing");
}

TEST(Hdf5ArchiveRefusal, AFieldOfAnotherTypeOrShapeIsNamed) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "state.h5";
  write(awkward_state(5), path);
  Hdf5Reader reader(path);
  double real = 0.0;
  std::uint64_t integer = 0;
  std::string text;
  std::vector<double> reals;
  AlignedArray aligned;
  std::vector<std::uint64_t> integers;
  const std::string place = path.string() + ": field /";
  expect_contains(refusal([&] { reader.field("time", integer); }), place + "time has the wrong type");
  expect_contains(refusal([&] { reader.field("time", text); }), place + "time has the wrong type");
  expect_contains(refusal([&] { reader.field("time", reals); }), place + "time is a single value");
  expect_contains(refusal([&] { reader.field("time", aligned); }), place + "time is a single value");
  expect_contains(refusal([&] { reader.field("name", real); }), place + "name has the wrong type");
  expect_contains(refusal([&] { reader.field("dynamics", real); }), place + "dynamics cannot be opened");
  expect_contains(refusal([&] { reader.enter("time"); }), place + "time cannot be opened");
  reader.enter("dynamics");
  expect_contains(refusal([&] { reader.field("order", reals); }), place + "dynamics/order has the wrong type");
  expect_contains(refusal([&] { reader.field("order", integer); }), place + "dynamics/order is a row");
  reader.enter("particles");
  expect_contains(refusal([&] { reader.field("positions", integers); }), place + "dynamics/particles/positions has the wrong type");
}

TEST(Hdf5ArchiveRefusal, ATableIsNoRow) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "state.h5";
  write(State{}, path);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hsize_t extents[2] = {2, 3};
  const hid_t space = H5Screate_simple(2, extents, nullptr);
  H5Dclose(H5Dcreate2(file, "table", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  H5Sclose(space);
  H5Fclose(file);
  Hdf5Reader reader(with_trailer(path));
  std::vector<double> values;
  expect_contains(refusal([&] { reader.field("table", values); }), path.string() + ": field /table has the wrong shape");
}

// A header may claim more data than the file holds, or than fits in memory.
TEST(Hdf5ArchiveRefusal, AFieldWithoutItsDataIsNamed) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "state.h5";
  write(State{}, path);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hsize_t extent = hsize_t{1} << 50, chunk = 1024;
  const hid_t space = H5Screate_simple(1, &extent, nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(creation, 1, &chunk);
  H5Dclose(H5Dcreate2(file, "hollow", H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT));
  H5Pclose(creation);
  H5Sclose(space);
  H5Fclose(file);
  Hdf5Reader reader(with_trailer(path));
  std::vector<double> values;
  expect_contains(refusal([&] { reader.field("hollow", values); }), path.string() + ": field /hollow is incomplete");
}

TEST(Hdf5ArchiveRefusal, AMissingFileAFolderAndAnotherFormatAreNamed) {
  const TemporaryFolder folder;
  const auto absent = folder.path() / "absent.h5";
  const auto text = folder.file("text.h5", "not HDF5 at all");
  const auto empty = folder.file("empty.h5", "");
  expect_contains(refusal([&] { Hdf5Reader reader(absent); }), absent.string() + ": there is no such file");
  expect_contains(refusal([&] { Hdf5Reader reader(folder.path()); }), folder.path().string() + ": it is no regular file");
  expect_contains(refusal([&] { Hdf5Reader reader(text); }), text.string() + ": it does not end with a checksum");
  expect_contains(refusal([&] { Hdf5Reader reader(empty); }), empty.string() + ": it does not end with a checksum");
  expect_contains(refusal([&] { Hdf5Reader reader(with_trailer(text)); }),
                  text.string() + ": it is whole, but cannot be read as HDF5");
}

TEST(Hdf5ArchiveRefusal, AFileWithoutVersionOrWithAnotherIsNamed) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "state.h5";
  H5Fclose(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  expect_contains(refusal([&] { Hdf5Reader reader(with_trailer(path)); }),
                  path.string() + ": it has no root attribute format_version");
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t attribute = H5Acreate2(file, "format_version", H5T_STD_U64LE, space, H5P_DEFAULT, H5P_DEFAULT);
  const std::uint64_t version = 2;
  H5Awrite(attribute, H5T_NATIVE_UINT64, &version);
  H5Aclose(attribute);
  H5Sclose(space);
  H5Fclose(file);
  expect_contains(refusal([&] { Hdf5Reader reader(with_trailer(path)); }),
                  path.string() + ": format_version is 2: only 1 is allowed");
}

TEST(Hdf5ArchiveRefusal, AFileCutShortAnywhereIsNamed) {
  const TemporaryFolder folder;
  write(awkward_state(1100), folder.path() / "whole.h5");
  const std::string whole = content_of(folder.path() / "whole.h5");
  for (std::size_t length = 0; length < whole.size(); length += length < 4096 ? 1 : 61) {
    const auto path = folder.file("cut.h5", whole.substr(0, length));
    expect_contains(refusal([&] { read(path); }), path.string());
  }
}

// Random bytes from every region of the file, and several at a time.
TEST(Hdf5ArchiveRefusal, AFileChangedAnywhereIsRefused) {
  const TemporaryFolder folder;
  write(awkward_state(1100), folder.path() / "whole.h5");
  const std::string whole = content_of(folder.path() / "whole.h5");
  std::mt19937_64 random(7);
  for (int change = 0; change < 1000; ++change) {
    std::string damaged = whole;
    for (std::uint64_t k = 0; k <= random() % 4; ++k) damaged[random() % whole.size()] ^= static_cast<char>(1 + random() % 255);
    if (damaged == whole) continue;
    const auto path = folder.file("damaged.h5", damaged);
    expect_contains(refusal([&] { read(path); }), path.string() + ": it");
  }
}

// Under a checksum that was made after the damage HDF5 sees it. A change of unused bytes may stay unnoticed, but a read must never
// return other values.
TEST(Hdf5ArchiveRefusal, DamageUnderAValidTrailerNeverGivesOtherValues) {
  const TemporaryFolder folder;
  const State state = awkward_state(1100);
  write(state, folder.path() / "whole.h5");
  const std::string whole = content_of(folder.path() / "whole.h5");
  std::size_t refused = 0, tried = 0;
  for (std::size_t at = 0; at < whole.size(); at += at < 4096 ? 1 : 37) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
    const auto path = with_trailer(folder.file("damaged.h5", damaged));
    ++tried;
    try {
      EXPECT_TRUE(read(path) == state) << "byte " << at;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::bad_input);
      expect_contains(error.what(), path.string());
      ++refused;
    }
  }
  EXPECT_GT(refused, tried / 2);
}

// The program prints exactly one line on stderr; the library must print nothing more at exit.
TEST(Hdf5ArchiveRefusalDeathTest, ADamagedHeaderLeavesTheExitSilent) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto read_damaged = [] {
    const TemporaryFolder folder;
    write(awkward_state(10), folder.path() / "whole.h5");
    std::string content = content_of(folder.path() / "whole.h5");
    content[64] = static_cast<char>(content[64] ^ 1);
    const auto path = with_trailer(folder.file("damaged.h5", content));
    expect_contains(refusal([&] { read(path); }), path.string());
  };
  EXPECT_EXIT((read_damaged(), std::exit(0)), ::testing::ExitedWithCode(0), "^$");
}

TEST(Hdf5ArchiveRefusal, DamagedDataAreNamedByTheirField) {
  const TemporaryFolder folder;
  State state;
  state.positions.assign(5000, 1.2345678901234567);
  const auto path = folder.path() / "state.h5";
  write(state, path);
  std::string content = content_of(path);
  const double value = state.positions[0];
  const std::string pattern(reinterpret_cast<const char*>(&value), sizeof value);
  const std::size_t at = content.find(pattern + pattern);
  ASSERT_NE(at, std::string::npos);
  content[at + 100] = static_cast<char>(content[at + 100] ^ 1);
  with_trailer(folder.file("state.h5", content));
  expect_contains(refusal([&] { read(path); }), path.string() + ": field /dynamics/particles/positions cannot be read");
}

TEST(Hdf5ArchiveRefusal, APlaceThatCannotBeWrittenIsNamed) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "absent" / "state.h5";
  expect_contains(refusal([&] { Hdf5Writer writer(path); }), path.string());
}

TEST(Hdf5ArchiveRefusal, AFullDiskIsReportedAndLeavesTheOldFile) {
  const TemporaryFolder folder;
  const auto path = folder.file("state.h5", "old");
  {
    const FileSizeLimit limit(4096);
    expect_contains(refusal([&] { write(awkward_state(5000), path); }), path.string());
  }
  EXPECT_EQ(content_of(path), "old");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(Hdf5ArchiveMisuse, IsAnInternalError) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "state.h5";
  Hdf5Writer writer(path);
  double value = 1.0;
  writer.field("time", value);
  const auto misuse = [](auto action) { return refusal(action, ErrorCode::internal); };
  expect_contains(misuse([&] { writer.field("time", value); }), "field /time");
  expect_contains(misuse([&] { writer.field("a/b", value); }), "'a/b'");
  expect_contains(misuse([&] { writer.field("", value); }), "''");
  expect_contains(misuse([&] { writer.leave(); }), path.string());
  writer.enter("group");
  expect_contains(misuse([&] { writer.commit(); }), "/group");
  writer.leave();
  expect_contains(misuse([&] { writer.enter("group"); }), "group /group");
  writer.commit();
  expect_contains(misuse([&] { writer.field("late", value); }), "after commit()");
  expect_contains(misuse([&] { writer.commit(); }), "after commit()");
  Hdf5Reader reader(path);
  expect_contains(misuse([&] { reader.leave(); }), path.string());
}

}  // namespace
}  // namespace lanescape
