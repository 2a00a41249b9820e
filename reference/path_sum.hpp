#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

/// Algebra of 3N-vectors and sums along a path, for the reference path finders.
namespace lanescape::reference {

using Point = std::vector<double>;

inline double dot(const Point& a, const Point& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// a + factor * b
inline Point combine(const Point& a, double factor, const Point& b) {
  Point result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] + factor * b[i];
  return result;
}

inline double distance(const Point& a, const Point& b) {
  const Point d = combine(b, -1.0, a);
  return std::sqrt(dot(d, d));
}

/// (sum_j dr_j^2)^2 / sum_j dr_j^4 over particles j, [G] Eq. 4.17. Give it a unit vector, so that the powers do not underflow.
inline double participation_number(const Point& step) {
  double second = 0.0;
  double fourth = 0.0;
  for (std::size_t j = 0; j < step.size(); j += 3) {
    const double squared = step[j] * step[j] + step[j + 1] * step[j + 1] + step[j + 2] * step[j + 2];
    second += squared;
    fourth += squared * squared;
  }
  return second * second / fourth;
}

/// Length of a path, and its participation number: the mean over steps, weighted with their lengths.
class PathSum {
 public:
  void add(const Point& step) {
    const double length = std::sqrt(dot(step, step));
    if (length == 0.0) return;
    length_ += length;
    weighted_participation_ += length * participation_number(combine(Point(step.size(), 0.0), 1.0 / length, step));
  }
  double length() const { return length_; }
  double participation() const { return length_ > 0.0 ? weighted_participation_ / length_ : 0.0; }

 private:
  double length_ = 0.0;
  double weighted_participation_ = 0.0;
};

}  // namespace lanescape::reference
