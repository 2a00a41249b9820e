#include "neighbour/closed_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lanescape {
namespace {

// The lowest and the highest coordinate in each of N intervals of equal width; empty intervals have lowest > highest.
struct Intervals {
  std::vector<double> lowest, highest;
  std::vector<std::size_t> of;  // the interval of each coordinate

  Intervals(const std::vector<double>& x, double length)
      : lowest(x.size(), std::numeric_limits<double>::infinity()), highest(x.size(), -lowest.front()), of(x.size()) {
    const double count = static_cast<double>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const std::size_t k = of[i] = std::min(static_cast<std::size_t>(x[i] / length * count), x.size() - 1);
      lowest[k] = std::min(lowest[k], x[i]);
      highest[k] = std::max(highest[k], x[i]);
    }
  }
  bool is_empty(std::size_t k) const { return lowest[k] > highest[k]; }
};

// One pass: gaps inside an interval remain for the next.
void close_once(std::vector<double>& x, double least, ClosedGaps& closed) {
  const Intervals intervals(x, closed.length);
  const double first = *std::min_element(intervals.lowest.begin(), intervals.lowest.end());
  const double last = *std::max_element(intervals.highest.begin(), intervals.highest.end());
  const bool across_faces = closed.length - (last - first) > least;
  std::vector<double> shift(x.size(), 0.0);
  double removed = across_faces ? first : 0.0, before = first;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (intervals.is_empty(k)) continue;
    const double gap = intervals.lowest[k] - before;
    if (gap > least) removed += gap - least;
    shift[k] = -removed;
    before = intervals.highest[k];
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = std::max(0.0, x[i] + shift[intervals.of[i]]);
    closed.shifts[i] += shift[intervals.of[i]];
  }
  closed.length = across_faces ? (last - removed) + least : closed.length - removed;
}

// From coordinates that were shifted into [0, length].
void close_all(std::vector<double>& x, double least, ClosedGaps& closed) {
  double before = closed.length;
  do {
    before = closed.length;
    close_once(x, least, closed);
  } while (closed.length < 0.5 * before);
}

ClosedGaps not_closed(double length, std::size_t count) {
  return {length, std::vector<double>(count, 0.0), std::vector<double>(count, 0.0)};
}

}  // namespace

ClosedGaps close_gaps(std::vector<double> x, double length, double least) {
  ClosedGaps closed = not_closed(length, x.size());
  if (x.empty()) return closed;
  // Coordinates that span less than the box are not wrapped: at the far face of a huge one a small number would lose its digits.
  const auto [lowest, highest] = std::minmax_element(x.begin(), x.end());
  const double origin = *lowest;
  const bool wrap = !(*highest - origin < length);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (wrap) closed.boxes[i] = -std::floor(x[i] / length);
    closed.shifts[i] = wrap ? closed.boxes[i] * length : -origin;
    x[i] = std::clamp(x[i] + closed.shifts[i], 0.0, length);
  }
  close_all(x, least, closed);
  return closed;
}

// As in a box whose faces are `least` apart from the nearest particles.
ClosedGaps close_open_gaps(std::vector<double> x, double least) {
  ClosedGaps closed = not_closed(least, x.size());
  if (x.empty()) return closed;
  const auto [lowest, highest] = std::minmax_element(x.begin(), x.end());
  const double origin = *lowest;
  closed.length += *highest - origin;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += closed.shifts[i] = -origin;
  close_all(x, least, closed);
  return closed;
}

}  // namespace lanescape
