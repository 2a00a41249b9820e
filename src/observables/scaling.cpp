#include "observables/scaling.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "observables/fits/line.hpp"

namespace lanescape {

Scaling scale(std::span<const ScalingPoint> points) {
  if (points.empty()) throw_bad_input("no state has both D and (DeltaR/g)^2");
  std::vector<double> x, y, constants, logarithms;
  for (const ScalingPoint& point : points) {
    if (!(point.diffusion > 0.0 && point.ratio_squared > 0.0)) throw_bad_input("D and (DeltaR/g)^2 must be above 0");
    x.push_back(std::log(point.ratio_squared));
    y.push_back(std::log(point.diffusion));
    constants.push_back(point.diffusion / point.ratio_squared);
    logarithms.push_back(y.back() - x.back());
  }
  Scaling scaling{estimate_mean(constants), std::nullopt, std::nullopt};
  if (points.size() < 2) return scaling;
  scaling.spread = estimate_mean(logarithms).error.value() * std::sqrt(static_cast<double>(points.size()));
  const auto [least, most] = std::minmax_element(x.begin(), x.end());
  if (*most > *least) scaling.slope = fit_line(x, y).slope;
  return scaling;
}

}  // namespace lanescape
