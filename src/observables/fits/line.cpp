#include "observables/fits/line.hpp"

#include <cmath>

#include "core/error.hpp"

namespace lanescape {

Line fit_line(std::span<const double> x, std::span<const double> y, std::span<const double> errors) {
  const auto weight = [&](std::size_t k) { return errors.empty() ? 1.0 : 1.0 / (errors[k] * errors[k]); };
  double w = 0.0, wx = 0.0, wy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    w += weight(k);
    wx += weight(k) * x[k];
    wy += weight(k) * y[k];
  }
  const double mean_x = wx / w, mean_y = wy / w;
  double xx = 0.0, xy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += weight(k) * (x[k] - mean_x) * (x[k] - mean_x);
    xy += weight(k) * (x[k] - mean_x) * (y[k] - mean_y);
  }
  if (x.size() < 2 || !(xx > 0.0)) throw_bad_input("a line needs points at two states or more");
  Line line;
  line.slope.value = xy / xx;
  line.intercept.value = mean_y - line.slope.value * mean_x;
  for (std::size_t k = 0; k < x.size(); ++k)
    line.squares += weight(k) * std::pow(y[k] - line.slope.value * x[k] - line.intercept.value, 2);
  if (errors.empty() && x.size() < 3) return line;
  const double variance = errors.empty() ? line.squares / static_cast<double>(x.size() - 2) : 1.0;
  line.slope.error = std::sqrt(variance / xx);
  line.intercept.error = std::sqrt(variance * (1.0 / w + mean_x * mean_x / xx));
  return line;
}

}  // namespace lanescape
