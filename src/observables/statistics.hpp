#pragma once

#include <cstddef>
#include <functional>
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
// A function of means over `count` independent values. `without(k)` is the function without value k, and without(count) that of
// all, which is the result. Its error is the jackknife's (doi 10.1214/aos/1176345462): the standard error where the function is
// linear.
Estimate jackknife(std::size_t count, const std::function<double(std::size_t)>& without);
// The upper of the two middle values of an even number; 0 if there are no values.
double median(std::vector<double> values);

}  // namespace lanescape
