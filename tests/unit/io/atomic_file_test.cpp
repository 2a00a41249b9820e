#include "io/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <stdexcept>
#include <string>

#include "test_files.hpp"

namespace lanescape {
namespace {

using testing::content_of;
using testing::expect_contains;
using testing::FileSizeLimit;
using testing::refusal;
using testing::TemporaryFolder;

void write_new(std::ostream& out) { out << "new"; }

TEST(AtomicFile, NewContentReplacesTheOldAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const auto target = folder.file("state", "old and longer");
  write_atomically(target, write_new);
  EXPECT_EQ(content_of(target), "new");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, OldContentIsSeenUntilTheWriterIsDone) {
  const TemporaryFolder folder;
  const auto target = folder.file("state", "old");
  write_atomically(target, [&](std::ostream& out) {
    out << "new" << std::flush;
    EXPECT_EQ(content_of(target), "old");
    EXPECT_EQ(folder.entries(), 2u);
  });
  EXPECT_EQ(content_of(target), "new");
}

TEST(AtomicFile, AWriterThatThrowsLeavesTheOldContentAndNoTemporary) {
  const TemporaryFolder folder;
  const auto target = folder.file("state", "old");
  const auto fail = [](std::ostream& out) {
    out << "half";
    throw std::runtime_error("stopped");
  };
  EXPECT_THROW(write_atomically(target, fail), std::runtime_error);
  EXPECT_EQ(content_of(target), "old");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, AFullDiskLeavesTheOldContentAndNoTemporary) {
  const TemporaryFolder folder;
  const auto target = folder.file("state", "old");
  std::string message;
  {
    const FileSizeLimit limit(4096);
    message = refusal([&] { write_atomically(target, [](std::ostream& out) { out << std::string(1 << 20, 'x'); }); });
  }
  expect_contains(message, target.string());
  expect_contains(message, "File too large");
  EXPECT_EQ(content_of(target), "old");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, TheOldContentStaysUnderAnotherNameAndNothingElseDoes) {
  const TemporaryFolder folder;
  const auto target = folder.path() / "file", old = folder.path() / "old";
  for (const char* content : {"first", "second", "third"}) {
    TemporaryFile file(target);
    file.write([&](std::ostream& out) { out << content; });
    file.commit(old);
    EXPECT_EQ(content_of(target), content);
  }
  EXPECT_EQ(content_of(old), "second");
  // As a kill leaves them between the two renames.
  std::filesystem::remove(old);
  std::filesystem::create_hard_link(target, old);
  TemporaryFile file(target);
  file.write(write_new);
  file.commit(old);
  EXPECT_EQ(content_of(old), "third");
  EXPECT_EQ(content_of(target), "new");
  EXPECT_EQ(folder.entries(), 2u);
}

TEST(AtomicFile, TheUsualPermissionsApply) {
  const TemporaryFolder folder;
  const mode_t before = ::umask(0027);
  write_atomically(folder.path() / "state", write_new);
  ::umask(before);
  struct stat status{};
  ASSERT_EQ(::stat((folder.path() / "state").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(AtomicFile, ABareFileNameIsWrittenInTheCurrentFolder) {
  const TemporaryFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  write_atomically("state", write_new);
  std::filesystem::current_path(before);
  EXPECT_EQ(content_of(folder.path() / "state"), "new");
}

TEST(AtomicFile, AMissingFolderIsRefusedByName) {
  const TemporaryFolder folder;
  const auto target = folder.path() / "absent" / "state";
  const std::string message = refusal([&] { write_atomically(target, write_new); });
  expect_contains(message, target.string());
  expect_contains(message, "No such file or directory");
}

TEST(AtomicFile, WhatIsNoRegularFileIsNeverReplaced) {
  const TemporaryFolder folder;
  expect_contains(refusal([&] { write_atomically(folder.path(), write_new); }), folder.path().string());
  expect_contains(refusal([&] { write_atomically("/dev/null", write_new); }), "/dev/null");
  expect_contains(refusal([&] { write_atomically("", write_new); }), "''");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, WhatAKilledProcessHasLeftIsRemovedAndNothingElse) {
  const TemporaryFolder folder;
  const auto left = folder.file(".lanescape-1-0.tmp", "half"), other = folder.file("lanescape-1-0.tmp", "mine");
  remove_unfinished_files(folder.path());
  remove_unfinished_files(folder.path() / "missing");
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_EQ(content_of(other), "mine");
}

TEST(OutputFolder, IsCreatedWithItsParentsAndLeftEmpty) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a" / "b" / "";
  prepare_output_folder(path);
  EXPECT_TRUE(std::filesystem::is_empty(path));
  prepare_output_folder(path);
}

TEST(OutputFolder, AFileInItsPlaceIsRefusedByName) {
  const TemporaryFolder folder;
  const auto file = folder.file("taken", "x");
  expect_contains(refusal([&] { prepare_output_folder(file); }), file.string());
  expect_contains(refusal([&] { prepare_output_folder(file / "below"); }), (file / "below").string());
  EXPECT_EQ(content_of(file), "x");
}

TEST(OutputFolder, AnEmptyNameIsRefused) {
  expect_contains(refusal([] { prepare_output_folder(""); }), "''");
}

TEST(OutputFolder, OneWithoutRoomIsRefusedAndLeftClean) {
  const TemporaryFolder folder;
  std::string message;
  {
    const FileSizeLimit limit(0);
    message = refusal([&] { prepare_output_folder(folder.path()); });
  }
  expect_contains(message, folder.path().string());
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(OutputFolder, AReadOnlyOneIsRefusedByName) {
  if (::geteuid() == 0) GTEST_SKIP() << "root writes everywhere";
  const TemporaryFolder folder;
  const auto path = folder.path() / "locked";
  std::filesystem::create_directory(path);
  std::filesystem::permissions(path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const std::string message = refusal([&] { prepare_output_folder(path); });
  expect_contains(message, path.string());
  expect_contains(message, "Permission denied");
}

}  // namespace
}  // namespace lanescape
