#include "stepper/avoidance_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lanescape {
namespace {

constexpr std::int32_t untouched = -1;
constexpr std::size_t most_partners = 32;

std::array<std::size_t, 2> bounds_for(std::size_t particles) {
  if (particles == 256) return {10, 45};
  const auto share = [&](double of_108) {
    return static_cast<std::size_t>(std::lround(of_108 * static_cast<double>(particles) / 108.0));
  };
  return {share(4.0), share(18.0)};
}

}  // namespace

AvoidanceStatistics::AvoidanceStatistics(std::size_t slots, std::size_t particles)
    : bounds_(bounds_for(particles)),
      partners_(most_partners + 1, 0),
      moved_(particles + 1, 0),
      group_numbers_(particles / 2 + 1, 0),
      parent_(slots, untouched),
      partner_count_(slots, 0),
      size_(slots, 0) {
  group_sizes_.fill(std::vector<std::uint64_t>(particles + 1, 0));
  touched_.reserve(particles);
}

void AvoidanceStatistics::begin_step(const ContactPairs& overlaps) {
  for (const std::int32_t slot : touched_) parent_[static_cast<std::size_t>(slot)] = untouched;
  touched_.clear();
  add_trial(overlaps);
  for (std::size_t k = 0; k < overlaps.count; ++k) {
    ++partner_count_[static_cast<std::size_t>(overlaps[k].first)];
    ++partner_count_[static_cast<std::size_t>(overlaps[k].second)];
  }
  for (const std::int32_t slot : touched_)
    ++partners_[std::min(static_cast<std::size_t>(partner_count_[static_cast<std::size_t>(slot)]), most_partners)];
}

void AvoidanceStatistics::touch(std::int32_t slot) {
  const auto s = static_cast<std::size_t>(slot);
  if (parent_[s] != untouched) return;
  parent_[s] = slot;
  partner_count_[s] = 0;
  size_[s] = 0;
  touched_.push_back(slot);
}

std::int32_t AvoidanceStatistics::root(std::int32_t slot) {
  auto s = static_cast<std::size_t>(slot);
  while (parent_[s] != static_cast<std::int32_t>(s)) {
    parent_[s] = parent_[static_cast<std::size_t>(parent_[s])];
    s = static_cast<std::size_t>(parent_[s]);
  }
  return static_cast<std::int32_t>(s);
}

void AvoidanceStatistics::add_trial(const ContactPairs& overlaps) {
  for (std::size_t k = 0; k < overlaps.count; ++k) {
    const kernels::SpherePair pair = overlaps[k];
    touch(pair.first);
    touch(pair.second);
    parent_[static_cast<std::size_t>(root(pair.first))] = root(pair.second);
  }
}

void AvoidanceStatistics::end_step(std::size_t moved) {
  ++moved_[moved];
  for (const std::int32_t slot : touched_) ++size_[static_cast<std::size_t>(root(slot))];
  std::size_t groups = 0;
  for (const std::int32_t slot : touched_) groups += size_[static_cast<std::size_t>(slot)] > 0;
  ++group_numbers_[groups];
  auto& sizes = group_sizes_[groups < bounds_[0] ? few_groups : groups > bounds_[1] ? many_groups : some_groups];
  for (const std::int32_t slot : touched_)
    if (size_[static_cast<std::size_t>(slot)] > 0) ++sizes[static_cast<std::size_t>(size_[static_cast<std::size_t>(slot)])];
}

std::vector<StepHistogram> AvoidanceStatistics::histograms() const {
  const auto histogram = [](const char* quantity, const std::vector<std::uint64_t>& counts) {
    return StepHistogram{quantity, 0.0, 1.0, {counts.begin(), counts.end()}};
  };
  return {histogram("overlapping_partners", partners_),
          histogram("moved_particles", moved_),
          histogram("groups", group_numbers_),
          histogram("group_size_few_groups", group_sizes_[few_groups]),
          histogram("group_size_some_groups", group_sizes_[some_groups]),
          histogram("group_size_many_groups", group_sizes_[many_groups])};
}

void AvoidanceStatistics::exchange(Archive& archive) {
  archive.field("partners", partners_);
  archive.field("moved", moved_);
  archive.field("group_numbers", group_numbers_);
  for (std::size_t range = 0; range < ranges; ++range) archive.field(fmt::format("group_sizes{}", range), group_sizes_[range]);
}

}  // namespace lanescape
