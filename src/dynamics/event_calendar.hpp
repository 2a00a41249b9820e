#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/aligned_array.hpp"
#include "core/prefetch.hpp"
#include "kernel_table.hpp"

namespace lanescape {

// The time of the next event of each particle, and the earliest of them, found by a tournament in blocks of 16. An update replays
// only the blocks of its particle. Ties go to the lowest number, so the result does not depend on the order of updates.
class EventCalendar {
 public:
  EventCalendar(std::size_t events, const kernels::KernelTable& table);

  // Sets all times at once.
  void assign(const std::vector<double>& times);
  void update(std::size_t event, double time) { table_->calendar_update(view_, event, time); }
  std::size_t first() const { return static_cast<std::size_t>(view_.winners[view_.levels - 1][0]); }
  double first_time() const { return view_.times[view_.levels - 1][0]; }

  // Calls visit(event) for events after `after` and not after `until`. Only the earliest of each of some hundred blocks is seen.
  template <class Visit>
  void for_most_between(double after, double until, Visit visit) const {
    // Branches on times would often be predicted wrongly: hits are counted instead.
    std::array<std::size_t, most_scanned> near;
    std::size_t blocks = 0;
    for (std::size_t b = 0; b < times_[scanned_].size(); ++b) {
      near[blocks] = b;
      blocks += view_.times[scanned_][b] <= until;
    }
    const double* const entries = view_.times[scanned_ - 1];
    for (std::size_t n = 0; n < blocks; ++n) {
      const std::size_t first = near[n] * kernels::calendar_block;
      std::array<std::size_t, kernels::calendar_block> hits;
      std::size_t count = 0;
      for (std::size_t k = first; k < first + kernels::calendar_block; ++k) {
        hits[count] = k;
        count += static_cast<std::size_t>(entries[k] <= until) & static_cast<std::size_t>(entries[k] > after);
      }
      for (std::size_t h = 0; h < count; ++h)
        visit(scanned_ > 1 ? static_cast<std::size_t>(view_.winners[scanned_ - 1][hits[h]]) : hits[h]);
    }
  }
  // Fetches into the cache what an update of this event reads first.
  [[gnu::always_inline]] void prefetch(std::size_t event) const {
    const double* const block = view_.times[0] + event / kernels::calendar_block * kernels::calendar_block;
    for (std::size_t k = 0; k < kernels::calendar_block; k += doubles_per_line) lanescape::prefetch(block + k);
  }

  EventCalendar(EventCalendar&&) = default;
  EventCalendar& operator=(EventCalendar&&) = default;

 private:
  static constexpr std::size_t doubles_per_line = 8;
  static constexpr std::size_t most_scanned = 256;  // entries of a level that are all looked at to see what comes next

  const kernels::KernelTable* table_;
  std::vector<AlignedArray> times_;
  std::vector<std::vector<std::int32_t>> winners_;
  kernels::CalendarView view_{};
  std::size_t scanned_ = 1;  // the lowest such level above the events
};

}  // namespace lanescape
