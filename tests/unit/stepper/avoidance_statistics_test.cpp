#include "stepper/avoidance_statistics.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "memory_archive.hpp"

namespace lanescape {
namespace {

using Range = AvoidanceStatistics::Range;

// Overlaps in the format of a list.
struct Overlaps {
  std::vector<std::int32_t> offsets, first, second;

  Overlaps(std::initializer_list<std::pair<std::int32_t, std::int32_t>> pairs) {
    for (const auto& [i, j] : pairs) {
      offsets.push_back(static_cast<std::int32_t>(offsets.size()));
      first.push_back(i);
      second.push_back(j);
    }
  }
  ContactPairs pairs() const { return {offsets.data(), first.data(), second.data(), offsets.size()}; }
};

// 0 - 1 - 2 and 4 - 5 overlap first, and 2 - 4 overlap in a second trial.
void one_step(AvoidanceStatistics& statistics) {
  statistics.begin_step(Overlaps{{0, 1}, {1, 2}, {4, 5}}.pairs());
  statistics.add_trial(Overlaps{{2, 4}}.pairs());
  statistics.end_step(5);
}

std::vector<std::uint64_t> counts(std::size_t size, std::size_t of, std::uint64_t count) {
  std::vector<std::uint64_t> all(size, 0);
  all[of] = count;
  return all;
}

TEST(AvoidanceStatistics, PartnersAreThoseOfTheDirectTrialAndGroupsThoseOfAll) {
  AvoidanceStatistics statistics(112, 108);
  one_step(statistics);
  EXPECT_EQ(statistics.partners()[1], 4u);
  EXPECT_EQ(statistics.partners()[2], 1u);
  EXPECT_EQ(statistics.moved(), counts(109, 5, 1));
  EXPECT_EQ(statistics.group_numbers(), counts(55, 1, 1));
  EXPECT_EQ(statistics.group_sizes(Range::few_groups), counts(109, 5, 1));
  EXPECT_EQ(statistics.group_sizes(Range::some_groups), counts(109, 0, 0));
}

TEST(AvoidanceStatistics, AStepKnowsNothingOfTheOneBefore) {
  AvoidanceStatistics statistics(112, 108);
  one_step(statistics);
  statistics.begin_step(Overlaps{{0, 5}, {10, 11}, {12, 13}, {14, 15}}.pairs());
  statistics.end_step(8);
  EXPECT_EQ(statistics.partners()[1], 12u);
  EXPECT_EQ(statistics.group_numbers()[4], 1u);
  EXPECT_EQ(statistics.group_sizes(Range::some_groups), counts(109, 2, 4));  // four or more groups
}

TEST(AvoidanceStatistics, BoundsAreThoseOfTheSourceAndInProportionElsewhere) {
  EXPECT_EQ(AvoidanceStatistics(112, 108).group_bounds(), (std::array<std::size_t, 2>{4, 18}));
  EXPECT_EQ(AvoidanceStatistics(256, 256).group_bounds(), (std::array<std::size_t, 2>{10, 45}));
  EXPECT_EQ(AvoidanceStatistics(216, 216).group_bounds(), (std::array<std::size_t, 2>{8, 36}));
}

TEST(AvoidanceStatistics, HandedOnTheyHaveTheSameCounts) {
  AvoidanceStatistics statistics(112, 108), copy(112, 108);
  one_step(statistics);
  testing::hand_on(statistics, copy);
  EXPECT_EQ(copy.partners(), statistics.partners());
  EXPECT_EQ(copy.moved(), statistics.moved());
  EXPECT_EQ(copy.group_numbers(), statistics.group_numbers());
  EXPECT_EQ(copy.group_sizes(Range::few_groups), statistics.group_sizes(Range::few_groups));
}

}  // namespace
}  // namespace lanescape
