#include "dynamics/event_calendar.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "dispatch/isa.hpp"

namespace lanescape {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

const kernels::KernelTable& best_table() { return kernel_table(available_isas().back()); }

TEST(EventCalendar, KnowsTheEarliestOfTimesSetAtOnce) {
  EventCalendar calendar(40, best_table());
  std::vector<double> times(40, 5.0);
  times[33] = 2.0;
  calendar.assign(times);
  EXPECT_EQ(calendar.first(), 33U);
  EXPECT_EQ(calendar.first_time(), 2.0);
}

TEST(EventCalendar, FollowsTheEarliestAsItIsPutOff) {
  EventCalendar calendar(300, best_table());
  std::vector<double> times(300);
  for (std::size_t i = 0; i < 300; ++i) times[i] = static_cast<double>((i * 7) % 300);  // each number occurs once
  calendar.assign(times);
  for (int expected = 0; expected < 300; ++expected) {
    ASSERT_EQ(calendar.first_time(), expected);
    ASSERT_EQ(calendar.first() * 7 % 300, static_cast<std::size_t>(expected));
    calendar.update(calendar.first(), never);
  }
  EXPECT_EQ(calendar.first_time(), never);
}

TEST(EventCalendar, GivesTiesToTheLowestNumberWhateverTheOrderOfUpdates) {
  for (const bool rising : {true, false}) {
    EventCalendar calendar(600, best_table());
    for (std::size_t k = 0; k < 600; ++k) calendar.update(rising ? k : 599 - k, 1.0);
    EXPECT_EQ(calendar.first(), 0U);
    calendar.update(0, 2.0);
    EXPECT_EQ(calendar.first(), 1U);
    for (std::size_t k = 1; k < 20; ++k) calendar.update(k, 2.0);
    EXPECT_EQ(calendar.first(), 20U);
    calendar.update(16, 1.0);
    EXPECT_EQ(calendar.first(), 16U);
    EXPECT_EQ(calendar.first_time(), 1.0);
  }
}

std::vector<std::size_t> seen_between(const EventCalendar& calendar, double after, double until) {
  std::vector<std::size_t> seen;
  calendar.for_most_between(after, until, [&](std::size_t event) { seen.push_back(event); });
  return seen;
}

TEST(EventCalendar, SeesAllEventsOfAStretchOfTimeIfTheyAreFew) {
  EventCalendar calendar(300, best_table());
  for (std::size_t k = 0; k < 300; ++k) calendar.update(k, static_cast<double>(k));
  EXPECT_EQ(seen_between(calendar, 20.0, 23.0), (std::vector<std::size_t>{21, 22, 23}));
}

// 10,000 events: 40 entries at the level that is looked at, and below it 625 blocks of 16 events.
TEST(EventCalendar, SeesTheEarliestOfEachBlockOfManyEvents) {
  EventCalendar calendar(10'000, best_table());
  for (std::size_t k = 0; k < 10'000; ++k) calendar.update(k, static_cast<double>(k));
  EXPECT_EQ(seen_between(calendar, -1.0, 34.0), (std::vector<std::size_t>{0, 16, 32}));
  EXPECT_EQ(seen_between(calendar, 0.0, 34.0), (std::vector<std::size_t>{16, 32}));
}

TEST(EventCalendar, HoldsASingleEvent) {
  EventCalendar calendar(1, best_table());
  calendar.update(0, 3.0);
  EXPECT_EQ(calendar.first(), 0U);
  EXPECT_EQ(calendar.first_time(), 3.0);
}

TEST(EventCalendar, TakesItsEventsAlongWhenMoved) {
  EventCalendar calendar(20, best_table());
  calendar.update(17, 1.0);
  EventCalendar moved = std::move(calendar);
  moved.update(18, 0.5);
  EXPECT_EQ(moved.first(), 18U);
  moved.update(18, 2.0);
  EXPECT_EQ(moved.first(), 17U);
}

}  // namespace
}  // namespace lanescape
