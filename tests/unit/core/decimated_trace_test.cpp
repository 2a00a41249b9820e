#include "core/decimated_trace.hpp"

#include <gtest/gtest.h>

#include "memory_archive.hpp"

namespace lanescape {
namespace {

// Rows of steps `from` to `to`: the step and its square.
void run(DecimatedTrace& trace, std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t step = from; step <= to; ++step) {
    const auto x = static_cast<double>(step);
    if (trace.wants(step)) trace.add({x, x * x});
  }
}

// True if the rows are those of steps stride, 2 stride, ... up to the last.
void expect_rows_every(const DecimatedTrace& trace, double stride, std::size_t rows) {
  ASSERT_EQ(trace.rows(), rows);
  for (std::size_t row = 0; row < rows; ++row) {
    const double step = stride * static_cast<double>(row + 1);
    EXPECT_EQ(trace.at(row, 0), step);
    EXPECT_EQ(trace.at(row, 1), step * step);
  }
}

TEST(DecimatedTrace, KeepsEveryStepWhileThereIsRoom) {
  DecimatedTrace trace(2, 8);
  EXPECT_EQ(trace.rows(), 0u);
  run(trace, 1, 7);
  EXPECT_EQ(trace.columns(), 2u);
  expect_rows_every(trace, 1.0, 7);
}

TEST(DecimatedTrace, DropsEverySecondRowAndDoublesTheStrideWhenFull) {
  DecimatedTrace trace(2, 8);
  run(trace, 1, 8);
  expect_rows_every(trace, 2.0, 4);
  run(trace, 9, 15);
  expect_rows_every(trace, 2.0, 7);
  run(trace, 16, 16);
  expect_rows_every(trace, 4.0, 4);
}

TEST(DecimatedTrace, StaysBelowItsCapacityHoweverLongTheRun) {
  DecimatedTrace trace(2, 8);
  run(trace, 1, 100'000);
  expect_rows_every(trace, 16384.0, 6);
}

TEST(DecimatedTrace, TakesTheLastRowOfAllAtAnyStep) {
  DecimatedTrace trace(2, 8);
  run(trace, 1, 9);
  trace.add({9.0, 81.0});
  ASSERT_EQ(trace.rows(), 5u);
  EXPECT_EQ(trace.at(4, 0), 9.0);
}

TEST(DecimatedTrace, HandedOnToAnotherItGoesOnAlike) {
  for (const std::uint64_t stop : {0u, 5u, 8u, 13u}) {
    DecimatedTrace begun(2, 8), resumed(2, 8);
    run(begun, 1, stop);
    testing::hand_on(begun, resumed);
    run(resumed, stop + 1, 30);
    expect_rows_every(resumed, 4.0, 7);
  }
}

}  // namespace
}  // namespace lanescape
