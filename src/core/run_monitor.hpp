#pragma once

#include <cstdint>
#include <string_view>

namespace lanescape {

// How a long run talks to whoever started it. Called from the run's threads; implementations are thread-safe.
class RunMonitor {
 public:
  virtual ~RunMonitor() = default;
  // `done` of `total` units of the named stage; total 0 where it is not known.
  virtual void progress(std::string_view stage, double done, double total) = 0;
  // True once the run shall end at the next whole step.
  virtual bool stop_requested() const = 0;
};

// For callers that neither watch nor interrupt.
class SilentMonitor final : public RunMonitor {
 public:
  void progress(std::string_view, double, double) override {}
  bool stop_requested() const override { return false; }
};

}  // namespace lanescape
