#include "core/available_threads.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace lanescape {
namespace {

// A folder in place of the root of the file system, with the files of cgroups.
class CgroupFolder : public testing::Test {
 protected:
  void SetUp() override {
    root_ = std::filesystem::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(root_);
  }
  void TearDown() override { std::filesystem::remove_all(root_); }

  void write(const std::string& file, const std::string& text) const {
    const std::filesystem::path path = root_ / file;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text << '\n';
  }
  int threads() const { return available_threads(root_.string()); }

 private:
  std::filesystem::path root_;
};

int processors() {
  cpu_set_t mask;
  EXPECT_EQ(sched_getaffinity(0, sizeof mask, &mask), 0);
  return CPU_COUNT(&mask);
}

TEST_F(CgroupFolder, WithoutGroupsTheAffinityMaskDecides) { EXPECT_EQ(threads(), processors()); }

TEST_F(CgroupFolder, AThreadThatIsBoundToOneProcessorHasOne) {
  cpu_set_t all, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
  int processor = 0;
  while (!CPU_ISSET(processor, &all)) ++processor;
  CPU_ZERO(&one);
  CPU_SET(processor, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(threads(), 1);
  ASSERT_EQ(sched_setaffinity(0, sizeof all, &all), 0);
}

TEST_F(CgroupFolder, AQuotaOfVersion2IsRoundedUp) {
  write("proc/self/cgroup", "0::/");
  write("sys/fs/cgroup/cpu.max", "50000 100000");
  EXPECT_EQ(threads(), 1);
  write("sys/fs/cgroup/cpu.max", "100001 100000");
  EXPECT_EQ(threads(), std::min(processors(), 2));
  write("sys/fs/cgroup/cpu.max", "max 100000");
  EXPECT_EQ(threads(), processors());
}

TEST_F(CgroupFolder, AGroupAboveLimitsToo) {
  write("proc/self/cgroup", "0::/slice/job/step");
  write("sys/fs/cgroup/slice/cpu.max", "100000 100000");
  write("sys/fs/cgroup/slice/job/step/cpu.max", "max 100000");
  EXPECT_EQ(threads(), 1);
}

TEST_F(CgroupFolder, AQuotaOfVersion1Counts) {
  write("proc/self/cgroup", "5:memory:/job\n4:cpu,cpuacct:/job\n0::/");
  write("sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_quota_us", "-1");
  write("sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_period_us", "100000");
  EXPECT_EQ(threads(), processors());
  write("sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_quota_us", "20000");
  EXPECT_EQ(threads(), 1);
}

TEST_F(CgroupFolder, FilesThatSayNothingLimitNothing) {
  write("proc/self/cgroup", "nonsense\n0:\n0::\n1:cpu:relative\n0::/job");
  write("sys/fs/cgroup/job/cpu.max", "");
  EXPECT_EQ(threads(), processors());
  write("sys/fs/cgroup/job/cpu.max", "0 0");
  EXPECT_EQ(threads(), processors());
}

}  // namespace
}  // namespace lanescape
