#include "observables/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace lanescape {

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

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace lanescape
