#pragma once

#include <filesystem>
#include <string>

#include "core/archive.hpp"
#include "core/run_monitor.hpp"
#include "core/stopwatch.hpp"

namespace lanescape {

// Where a run keeps its state, and whether it starts from a state that is there.
struct CheckpointOptions {
  std::filesystem::path folder;  // empty: no state is kept
  bool resume = false;

  bool enabled() const { return !folder.empty(); }
};

// Long work in chunks, as run_to_end() sees it.
class ResumableWork {
 public:
  virtual ~ResumableWork() = default;

  virtual bool finished() const = 0;
  // Does one chunk, some milliseconds if possible, and reports progress. Longer chunks ask the monitor themselves; if it says stop,
  // they leave the state as it was before the chunk.
  virtual void advance(RunMonitor& monitor) = 0;
  // The whole state. Work that reads it continues with the same bits.
  virtual void exchange(Archive& archive) = 0;
  // Whether the state at the end of this chunk can be saved.
  virtual bool saveable() const { return true; }
  // Whether it is time to save it.
  virtual bool save_due() const { return true; }

  const Stopwatch& clock() const { return clock_; }

 protected:
  Stopwatch clock_;

 private:
  friend bool run_to_end(ResumableWork&, const std::string&, const CheckpointOptions&, RunMonitor&);
};

// Does the work until it is finished, or until the monitor asks to stop: true if it was interrupted. Reads the state of an earlier
// run from `file` in the checkpoint folder, saves it there when due, at an interruption and at the end.
bool run_to_end(ResumableWork& work, const std::string& file, const CheckpointOptions& checkpoint, RunMonitor& monitor);

}  // namespace lanescape
