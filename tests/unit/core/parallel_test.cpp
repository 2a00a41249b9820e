#include "core/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace lanescape {
namespace {

TEST(ForEachPart, CallsEveryPartOnce) {
  for (const int parts : {1, 2, 3, 7}) {
    std::vector<std::atomic<int>> calls(static_cast<std::size_t>(parts));
    for_each_part(parts, [&](int part) { ++calls.at(static_cast<std::size_t>(part)); });
    for (const auto& count : calls) EXPECT_EQ(count, 1);
  }
}

TEST(ForEachPart, ASinglePartStaysOnTheCallersThread) {
  std::thread::id where;
  for_each_part(1, [&](int) { where = std::this_thread::get_id(); });
  EXPECT_EQ(where, std::this_thread::get_id());
}

TEST(ForEachPart, RethrowsTheFirstExceptionAfterAllPartsHaveEnded) {
  std::atomic<int> ended = 0;
  try {
    for_each_part(4, [&](int part) {
      ++ended;
      if (part == 1 || part == 3) throw std::runtime_error(std::to_string(part));
    });
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), "1");
  }
  EXPECT_EQ(ended, 4);
}

TEST(PartBegin, PartsFollowEachOtherAndDifferByOneElementAtMost) {
  for (const std::size_t n : {0u, 1u, 5u, 100u, 101u})
    for (const int parts : {1, 2, 3, 8}) {
      EXPECT_EQ(part_begin(n, 0, parts), 0u);
      EXPECT_EQ(part_begin(n, parts, parts), n);
      const std::size_t least = n / static_cast<std::size_t>(parts);
      for (int part = 0; part < parts; ++part) {
        const std::size_t length = part_begin(n, part + 1, parts) - part_begin(n, part, parts);
        EXPECT_GE(length, least);
        EXPECT_LE(length, least + 1);
      }
    }
}

}  // namespace
}  // namespace lanescape
