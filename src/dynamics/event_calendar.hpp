#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/aligned_array.hpp"
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

  EventCalendar(EventCalendar&&) = default;
  EventCalendar& operator=(EventCalendar&&) = default;

 private:
  const kernels::KernelTable* table_;
  std::vector<AlignedArray> times_;
  std::vector<std::vector<std::int32_t>> winners_;
  kernels::CalendarView view_{};
};

}  // namespace lanescape
