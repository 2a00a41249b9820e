#include "io/whole_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>

#include "test_files.hpp"

namespace lanescape {
namespace {

using testing::expect_contains;
using testing::TemporaryFolder;

std::string content_of_length(std::size_t length) {
  std::string content(length, '\0');
  std::mt19937 random(static_cast<unsigned>(length));
  for (char& byte : content) byte = static_cast<char>(random());
  return content;
}

class WholeFile : public ::testing::Test {
 protected:
  std::string fault(const std::string& bytes) const { return fault_of_file(folder_.file("file", bytes)).value_or(""); }

  const TemporaryFolder folder_;
};

TEST_F(WholeFile, OfAnyLengthIsWhole) {
  for (const std::size_t length : {0u, 1u, 31u, 32u, 33u, 4096u, (1u << 20) - 1u, 1u << 20, (1u << 20) + 1u, 5u << 20}) {
    const std::string content = content_of_length(length), trailer = trailer_of(content);
    EXPECT_EQ(trailer.size(), 32u);
    EXPECT_EQ(fault(content + trailer), "") << length;
  }
}

// docs/FORMATS.md promises these bytes to other programs. The CRC-32 is that of Python's zlib.
TEST_F(WholeFile, EndsWithTheDocumentedBytes) {
  const std::string trailer = trailer_of("abc");
  EXPECT_EQ(trailer.substr(0, 28), std::string("lanescape check\n\3\0\0\0\0\0\0\0\1\0\0\0", 28));
  EXPECT_EQ(trailer.substr(28), std::string("$E\xb8\xd0", 4));
}

TEST_F(WholeFile, WithAnyBitChangedIsNotWhole) {
  const std::string content = content_of_length(300), whole = content + trailer_of(content);
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string changed = whole;
    changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << bit % 8));
    EXPECT_NE(fault(changed), "") << bit;
  }
}

TEST_F(WholeFile, WithBytesExchangedSetToZeroOrOverwrittenIsNotWhole) {
  const std::string content = content_of_length(5000), whole = content + trailer_of(content);
  std::mt19937_64 random(3);
  for (int change = 0; change < 3000; ++change) {
    std::string changed = whole;
    const std::size_t at = random() % whole.size(), length = 1 + random() % (whole.size() - at),
                      from = random() % (whole.size() - length + 1);
    switch (change % 3) {
      case 0:
        changed.replace(at, length, length, '\0');
        break;
      case 1:
        changed.replace(at, length, whole, from, length);
        break;
      default:
        for (std::size_t k = at; k < at + length; ++k) changed[k] = static_cast<char>(random());
    }
    if (changed == whole) continue;
    EXPECT_NE(fault(changed), "") << change;
  }
}

TEST_F(WholeFile, CutShortOrContinuedAnywhereIsNotWhole) {
  const std::string content = content_of_length(700), whole = content + trailer_of(content);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_NE(fault(whole.substr(0, length)), "") << length;
    EXPECT_NE(fault(whole.substr(whole.size() - length)), "") << length;
    EXPECT_NE(fault(whole + whole.substr(0, length + 1)), "") << length;
  }
}

TEST_F(WholeFile, IsMissedByName) {
  expect_contains(fault("text"), "does not end with a checksum");
  expect_contains(*fault_of_file(folder_.path() / "absent"), "there is no such file");
  expect_contains(*fault_of_file(folder_.path()), "it is no regular file");
  std::string younger = trailer_of("");
  younger[24] = 2;
  expect_contains(fault(younger), "version 2: 1 is needed");
}

}  // namespace
}  // namespace lanescape
