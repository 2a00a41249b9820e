#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "neighbour/kept_array.hpp"

namespace lanescape {

// One axis of a box, periodic or open, and where coordinates lie along it: periodic ones wrapped, open ones from the lowest. Where
// that is asked for, gaps between coordinates that are wider than `least` are narrowed to it, so that a grid follows the particles
// and single precision resolves them. Coordinates nearer to each other than `least` keep their separation, and another coordinate
// keeps that from those nearer than half of it; it lies at least so far from all others. Memory is kept.
class FoldedAxis {
 public:
  struct Place {
    double inside;  // 0 to length(); beyond it for a coordinate off the ends of an open axis
    double boxes;   // whole boxes added to the coordinate; 0 along an open axis
  };

  // `coordinates`: every third number from the first one. `edge` and `origin` of the box; an open axis has no use for them.
  void fit(std::span<const double> coordinates, bool periodic, double edge, double origin);
  // Narrows the gaps between the coordinates of the last fit. O(N log N).
  void narrow_gaps(std::span<const double> coordinates, double least);

  Place place(double x) const;
  bool is_periodic() const { return periodic_; }
  double length() const { return length_; }
  // A bound on what rounding changes of separations along the axis, of coordinates up to this magnitude.
  double rounding(double greatest) const;

 private:
  struct Stretch {
    double first, last;  // coordinates without a wide gap between them
    double begin;        // where the first one lies
  };
  Place wrapped(double x) const;
  const Stretch& nearest(Place& place) const;

  bool periodic_ = true;
  double edge_ = 0.0, origin_ = 0.0, length_ = 0.0, least_ = 0.0;
  std::size_t stretches_ = 0;  // 0: no gap is narrowed
  KeptArray<double> sorted_;
  KeptArray<Stretch> stretch_;
};

}  // namespace lanescape
