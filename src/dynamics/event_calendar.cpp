#include "dynamics/event_calendar.hpp"

#include <algorithm>
#include <limits>

namespace lanescape {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::size_t block = kernels::calendar_block;

}  // namespace

EventCalendar::EventCalendar(std::size_t events, const kernels::KernelTable& table) : table_(&table) {
  std::size_t entries = events;
  do {
    const std::size_t blocks = (entries + block - 1) / block;
    times_.emplace_back(blocks * block, never);
    winners_.emplace_back(times_.size() > 1 ? blocks * block : 0, -1);
    entries = blocks;
  } while (entries > 1);
  times_.emplace_back(1, never);
  winners_.emplace_back(1, -1);
  view_.levels = times_.size();
  for (std::size_t level = 0; level < view_.levels; ++level) {
    view_.times[level] = times_[level].data();
    view_.winners[level] = winners_[level].data();
  }
  while (times_[scanned_].size() > most_scanned) ++scanned_;
}

void EventCalendar::assign(const std::vector<double>& times) {
  std::copy(times.begin(), times.end(), times_[0].begin());
  for (std::size_t level = 1; level < view_.levels; ++level)
    for (std::size_t b = 0; b * block < times_[level - 1].size(); ++b) {
      const auto first = times_[level - 1].begin() + static_cast<std::ptrdiff_t>(b * block);
      const auto best = static_cast<std::size_t>(std::min_element(first, first + block) - times_[level - 1].begin());
      times_[level][b] = times_[level - 1][best];
      winners_[level][b] = level == 1 ? static_cast<std::int32_t>(best) : winners_[level - 1][best];
    }
}

}  // namespace lanescape
