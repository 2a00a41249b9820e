#pragma once

#include <cstdint>
#include <string_view>

namespace lanescape {

// A long run reports to its caller. The run's threads call it, so implementations are thread-safe.
class RunMonitor {
 public:
  virtual ~RunMonitor() = default;
  // `done` of `total` units of the named stage; total is 0 if unknown.
  virtual void progress(std::string_view stage, double done, double total) = 0;
  // What users should know of a run that goes on, in one line.
  virtual void notice(std::string_view) {}
  // True if the run must end at the next whole step.
  virtual bool stop_requested() const = 0;
};

// Neither reports nor interrupts.
class SilentMonitor final : public RunMonitor {
 public:
  void progress(std::string_view, double, double) override {}
  bool stop_requested() const override { return false; }
};

}  // namespace lanescape
