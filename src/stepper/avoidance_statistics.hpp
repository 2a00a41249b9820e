#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/archive.hpp"
#include "core/step_histogram.hpp"
#include "interaction/sphere/hard_sphere_list.hpp"

namespace lanescape {

// What [G] 4.9 counts along a hard-sphere path: overlapping partners v of an overlapped particle in failed direct steps; particles
// c moved in an avoidance step; groups of particles linked by overlaps over all trials of a step, their sizes s and their
// number m, and s where m is small, middling or large. Histograms: entry k counts the value k.
class AvoidanceStatistics {
 public:
  enum Range : std::size_t { few_groups, some_groups, many_groups, ranges };

  AvoidanceStatistics(std::size_t slots, std::size_t particles);

  // One avoidance step: the overlaps of the failed direct trial, of each further trial, and the number of particles that moved in
  // the accepted one.
  void begin_step(const ContactPairs& overlaps);
  void add_trial(const ContactPairs& overlaps);
  void end_step(std::size_t moved);

  // All histograms with their names.
  std::vector<StepHistogram> histograms() const;
  const std::vector<std::uint64_t>& partners() const { return partners_; }  // v
  const std::vector<std::uint64_t>& moved() const { return moved_; }        // c
  const std::vector<std::uint64_t>& group_sizes(Range range) const { return group_sizes_[range]; }
  const std::vector<std::uint64_t>& group_numbers() const { return group_numbers_; }  // m
  // Steps with fewer than the first, or more than the second, belong to few_groups and many_groups: [G]'s 4 and 18 at
  // N = 108, 10 and 45 at N = 256, in proportion elsewhere.
  std::array<std::size_t, 2> group_bounds() const { return bounds_; }

  void exchange(Archive& archive);

 private:
  std::int32_t root(std::int32_t slot);
  void touch(std::int32_t slot);

  std::array<std::size_t, 2> bounds_;
  std::vector<std::uint64_t> partners_, moved_, group_numbers_;
  std::array<std::vector<std::uint64_t>, ranges> group_sizes_;
  // Of the current step: particles with overlaps, their partners in the direct trial, and a forest of groups.
  std::vector<std::int32_t> touched_, parent_, partner_count_, size_;
};

}  // namespace lanescape
