#include "path/path_statistics.hpp"

#include <cmath>

namespace lanescape {

void PathStatistics::add(const kernels::DisplacementMoments& moments) {
  if (!(moments.second > 0.0)) return;
  const double step = std::sqrt(moments.second);
  last_participation_ = moments.second * moments.second / moments.fourth;
  length_ += step;
  weighted_participation_ += step * last_participation_;
}

void PathStatistics::exchange(Archive& archive) {
  archive.field("length", length_);
  archive.field("weighted_participation", weighted_participation_);
  archive.field("last_participation", last_participation_);
}

}  // namespace lanescape
