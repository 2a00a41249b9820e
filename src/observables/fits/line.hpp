#pragma once

#include <span>

#include "observables/statistics.hpp"

namespace lanescape {

// The straight line y = slope x + intercept with the least sum of squares, each square over that of the value's error where there
// are errors. Errors follow from the residuals, and need three points; with errors of the values from those alone.
struct Line {
  Estimate slope, intercept;
  double squares = 0.0;  // the sum
};
// Throws Error(bad_input) for fewer than two points, or all at one x.
Line fit_line(std::span<const double> x, std::span<const double> y, std::span<const double> errors = {});

}  // namespace lanescape
