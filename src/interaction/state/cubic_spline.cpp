#include "interaction/state/cubic_spline.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {
namespace {

// Slopes at the knots, per interval, of the spline whose second derivative is continuous: a tridiagonal system, solved by
// elimination.
std::vector<double> knot_slopes(std::span<const double> y, std::optional<double> start, std::optional<double> end) {
  const std::size_t n = y.size();
  std::vector<double> diagonal(n, 4.0), above(n, 1.0), slopes(n);
  for (std::size_t k = 1; k + 1 < n; ++k) slopes[k] = 3.0 * (y[k + 1] - y[k - 1]);
  diagonal[0] = start ? 1.0 : 2.0;
  above[0] = start ? 0.0 : 1.0;
  slopes[0] = start ? *start : 3.0 * (y[1] - y[0]);
  diagonal[n - 1] = end ? 1.0 : 2.0;
  slopes[n - 1] = end ? *end : 3.0 * (y[n - 1] - y[n - 2]);
  for (std::size_t k = 1; k < n; ++k) {
    const double below = k + 1 == n && end ? 0.0 : 1.0, factor = below / diagonal[k - 1];
    diagonal[k] -= factor * above[k - 1];
    slopes[k] -= factor * slopes[k - 1];
  }
  slopes[n - 1] /= diagonal[n - 1];
  for (std::size_t k = n - 1; k-- > 0;) slopes[k] = (slopes[k] - above[k] * slopes[k + 1]) / diagonal[k];
  return slopes;
}

}  // namespace

UniformSpline::UniformSpline(double first_knot, double spacing, std::span<const double> values,
                             std::optional<double> slope_at_start, std::optional<double> slope_at_end)
    : first_knot_(first_knot), spacing_(spacing) {
  const auto per_interval = [&](std::optional<double> slope) { return slope ? std::optional(*slope * spacing) : std::nullopt; };
  const std::vector<double> m = knot_slopes(values, per_interval(slope_at_start), per_interval(slope_at_end));
  for (std::size_t k = 0; k + 1 < values.size(); ++k) {
    const double rise = values[k + 1] - values[k];
    pieces_.push_back({m[k], 3.0 * rise - 2.0 * m[k] - m[k + 1], m[k] + m[k + 1] - 2.0 * rise, values[k]});
  }
}

UniformSpline::Place UniformSpline::place(double x) const {
  const double t = (x - first_knot_) / spacing_;
  const double interval = std::clamp(std::floor(t), 0.0, static_cast<double>(pieces_.size() - 1));
  return {static_cast<std::size_t>(interval), t - interval};
}

double UniformSpline::value(double x) const {
  const auto [interval, s] = place(x);
  const auto& [b, c, d, a] = pieces_[interval];
  return a + s * (b + s * (c + s * d));
}

double UniformSpline::slope(double x) const {
  const auto [interval, s] = place(x);
  const auto& [b, c, d, a] = pieces_[interval];
  return (b + s * (2.0 * c + s * 3.0 * d)) / spacing_;
}

void UniformSpline::extend_down_to(double x) {
  if (x >= first_knot_) return;
  const auto more = static_cast<std::size_t>(std::ceil((first_knot_ - x) / spacing_));
  const double slope = pieces_.front()[0], value = pieces_.front()[3];
  std::vector<std::array<double, kernels::point_width>> line(more);
  for (std::size_t k = 0; k < more; ++k) line[k] = {slope, 0.0, 0.0, value - static_cast<double>(more - k) * slope};
  pieces_.insert(pieces_.begin(), line.begin(), line.end());
  first_knot_ -= static_cast<double>(more) * spacing_;
}

}  // namespace lanescape
