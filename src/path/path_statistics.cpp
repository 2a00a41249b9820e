#include "path/path_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {

PathStatistics::PathStatistics(std::size_t slots, std::size_t particles, Stepping stepping)
    : particles_(static_cast<double>(particles)),
      stepping_(stepping),
      participation_(particles, 0.0),
      alpha2_(alpha2_bins, 0.0),
      particle_lengths_(slots, 0.0) {}

double PathStatistics::add_displacement(const VectorAlgebra& algebra, const AlignedArray& from, const AlignedArray& to) {
  const kernels::DisplacementMoments moments = algebra.displacement_moments(from, to);
  if (!(moments.second > 0.0)) return 0.0;
  const double step = std::sqrt(moments.second);
  last_participation_ = moments.second * moments.second / moments.fourth;
  length_ += step;
  weighted_participation_ += step * last_participation_;
  algebra.add_particle_lengths(particle_lengths_, from, to);
  return step;
}

double PathStatistics::add_step(const VectorAlgebra& algebra, const AlignedArray& from, const AlignedArray& to) {
  const double length = add_displacement(algebra, from, to);
  const double weight = stepping_ == Stepping::adaptive ? length : 1.0;
  const double alpha2 = 0.6 * particles_ / last_participation_ - 1.0;
  // Steps of one and the same length for c particles have n = c but for rounding.
  const auto bin = static_cast<std::size_t>(std::max(0.0, std::ceil(last_participation_ - 1e-6) - 1.0));
  participation_[std::min(bin, participation_.size() - 1)] += weight;
  alpha2_[std::min(static_cast<std::size_t>((alpha2 + 1.0) / alpha2_width), alpha2_bins - 1)] += weight;
  return length;
}

void PathStatistics::add_hop(const VectorAlgebra& algebra, const AlignedArray& from, const AlignedArray& to) {
  add_displacement(algebra, from, to);
}

std::vector<StepHistogram> PathStatistics::histograms() const {
  const double share = 1.0 / static_cast<double>(participation_.size());
  return {{"participation_ratio", share, share, participation_}, {"alpha_2", alpha2_width - 1.0, alpha2_width, alpha2_}};
}

void PathStatistics::exchange(Archive& archive) {
  archive.field("length", length_);
  archive.field("weighted_participation", weighted_participation_);
  archive.field("last_participation", last_participation_);
  archive.field("participation_histogram", participation_);
  archive.field("alpha2_histogram", alpha2_);
  archive.field("particle_lengths", particle_lengths_);
}

}  // namespace lanescape
