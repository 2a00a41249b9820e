#include "path/path_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {
namespace {

// The bin of a value in units of the bin's width, (0, 1], (1, 2], ... Steps of one and the same length for c particles have n = c
// but for rounding, so that n and 3 N/n may lie on an edge.
std::size_t bin_of(double value, std::size_t bins) {
  const auto bin = static_cast<std::size_t>(std::max(0.0, std::ceil(value - 1e-6) - 1.0));
  return std::min(bin, bins - 1);
}

}  // namespace

PathStatistics::PathStatistics(std::size_t slots, std::size_t particles, Stepping stepping)
    : particles_(static_cast<double>(particles)),
      stepping_(stepping),
      participation_(particles, 0.0),
      alpha2_(3 * particles, 0.0),  // 0.6 N over the width of a bin
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
  participation_[bin_of(last_participation_, participation_.size())] += weight;
  alpha2_[bin_of(0.6 * particles_ / (last_participation_ * alpha2_width), alpha2_.size())] += weight;
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
