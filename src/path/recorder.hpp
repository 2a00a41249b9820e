#pragma once

#include <cstddef>
#include <vector>

#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "core/decimated_trace.hpp"

namespace lanescape {

// Records a path for figures, in bounded memory: configurations equally spaced in the distance to the goal, and a trace of numbers
// over steps.
class PathRecorder {
 public:
  // Rows of the trace: direct counts direct steps from the start of the path, of adaptive ones their length; participation is the
  // step's own n.
  enum Column : std::size_t { step, length, distance, energy, direct, participation, columns };
  static constexpr std::size_t trace_rows = 4096;

  // `frames` configurations besides the two ends.
  PathRecorder(std::size_t frames, double whole_distance) : frames_wanted_(frames), whole_distance_(whole_distance) {}

  // Keeps the configuration if the path has come near enough to the goal for the next one.
  void keep_frame(const AlignedArray& position, double distance);
  DecimatedTrace& trace() { return trace_; }
  const DecimatedTrace& trace() const { return trace_; }
  const std::vector<AlignedArray>& frames() const { return frames_; }

  void exchange(Archive& archive);

 private:
  std::size_t frames_wanted_;
  double whole_distance_;
  std::vector<AlignedArray> frames_;
  DecimatedTrace trace_{columns, trace_rows};
};

}  // namespace lanescape
