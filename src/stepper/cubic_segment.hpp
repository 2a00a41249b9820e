#pragma once

namespace lanescape {

// V along a straight segment x = 0 ... 1, estimated by the cubic through its values and slopes at both ends.
struct CubicSegment {
  double first, last;              // V at the ends
  double first_slope, last_slope;  // dV/dx there

  double at(double x) const;
  struct Maximum {
    double x, value;
  };
  Maximum maximum() const;
  // Where the cubic crosses `level`, which lies between `first` and `last`.
  double crossing(double level) const;
};

}  // namespace lanescape
