#pragma once

#include <cstddef>
#include <cstdint>
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

struct Interval {
  double low, high;
};

struct BootstrapOptions {
  std::size_t resamples = 2000;
  std::uint64_t seed = 1;
  int threads = 1;
  double coverage = 0.95;
};

// Percentile intervals (Efron, doi 10.1214/aos/1176344552) of several functions of `count` independent rows. `of(rows, results)`
// sets each result to its function of a sample with replacement, given as row numbers; NaN where the sample has no value. The draws
// depend on seed and count alone. No interval for fewer than two rows, or where no sample has a value.
using SampleFunctions = std::function<void(std::span<const std::uint32_t> rows, std::span<double> results)>;
std::vector<std::optional<Interval>> bootstrap_intervals(std::size_t count, std::size_t functions, const SampleFunctions& of,
                                                         const BootstrapOptions& options);

// The mean of values with weights, such as that of runs of several lengths. Its error follows from the errors of the values if all
// have one, else from their scatter, which needs two values.
struct WeightedValue {
  double value;
  std::optional<double> error;
  double weight;
};
Estimate weighted_mean(std::span<const WeightedValue> values);

// The upper of the two middle values of an even number; 0 if there are no values.
double median(std::vector<double> values);

}  // namespace lanescape
