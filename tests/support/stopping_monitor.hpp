#pragma once

#include <atomic>
#include <string_view>

#include "core/run_monitor.hpp"

namespace lanescape::testing {

// Requests a stop from query number `looks` on.
class StoppingMonitor final : public RunMonitor {
 public:
  explicit StoppingMonitor(int looks) : looks_(looks) {}
  void progress(std::string_view, double, double) override {}
  bool stop_requested() const override { return --looks_ <= 0; }

 private:
  mutable std::atomic<int> looks_;
};

}  // namespace lanescape::testing
