#pragma once

#include <cstddef>
#include <vector>

#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "core/step_histogram.hpp"
#include "dispatch/vector_algebra.hpp"
#include "stepper/stepper.hpp"

namespace lanescape {

// Sums along a path, in constant memory.
class PathStatistics {
 public:
  // n/N has a bin for each whole n, of width 1 up to n itself. alpha_2 + 1 = 0.6 N/n has bins of this width, upper edges included,
  // up to 0.6 N at n = 1: steps of n = 2, 3 and 4 particles have a bin each, at any N.
  static constexpr double alpha2_width = 0.2;

  PathStatistics(std::size_t slots, std::size_t particles, Stepping stepping = Stepping::faithful);

  // Returns the length of the step [sigma].
  double add_step(const VectorAlgebra& algebra, const AlignedArray& from, const AlignedArray& to);
  // The last displacement, to the goal: it has length but is not a step.
  void add_hop(const VectorAlgebra& algebra, const AlignedArray& from, const AlignedArray& to);

  double length() const { return length_; }
  // Mean over displacements, weighted with their length, of n = (sum dr^2)^2 / sum dr^4 ([G] Eq. 4.17).
  double participation_number() const { return length_ > 0.0 ? weighted_participation_ / length_ : 0.0; }
  // Of the last displacement.
  double last_participation_number() const { return last_participation_; }
  // How many steps had n/N, or alpha_2 = 0.6 N/n - 1, in each bin; of adaptive steps the sum of their lengths, so that both kinds
  // of stepping give the same distribution.
  const std::vector<double>& participation_histogram() const { return participation_; }
  const std::vector<double>& alpha2_histogram() const { return alpha2_; }
  // Both, named: participation_ratio n/N and alpha_2.
  std::vector<StepHistogram> histograms() const;
  // g_j = sum |dr_j| of each slot.
  const AlignedArray& particle_lengths() const { return particle_lengths_; }

  void exchange(Archive& archive);

 private:
  double add_displacement(const VectorAlgebra& algebra, const AlignedArray& from, const AlignedArray& to);

  double particles_;
  Stepping stepping_;
  double length_ = 0.0, weighted_participation_ = 0.0, last_participation_ = 0.0;
  std::vector<double> participation_, alpha2_;
  AlignedArray particle_lengths_;
};

}  // namespace lanescape
