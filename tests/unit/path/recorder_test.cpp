#include "path/recorder.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "memory_archive.hpp"

namespace lanescape {
namespace {

AlignedArray at(double distance) { return AlignedArray(8, distance); }

// Decreases the distance from `from` to `to` in steps of 1/16.
void approach(PathRecorder& recorder, double from, double to) {
  for (double distance = from; distance >= to; distance -= 0.0625) recorder.keep_frame(at(distance), distance);
}

TEST(PathRecorder, FramesAreEquallySpacedInTheDistanceToTheGoal) {
  PathRecorder recorder(3, 8.0);
  approach(recorder, 8.0, 0.0);
  EXPECT_EQ(recorder.frames(), (std::vector<AlignedArray>{at(6.0), at(4.0), at(2.0)}));
}

TEST(PathRecorder, AFrameIsTheFirstConfigurationThatIsNearEnough) {
  PathRecorder recorder(1, 8.0);
  for (const double distance : {7.0, 4.5, 3.5, 4.0, 1.0}) recorder.keep_frame(at(distance), distance);
  EXPECT_EQ(recorder.frames(), (std::vector<AlignedArray>{at(3.5)}));
}

TEST(PathRecorder, KeepsNoFramesWhereNoneAreWanted) {
  PathRecorder recorder(0, 8.0);
  approach(recorder, 8.0, 0.0);
  EXPECT_TRUE(recorder.frames().empty());
}

TEST(PathRecorder, HandedOnToAnotherItGoesOnAlike) {
  PathRecorder begun(3, 8.0), resumed(3, 8.0);
  approach(begun, 8.0, 5.0);
  begun.trace().add({1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
  testing::hand_on(begun, resumed);
  approach(resumed, 4.9375, 0.0);
  EXPECT_EQ(resumed.frames(), (std::vector<AlignedArray>{at(6.0), at(4.0), at(2.0)}));
  EXPECT_EQ(resumed.trace().at(0, PathRecorder::participation), 6.0);
}

}  // namespace
}  // namespace lanescape
