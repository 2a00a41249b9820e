#include "core/thread_team.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/parallel.hpp"
#include "own_process.hpp"

namespace lanescape {
namespace {

TEST(ThreadTeam, DoesEveryBlockOfEveryLoopOnce) {
  for (const int threads : {1, 2, 3, 5, 16, 40})
    for (const std::size_t blocks : {1u, 2u, 16u, 100u, 20'000u})
      for (const Taking taking : {Taking::one_block, Taking::own_blocks}) {
        std::vector<std::atomic<int>> calls(blocks);
        for (int loop = 1; loop <= (blocks > 100 ? 3 : 100); ++loop) {
          for_each_block(threads, blocks, [&](std::size_t block) { ++calls.at(block); }, taking);
          for (const auto& count : calls) ASSERT_EQ(count, loop);
        }
      }
}

TEST(ThreadTeam, UsesAsManyThreadsAsAreWantedAndKeepsThem) {
  constexpr int threads = 3;
  std::set<std::thread::id> first;
  for (int loop = 0; loop < 20; ++loop) {
    std::array<std::thread::id, threads> who;
    std::atomic<int> here = 0;
    for_each_part(threads, [&](int part) {
      who.at(static_cast<std::size_t>(part)) = std::this_thread::get_id();
      for (++here; here < threads;) std::this_thread::yield();  // nobody does the part of another
    });
    const std::set<std::thread::id> now(who.begin(), who.end());
    EXPECT_EQ(now.size(), static_cast<std::size_t>(threads));
    if (loop == 0) first = now;
    EXPECT_EQ(now, first);
  }
}

TEST(ThreadTeam, DoesTheBlocksOfAThreadThatIsBusyElsewhere) {
  constexpr int blocks = 16;
  std::atomic<int> done = 0;
  for_each_block(2, blocks, [&](std::size_t block) {
    // The thread with the first block waits until all others have ended.
    while (block == 0 && done < blocks - 1) std::this_thread::yield();
    ++done;
  });
  EXPECT_EQ(done, blocks);
}

TEST(ThreadTeam, GoesOnAfterItsThreadsHaveSlept) {
  std::atomic<int> calls = 0;
  for (int loop = 0; loop < 5; ++loop) {
    for_each_part(4, [&](int) { ++calls; });
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(calls, 20);
}

TEST(ThreadTeam, WaitsForBlocksThatTakeLong) {
  std::atomic<int> ended = 0;
  for_each_part(3, [&](int part) {
    std::this_thread::sleep_for(std::chrono::milliseconds(part * 10));
    ++ended;
  });
  EXPECT_EQ(ended, 3);
}

TEST(ThreadTeam, ALoopInsideALoopStaysOnItsThread) {
  std::atomic<int> strange = 0;
  for_each_part(2, [&](int) {
    const auto here = std::this_thread::get_id();
    for_each_block(4, 8, [&](std::size_t) { strange += std::this_thread::get_id() != here; });
  });
  EXPECT_EQ(strange, 0);
}

TEST(ThreadTeam, RethrowsTheExceptionOfTheFirstBlockOnceAllHaveEnded) {
  constexpr std::size_t blocks = 16;
  for (int loop = 0; loop < 20; ++loop) {
    std::atomic<std::size_t> ended = 0;
    try {
      for_each_block(3, blocks, [&](std::size_t block) {
        ++ended;
        if (block == 4 || block == 15) throw std::runtime_error(std::to_string(block));
      });
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()), "4");
    }
    EXPECT_EQ(ended, blocks);
  }
}

TEST(ThreadTeam, ThreadsOfAHostHaveTeamsOfTheirOwn) {
  std::atomic<int> calls = 0;
  std::vector<std::thread> hosts;
  for (int host = 0; host < 3; ++host)
    hosts.emplace_back([&] {
      for (int loop = 0; loop < 200; ++loop) for_each_block(2, 8, [&](std::size_t) { ++calls; });
    });
  for (std::thread& host : hosts) host.join();
  EXPECT_EQ(calls, 3 * 200 * 8);
}

TEST(ThreadTeam, AForkedChildGoesOnAlone) {
  for_each_part(2, [](int) {});
  EXPECT_EQ(lanescape::testing::status_of([] {
              alarm(20);  // ends a child that waits for ever
              const auto here = std::this_thread::get_id();
              int calls = 0, strange = 0;
              for_each_part(2, [&](int) {
                ++calls;
                strange += std::this_thread::get_id() != here;
              });
              return calls == 2 && strange == 0;
            }),
            0);
}

TEST(ThreadTeam, EveryThreadRoundsToNearestAndTheCallerGetsItsOwnRoundingBack) {
  const auto rounds_up = [] {
    volatile double one = 1.0, little = 1e-30;
    return one + little != one;
  };
  std::atomic<int> wrong = 0;
  ASSERT_EQ(std::fesetround(FE_UPWARD), 0);
  for_each_part(2, [&](int) { wrong += rounds_up(); });
  const bool rounds_up_again = rounds_up();
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(wrong, 0);
  EXPECT_TRUE(rounds_up_again);
}

}  // namespace
}  // namespace lanescape
