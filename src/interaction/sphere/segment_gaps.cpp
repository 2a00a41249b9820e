#include "interaction/sphere/segment_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/slot_point.hpp"

namespace lanescape {
namespace {

// Where |separation + t move| is smallest, 0 <= t <= 1.
double closest_fraction(const Point& separation, const Point& move) {
  const double squared = dot(move, move);
  return squared > 0.0 ? std::clamp(-dot(separation, move) / squared, 0.0, 1.0) : 0.5;
}

Point moved_separation(const Point& separation, const Point& move, double fraction) {
  Point result;
  for (std::size_t axis = 0; axis < 3; ++axis) result[axis] = separation[axis] + fraction * move[axis];
  return result;
}

// The images that come within `range` along one axis, between two separations.
struct ImageRange {
  ImageRange(double begin, double end, double range, double edge)
      : first(static_cast<std::int32_t>(std::ceil((-range - std::max(begin, end)) / edge))),
        last(static_cast<std::int32_t>(std::floor((range - std::min(begin, end)) / edge))) {}
  std::int32_t first, last;
};

}  // namespace

Point separation_at(const AlignedArray& positions, const Approach& pair, const Box& box) {
  Point d = difference(slot_point(positions, static_cast<std::size_t>(pair.second)),
                       slot_point(positions, static_cast<std::size_t>(pair.first)));
  for (std::size_t axis = 0; axis < 3; ++axis) d[axis] += pair.image[axis] * box.length[axis];
  return d;
}

const std::vector<Approach>& SegmentGaps::below(const AlignedArray& from, const AlignedArray& to, double reach) {
  const std::size_t slots = from.size() / 3;
  middle_.resize(from.size());
  double longest = 0.0;  // square of the longest move of a particle
  for (std::size_t k = 0; k < from.size(); ++k) middle_[k] = from[k] + 0.5 * (to[k] - from[k]);
  for (std::size_t k = 0; k < slots; ++k) {
    const Point move = difference(slot_point(to, k), slot_point(from, k));
    longest = std::max(longest, dot(move, move));
  }
  approaches_.clear();
  // Halfway, a pair is nearer than its closest approach and both half moves together; the image that is nearest there is among
  // them.
  const double halfway = reach + std::sqrt(longest) + 1e-9 * spheres_->largest_radius();
  for (const auto& pair : spheres_->pairs_within(middle_, halfway)) add_images(pair, from, to, reach);
  return approaches_;
}

void SegmentGaps::add_images(const kernels::SpherePair& pair, const AlignedArray& from, const AlignedArray& to, double reach) {
  const std::size_t slots = from.size() / 3;
  const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
  Point start, move;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t a = axis * slots + i, b = axis * slots + j;
    start[axis] = from[b] - from[a];
    move[axis] = (to[b] - from[b]) - (to[a] - from[a]);
  }
  const double contact = spheres_->radii()[i] + spheres_->radii()[j];
  const Point& edges = spheres_->box().length;
  const auto images = [&](std::size_t axis) {
    return ImageRange(start[axis], start[axis] + move[axis], contact + reach, edges[axis]);
  };
  const ImageRange x = images(0), y = images(1), z = images(2);
  for (std::int32_t nx = x.first; nx <= x.last; ++nx)
    for (std::int32_t ny = y.first; ny <= y.last; ++ny)
      for (std::int32_t nz = z.first; nz <= z.last; ++nz) {
        const Point separation{start[0] + nx * edges[0], start[1] + ny * edges[1], start[2] + nz * edges[2]};
        const double fraction = closest_fraction(separation, move);
        const Point nearest = moved_separation(separation, move, fraction);
        const double gap = std::sqrt(dot(nearest, nearest)) - contact;
        if (gap < reach) approaches_.push_back({pair.first, pair.second, {nx, ny, nz}, fraction, gap, nearest});
      }
}

}  // namespace lanescape
