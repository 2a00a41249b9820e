#include "interaction/pair/pair_loss.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace lanescape {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();
// Covers rounding in the tables.
constexpr double grown = 1.0 + 1e-9;

struct Interval {
  double low, high;

  Interval operator+(const Interval& other) const { return {low + other.low, high + other.high}; }
  double magnitude() const { return std::max(std::abs(low), std::abs(high)); }
};

// r^n; faster than std::pow.
double whole_power(double r, int n) {
  double square = n < 0 ? 1.0 / r : r, product = 1.0;
  for (int k = std::abs(n); k > 0; k /= 2, square *= square)
    if (k % 2 == 1) product *= square;
  return product;
}

// factor r^n for r from a to b: monotonic.
Interval power(double factor, int n, double a, double b) {
  const double x = factor * whole_power(a, n), y = factor * whole_power(b, n);
  return {std::min(x, y), std::max(x, y)};
}

// Interval arithmetic with the terms of 4 epsilon [(sigma/r)^12 - (sigma/r)^6] + c0 + c1 r + c2 r^2 + c4 r^4.
PairLoss::Entry piece(const PairNumbers& p, const PairCorrection& c, double a, double b) {
  const double x = a / p.sigma, y = b / p.sigma, e = 4.0 * p.epsilon;
  const Interval value[] = {power(e, -12, x, y), power(-e, -6, x, y)};
  const Interval slope = power(-12.0 * e / p.sigma, -13, x, y) + power(6.0 * e / p.sigma, -7, x, y) + power(c.c1, 0, a, b) +
                         power(2.0 * c.c2, 1, a, b) + power(4.0 * c.c4, 3, a, b);
  const double scale = e / (p.sigma * p.sigma);
  const Interval second =
      power(156.0 * scale, -14, x, y) + power(-42.0 * scale, -8, x, y) + power(2.0 * c.c2, 0, a, b) + power(12.0 * c.c4, 2, a, b);
  const Interval over_r = power(-12.0 * scale, -14, x, y) + power(6.0 * scale, -8, x, y) + power(c.c1, -1, a, b) +
                          power(2.0 * c.c2, 0, a, b) + power(4.0 * c.c4, 2, a, b);
  PairLoss::Entry entry;
  entry.curvature = grown * std::max({-second.low, -over_r.low, 0.0});
  entry.kink = grown * slope.magnitude();
  entry.energy = value[0].magnitude() + value[1].magnitude() + std::abs(c.c0) + std::abs(c.c1) * b + std::abs(c.c2) * b * b +
                 std::abs(c.c4) * b * b * b * b;
  entry.slope = e / p.sigma * (12.0 * whole_power(x, -13) + 6.0 * whole_power(x, -7)) + std::abs(c.c1) + std::abs(2.0 * c.c2) * b +
                std::abs(4.0 * c.c4) * b * b * b;
  return entry;
}

}  // namespace

bool PairLoss::exists(const PairModel& model) {
  return model.form == &lennard_jones_form() && model.truncation != Truncation::plain && model.truncation != Truncation::tail;
}

PairLoss::PairLoss(const PairModel& model, const PairNumbers& numbers, double reach, double change)
    : cutoff_(model.cutoff * numbers.sigma), change_(change), first_(0.4 * numbers.sigma), piece_length_(reach / 32.0) {
  find_pieces(model, numbers);
  const double range = cutoff_ + change + reach;
  range_squared_ = range * range;
  steps_per_area_ = steps / range_squared_;
  const double kink = largest(cutoff_ - change, cutoff_ + change).kink;
  entries_.resize(steps + 1);
  for (std::size_t k = 0; k < steps; ++k) {
    // A step more at both ends covers rounding in at().
    const double low = std::sqrt(std::max(0.0, static_cast<double>(k) - 1e-6) / steps_per_area_) - reach;
    const double high = std::sqrt((static_cast<double>(k) + 1.0 + 1e-6) / steps_per_area_) + reach;
    entries_[k] = largest(low, std::min(high, cutoff_ + change));
    entries_[k].kink = high >= cutoff_ - change ? kink : 0.0;
  }
}

void PairLoss::find_pieces(const PairModel& model, const PairNumbers& numbers) {
  const PairCorrection correction = model.correction(numbers);
  const double end = cutoff_ + 2.0 * change_;
  for (std::size_t k = 0; first_ + static_cast<double>(k) * piece_length_ < end; ++k) {
    const double a = first_ + static_cast<double>(k) * piece_length_;
    pieces_.push_back(piece(numbers, correction, a, a + piece_length_));
  }
}

PairLoss::Entry PairLoss::largest(double from, double to) const {
  if (from < first_) return {unknown, unknown, unknown, unknown};
  Entry most;
  const auto begin = static_cast<std::size_t>(std::max(0.0, (from - first_) / piece_length_ - 1e-6));
  const auto end = static_cast<std::size_t>(std::max(0.0, (to - first_) / piece_length_ + 1e-6)) + 1;
  for (std::size_t k = begin; k < std::min(end, pieces_.size()); ++k) {
    most.curvature = std::max(most.curvature, pieces_[k].curvature);
    most.kink = std::max(most.kink, pieces_[k].kink);
    most.energy = std::max(most.energy, pieces_[k].energy);
    most.slope = std::max(most.slope, pieces_[k].slope);
  }
  return most;
}

double PairLoss::steepest_beyond(double r) const { return r > cutoff_ + change_ ? 0.0 : largest(r, cutoff_ + change_).kink; }

}  // namespace lanescape
