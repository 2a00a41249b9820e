#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/run_monitor.hpp"

namespace lanescape {

// The progress of several parts of a run together, from that of each.
class SharedProgress {
 public:
  // `total` of all parts; 0 if unknown.
  SharedProgress(RunMonitor& monitor, std::string stage, std::size_t parts, double total)
      : monitor_(&monitor), stage_(std::move(stage)), total_(total), done_(parts) {}

  void report(std::size_t part, double done) {
    done_[part] = done;
    double sum = 0.0;
    for (const auto& d : done_) sum += d;
    monitor_->progress(stage_, sum, total_);
  }
  void notice(std::string_view line) { monitor_->notice(line); }
  bool stop_requested() const { return monitor_->stop_requested(); }

 private:
  RunMonitor* monitor_;
  std::string stage_;
  double total_;
  std::vector<std::atomic<double>> done_;
};

// What the work on one part reports: a share of it, from `offset` on.
class PartMonitor final : public RunMonitor {
 public:
  PartMonitor(SharedProgress& progress, std::size_t part, double offset, double share)
      : progress_(&progress), part_(part), offset_(offset), share_(share) {}
  void progress(std::string_view, double done, double) override { progress_->report(part_, offset_ + share_ * done); }
  void notice(std::string_view line) override { progress_->notice(line); }
  bool stop_requested() const override { return progress_->stop_requested(); }

 private:
  SharedProgress* progress_;
  std::size_t part_;
  double offset_, share_;
};

}  // namespace lanescape
