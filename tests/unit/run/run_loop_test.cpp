#include "run/run_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "stopping_monitor.hpp"
#include "test_files.hpp"

namespace lanescape {
namespace {

// Counts to `goal`, one per chunk. Only even counts can be saved, and every fourth count is due for saving.
class Counting final : public ResumableWork {
 public:
  explicit Counting(std::uint64_t goal) : goal_(goal) {}
  bool finished() const override { return count_ == goal_; }
  void advance(RunMonitor&) override { ++count_, ++chunks_; }
  void exchange(Archive& archive) override { archive.field("count", count_); }
  bool saveable() const override { return count_ % 2 == 0; }
  bool save_due() const override { return count_ % 4 == 0; }

  std::uint64_t count() const { return count_; }
  std::uint64_t chunks() const { return chunks_; }

 private:
  std::uint64_t goal_, count_ = 0, chunks_ = 0;
};

TEST(RunLoop, DoesTheWorkToItsEndAndKeepsItsState) {
  const testing::TemporaryFolder folder;
  SilentMonitor silent;
  Counting work(10);
  EXPECT_FALSE(run_to_end(work, "count.h5", {folder.path(), false}, silent));
  EXPECT_EQ(work.count(), 10U);
  EXPECT_EQ(folder.entries(), 2U);  // the last state and the one before
  Counting again(10);
  EXPECT_FALSE(run_to_end(again, "count.h5", {folder.path(), true}, silent));
  EXPECT_EQ(again.count(), 10U);
  EXPECT_EQ(again.chunks(), 0U);
}

TEST(RunLoop, ContinuesFromTheLastStateThatCanBeSaved) {
  for (const auto& [stop_at, saved_at] : {std::pair{6, 6U}, std::pair{7, 4U}}) {  // 7 cannot be saved, and 6 is not due
    const testing::TemporaryFolder folder;
    testing::StoppingMonitor stopping(stop_at);
    Counting begun(10);
    EXPECT_TRUE(run_to_end(begun, "count.h5", {folder.path(), false}, stopping));
    EXPECT_EQ(begun.count(), static_cast<std::uint64_t>(stop_at));
    SilentMonitor silent;
    Counting resumed(10);
    EXPECT_FALSE(run_to_end(resumed, "count.h5", {folder.path(), true}, silent));
    EXPECT_EQ(resumed.count(), 10U);
    EXPECT_EQ(resumed.chunks(), 10U - saved_at);
  }
}

TEST(RunLoop, CountsTheTimeBeforeAnInterruptionToo) {
  const testing::TemporaryFolder folder;
  testing::StoppingMonitor stopping(6);
  Counting begun(10), resumed(10);
  run_to_end(begun, "count.h5", {folder.path(), false}, stopping);
  SilentMonitor silent;
  run_to_end(resumed, "count.h5", {folder.path(), true}, silent);
  EXPECT_GT(begun.clock().seconds(), 0.0);
  EXPECT_GT(resumed.clock().seconds(), begun.clock().seconds());
}

TEST(RunLoop, StartsAnewUnlessAskedToResumeAndKeepsNothingWithoutAFolder) {
  const testing::TemporaryFolder folder;
  SilentMonitor silent;
  Counting first(4), second(4), third(4);
  run_to_end(first, "count.h5", {folder.path(), false}, silent);
  run_to_end(second, "count.h5", {folder.path(), false}, silent);
  EXPECT_EQ(second.chunks(), 4U);
  run_to_end(third, "count.h5", {}, silent);
  EXPECT_EQ(third.chunks(), 4U);
  EXPECT_EQ(folder.entries(), 2U);
}

// Resumes a count to 10 that saved its state at 4, 8 and 10.
class DamagedState : public ::testing::Test {
 protected:
  void SetUp() override { run_to_end(first_, "count.h5", {folder_.path(), false}, monitor_); }
  void resume() { run_to_end(resumed_, "count.h5", {folder_.path(), true}, monitor_); }
  void damage(const char* name) const {
    const std::string content = testing::content_of(folder_.path() / name);
    folder_.file(name, content.substr(0, content.size() / 2));
  }

  struct Noting final : RunMonitor {
    void progress(std::string_view, double, double) override {}
    void notice(std::string_view line) override { notices.emplace_back(line); }
    bool stop_requested() const override { return false; }
    std::vector<std::string> notices;
  };
  const testing::TemporaryFolder folder_;
  Noting monitor_;
  Counting first_{10}, resumed_{10};
};

TEST_F(DamagedState, GivesWayToTheOneBeforeWithANotice) {
  damage("count.h5");
  resume();
  EXPECT_EQ(resumed_.count(), 10U);
  EXPECT_EQ(resumed_.chunks(), 2U);
  ASSERT_EQ(monitor_.notices.size(), 1U);
  testing::expect_contains(monitor_.notices[0], "count.h5: it does not end with a checksum");
  testing::expect_contains(monitor_.notices[0], "the state saved before it is used");
}

TEST_F(DamagedState, IsReplacedWhereItIsLost) {
  std::filesystem::remove(folder_.path() / "count.h5");
  resume();
  EXPECT_EQ(resumed_.chunks(), 2U);
}

TEST_F(DamagedState, IsRefusedAndKeptWhereTheOneBeforeIsDamagedToo) {
  damage("count.h5");
  damage("count.h5.previous");
  const std::string content = testing::content_of(folder_.path() / "count.h5");
  testing::expect_contains(testing::refusal([&] { resume(); }), "count.h5: it does not end with a checksum");
  EXPECT_EQ(testing::content_of(folder_.path() / "count.h5"), content);
  EXPECT_TRUE(monitor_.notices.empty());
}

TEST_F(DamagedState, BeforeAWholeOneIsIgnored) {
  damage("count.h5.previous");
  resume();
  EXPECT_EQ(resumed_.chunks(), 0U);
  EXPECT_TRUE(monitor_.notices.empty());
}

}  // namespace
}  // namespace lanescape
