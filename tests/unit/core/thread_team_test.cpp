#include "core/thread_team.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>

namespace lanescape {
namespace {

using Calls = std::array<std::atomic<int>, ThreadTeam::blocks>;

TEST(ThreadTeam, DoesEveryBlockOfEveryLoopOnce) {
  for (const int threads : {1, 2, 3, 5, 16, 40})
    for (const Taking taking : {Taking::one_block, Taking::own_blocks}) {
      ThreadTeam team(threads);
      Calls calls{};
      team.run([&] {
        for (int loop = 1; loop <= 300; ++loop) {
          team.for_each([&](std::size_t block) { ++calls.at(block); }, taking);
          for (const auto& count : calls) ASSERT_EQ(count, loop);
        }
      });
    }
}

TEST(ThreadTeam, StartsItsThreadsForALoopOutsideRun) {
  ThreadTeam team(2);
  Calls calls{};
  for (int loop = 0; loop < 3; ++loop) team.for_each([&](std::size_t block) { ++calls.at(block); });
  for (const auto& count : calls) EXPECT_EQ(count, 3);
}

TEST(ThreadTeam, DoesTheBlocksOfAThreadThatIsBusyElsewhere) {
  ThreadTeam team(2);
  std::atomic<int> done = 0;
  team.run([&] {
    team.for_each([&](std::size_t block) {
      // The thread with the first block waits until all others have ended.
      while (block == 0 && done < static_cast<int>(ThreadTeam::blocks) - 1) std::this_thread::yield();
      ++done;
    });
  });
  EXPECT_EQ(done, static_cast<int>(ThreadTeam::blocks));
}

TEST(ThreadTeam, RethrowsTheExceptionOfTheFirstBlockOnceAllHaveEnded) {
  ThreadTeam team(3);
  int ended = 0;
  team.run([&] {
    for (int loop = 0; loop < 2; ++loop) {
      std::atomic<int> calls = 0;
      try {
        team.for_each([&](std::size_t block) {
          ++calls;
          if (block == 4 || block == 15) throw std::runtime_error(std::to_string(block));
        });
        ADD_FAILURE() << "nothing was thrown";
      } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()), "4");
      }
      ended += calls;
    }
  });
  EXPECT_EQ(ended, 2 * static_cast<int>(ThreadTeam::blocks));
}

TEST(ThreadTeam, RethrowsWhatItsProgramThrowsAndCanRunAgain) {
  ThreadTeam team(2);
  EXPECT_THROW(team.run([] { throw std::runtime_error("no"); }), std::runtime_error);
  Calls calls{};
  team.run([&] { team.for_each([&](std::size_t block) { ++calls.at(block); }); });
  for (const auto& count : calls) EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace lanescape
