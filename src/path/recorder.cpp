#include "path/recorder.hpp"

#include <fmt/format.h>

namespace lanescape {

void PathRecorder::keep_frame(const AlignedArray& position, double distance) {
  if (frames_.size() >= frames_wanted_) return;
  const double covered = static_cast<double>(frames_.size() + 1) / static_cast<double>(frames_wanted_ + 1);
  if (distance <= whole_distance_ * (1.0 - covered)) frames_.push_back(position);
}

void PathRecorder::exchange(Archive& archive) {
  std::uint64_t count = frames_.size();
  archive.field("frame_count", count);
  frames_.resize(count);
  for (std::size_t k = 0; k < frames_.size(); ++k) archive.field(fmt::format("frame{:05}", k + 1), frames_[k]);
  trace_.exchange(archive);
}

}  // namespace lanescape
