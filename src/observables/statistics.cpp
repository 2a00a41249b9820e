#include "observables/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "core/parallel.hpp"
#include "core/random.hpp"

namespace lanescape {
namespace {

// Between the values whose ranks are next to it.
double quantile(const std::vector<double>& sorted, double share) {
  const double rank = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

std::optional<Interval> percentile_interval(std::vector<double> values, double coverage) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  return Interval{quantile(values, 0.5 - 0.5 * coverage), quantile(values, 0.5 + 0.5 * coverage)};
}

}  // namespace

Estimate estimate_mean(std::span<const double> values) {
  if (values.empty()) return {};
  const double n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() == 1) return {mean, std::nullopt};
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (n * (n - 1.0)))};
}

Estimate jackknife(std::size_t count, const std::function<double(std::size_t)>& without) {
  Estimate result{without(count), std::nullopt};
  if (count < 2) return result;
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k) values[k] = without(k);
  // The values are (count - 1) times closer together than independent ones.
  result.error = static_cast<double>(count - 1) * estimate_mean(values).error.value();
  return result;
}

std::vector<std::optional<Interval>> bootstrap_intervals(std::size_t count, std::size_t functions, const SampleFunctions& of,
                                                         const BootstrapOptions& options) {
  std::vector<std::optional<Interval>> intervals(functions);
  if (count < 2 || options.resamples == 0) return intervals;
  std::vector<double> results(options.resamples * functions, std::numeric_limits<double>::quiet_NaN());
  const CounterRandom random(options.seed, RandomStream::bootstrap);
  const auto resample = [&](std::size_t number) {
    std::vector<std::uint32_t> rows(count);
    for (std::size_t k = 0; k < count; ++k)
      rows[k] = random.below(static_cast<std::uint32_t>(count), number, static_cast<std::uint32_t>(k));
    of(rows, std::span(results).subspan(number * functions, functions));
  };
  for_each_block(options.threads, options.resamples, resample);
  for (std::size_t f = 0; f < functions; ++f) {
    std::vector<double> values(options.resamples);
    for (std::size_t r = 0; r < options.resamples; ++r) values[r] = results[r * functions + f];
    intervals[f] = percentile_interval(std::move(values), options.coverage);
  }
  return intervals;
}

Estimate weighted_mean(std::span<const WeightedValue> values) {
  if (values.size() == 1) return {values[0].value, values[0].error};
  double weight = 0.0, sum = 0.0, squared_errors = 0.0, squares = 0.0;
  bool have_errors = !values.empty();
  for (const WeightedValue& v : values) {
    weight += v.weight;
    sum += v.weight * v.value;
    have_errors = have_errors && v.error.has_value();
    squared_errors += std::pow(v.weight * v.error.value_or(0.0), 2);
  }
  if (!(weight > 0.0)) return {};
  const double mean = sum / weight;
  if (have_errors) return {mean, std::sqrt(squared_errors) / weight};
  for (const WeightedValue& v : values) squares += v.weight * (v.value - mean) * (v.value - mean);
  return {mean, std::sqrt(squares / (weight * static_cast<double>(values.size() - 1)))};
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace lanescape
