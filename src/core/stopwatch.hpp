#pragma once

#include <chrono>

#include "core/archive.hpp"

namespace lanescape {

// Computing time of a run, summed over its interruptions.
class Stopwatch {
 public:
  void start() { started_ = Clock::now(); }
  // Adds the time since start() or the last lap.
  void lap() {
    const auto now = Clock::now();
    seconds_ += std::chrono::duration<double>(now - started_).count();
    started_ = now;
  }
  double seconds() const { return seconds_; }  // up to the last lap

  void exchange(Archive& archive) { archive.field("run_seconds", seconds_); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point started_ = Clock::now();
  double seconds_ = 0.0;
};

}  // namespace lanescape
