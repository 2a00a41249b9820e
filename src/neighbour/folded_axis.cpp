#include "neighbour/folded_axis.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {

void FoldedAxis::fit(std::span<const double> coordinates, bool periodic, double edge, double origin) {
  periodic_ = periodic;
  edge_ = edge;
  origin_ = origin;
  length_ = edge;
  stretches_ = 0;
  if (periodic) return;
  double lowest = coordinates.empty() ? 0.0 : coordinates[0], highest = lowest;
  for (std::size_t k = 0; k < coordinates.size(); k += 3) {
    lowest = std::min(lowest, coordinates[k]);
    highest = std::max(highest, coordinates[k]);
  }
  origin_ = lowest;
  length_ = highest - lowest;
}

FoldedAxis::Place FoldedAxis::wrapped(double x) const {
  const double from_origin = x - origin_;
  if (!periodic_ || (from_origin >= 0.0 && from_origin < edge_)) return {from_origin, 0.0};
  const double boxes = -std::floor(from_origin / edge_);
  return {std::clamp(from_origin + boxes * edge_, 0.0, edge_), boxes};
}

void FoldedAxis::narrow_gaps(std::span<const double> coordinates, double least) {
  const std::size_t count = (coordinates.size() + 2) / 3;
  if (count == 0) return;
  if (!periodic_) origin_ = 0.0;  // the distance from the lowest may overflow
  least_ = least;
  double* sorted = sorted_.room_for(count);
  for (std::size_t k = 0; k < count; ++k) sorted[k] = wrapped(coordinates[3 * k]).inside;
  std::sort(sorted, sorted + count);
  Stretch* stretch = stretch_.room_for(count);
  std::size_t s = 0;
  stretch[0] = {sorted[0], sorted[0], 0.0};
  for (std::size_t k = 1; k < count; ++k) {
    if (sorted[k] - stretch[s].last > least) {
      const double begin = stretch[s].begin + (stretch[s].last - stretch[s].first) + least;
      stretch[++s] = {sorted[k], sorted[k], begin};
    }
    stretch[s].last = sorted[k];
  }
  length_ = stretch[s].begin + (stretch[s].last - stretch[s].first);
  if (periodic_) length_ += std::min(least, (stretch[0].first + edge_) - stretch[s].last);
  stretches_ = s + 1;
}

// The stretch that a wrapped coordinate lies in or, in a gap, the nearer one; beyond the ends of a periodic axis a box further.
const FoldedAxis::Stretch& FoldedAxis::nearest(Place& place) const {
  const Stretch *begin = stretch_.data(), *end = begin + stretches_;
  const Stretch* after =
      std::upper_bound(begin, end, place.inside, [](double x, const Stretch& stretch) { return x < stretch.first; });
  const double x = place.inside;
  if (after != begin && x <= after[-1].last) return after[-1];
  const Stretch &before = after != begin ? after[-1] : end[-1], &next = after != end ? *after : *begin;
  const double wrap_before = after != begin ? 0.0 : edge_, wrap_next = after != end ? 0.0 : edge_;
  if (!periodic_ && (after == begin || after == end)) return after == begin ? next : before;
  const bool is_before = (x + wrap_before) - before.last <= (next.first + wrap_next) - x;
  const double wrap = is_before ? wrap_before : -wrap_next;
  if (wrap != 0.0) {
    place.inside += wrap;
    place.boxes += wrap > 0.0 ? 1.0 : -1.0;
  }
  return is_before ? before : next;
}

FoldedAxis::Place FoldedAxis::place(double x) const {
  Place place = wrapped(x);
  if (stretches_ == 0) return place;
  const Stretch& stretch = nearest(place);
  const double wide = stretch.last - stretch.first, half = 0.5 * least_;
  place.inside = stretch.begin + std::clamp(place.inside - stretch.first, -half, wide + half);
  if (periodic_ && (place.inside < 0.0 || place.inside > length_)) {
    const double boxes = place.inside < 0.0 ? 1.0 : -1.0;
    place.inside += boxes * length_;
    place.boxes += boxes;
  }
  return place;
}

double FoldedAxis::rounding(double greatest) const {
  return 1e-14 * (periodic_ ? std::max({greatest, edge_, std::abs(origin_)}) : length_);
}

}  // namespace lanescape
