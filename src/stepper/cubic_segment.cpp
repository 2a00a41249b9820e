#include "stepper/cubic_segment.hpp"

#include <cmath>

namespace lanescape {

double CubicSegment::at(double x) const {
  const double rise = last - first;
  const double square = 3.0 * rise - 2.0 * first_slope - last_slope, cube = first_slope + last_slope - 2.0 * rise;
  return first + x * (first_slope + x * (square + x * cube));
}

CubicSegment::Maximum CubicSegment::maximum() const {
  Maximum best = first > last ? Maximum{0.0, first} : Maximum{1.0, last};
  const auto consider = [&](double x) {
    if (x > 0.0 && x < 1.0 && at(x) > best.value) best = {x, at(x)};
  };
  // Roots of first_slope + 2 square x + 3 cube x^2, in the form that cancels nothing.
  const double rise = last - first;
  const double square = 3.0 * rise - 2.0 * first_slope - last_slope, cube = first_slope + last_slope - 2.0 * rise;
  const double discriminant = square * square - 3.0 * cube * first_slope;
  if (!(discriminant > 0.0)) return best;
  const double sum = -(square + std::copysign(std::sqrt(discriminant), square));
  if (cube != 0.0) consider(sum / (3.0 * cube));
  if (sum != 0.0) consider(first_slope / sum);
  return best;
}

double CubicSegment::crossing(double level) const {
  double below = 0.0, above = 1.0;
  const bool rises = last > first;
  while (above - below > 1e-6) {
    const double middle = 0.5 * (below + above);
    ((at(middle) < level) == rises ? below : above) = middle;
  }
  return below;
}

}  // namespace lanescape
