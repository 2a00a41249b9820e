#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/aligned_array.hpp"
#include "views/state.hpp"

namespace lanescape {

// The cubic spline with two continuous derivatives through values at knots of equal spacing. At an end either a slope is given or
// the second derivative is zero.
class UniformSpline {
 public:
  // At least two values.
  UniformSpline(double first_knot, double spacing, std::span<const double> values, std::optional<double> slope_at_start,
                std::optional<double> slope_at_end);

  double first_knot() const { return first_knot_; }
  double spacing() const { return spacing_; }
  std::size_t intervals() const { return pieces_.size(); }

  double value(double x) const;
  double slope(double x) const;
  // {b, c, d, a}, the record of kernels::CubicSpline.
  const std::array<double, kernels::point_width>& piece(std::size_t interval) const { return pieces_[interval]; }
  // Adds a straight line before the first knot, in as many intervals as reach `x` or below.
  void extend_down_to(double x);

 private:
  struct Place {
    std::size_t interval;
    double s;
  };
  Place place(double x) const;

  double first_knot_, spacing_;
  std::vector<std::array<double, kernels::point_width>> pieces_;
};

}  // namespace lanescape
