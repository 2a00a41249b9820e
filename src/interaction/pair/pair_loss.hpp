#pragma once

#include <vector>

#include "configuration/pair_model.hpp"

namespace lanescape {

// By how much the truncated potential of one pair of species can fall short of its tangent, as a step function of r^2. An entry
// holds for all separations within `reach` of those of its step.
class PairLoss {
 public:
  struct Entry {
    double curvature = 0.0;  // largest of -phi'', -phi'/r and 0 [epsilon/sigma^2]
    double kink = 0.0;       // jump of the slope at the cutoff, where it is in reach [epsilon/sigma]
    double energy = 0.0;     // the terms of phi, taken absolute [epsilon]
    double slope = 0.0;      // the same of phi' [epsilon/sigma]

    Entry& operator+=(const Entry& other) {
      curvature += other.curvature;
      kink += other.kink;
      energy += other.energy;
      slope += other.slope;
      return *this;
    }
  };

  // Whether there is one. A potential that jumps at its cutoff has none: pairs that are within reach of the cutoff can all
  // cross it in one segment as far as a pass knows, each for about 0.016 epsilon.
  static bool exists(const PairModel& model);
  // A pair's separation changes by at most `change` in the longest segment.
  PairLoss(const PairModel& model, const PairNumbers& numbers, double reach, double change);

  double range_squared() const { return range_squared_; }  // no loss from here on [sigma^2]
  const Entry& at(double r2) const { return entries_[static_cast<std::size_t>(r2 * steps_per_area_)]; }
  // Step k holds r^2 from k / steps_per_area(); the one after the last is empty.
  static constexpr std::size_t steps = 512;
  double steps_per_area() const { return steps_per_area_; }
  const Entry* entries() const { return entries_.data(); }
  // Largest |phi'| from r to the cutoff, which the nearest image changes the sign of [epsilon/sigma].
  double steepest_beyond(double r) const;

 private:
  void find_pieces(const PairModel& model, const PairNumbers& numbers);
  // The largest of each number between two separations.
  Entry largest(double from, double to) const;

  double cutoff_, change_, range_squared_, steps_per_area_;
  double first_, piece_length_;  // of pieces_ [sigma]
  std::vector<Entry> pieces_, entries_;
};

}  // namespace lanescape
