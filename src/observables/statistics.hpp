#pragma once

#include <optional>
#include <span>
#include <vector>

namespace lanescape {

// A mean of independent values and its standard error, which needs at least two values.
struct Estimate {
  double value = 0.0;
  std::optional<double> error;
};

// The mean is 0 if there are no values.
Estimate estimate_mean(std::span<const double> values);
// The upper of the two middle values of an even number; 0 if there are no values.
double median(std::vector<double> values);

}  // namespace lanescape
