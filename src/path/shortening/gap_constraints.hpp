#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/archive.hpp"
#include "core/point.hpp"
#include "interaction/sphere/segment_gaps.hpp"
#include "path/path_check.hpp"
#include "path/polyline.hpp"

namespace lanescape {

// That a pair does not overlap, to first order in moves of the nodes of one segment: gap + change >= 0. Its second derivative is
// (across^2 - turn^2) / distance.
struct GapConstraint {
  std::uint64_t key;              // of the pair, its image and where on the segment it holds
  std::array<std::size_t, 2> at;  // the first of three coordinates of each sphere, in the order of SphereCoordinates
  Point normal;                   // along the separation
  std::array<double, 2> scales;   // of the separation, for a move of each sphere [sigma of distance per kinematic length]
  std::array<double, 2> shares;   // of the moves of the node before and behind the segment
  double gap;                     // [sigma]
  // How far the closest approach moves along its segment with each sphere at each node; zero where it cannot.
  std::array<std::array<Point, 2>, 2> turns{};
  double distance = 0.0;    // of the pair [sigma]; 0 where the normal does not follow the separation
  double stiffness = 0.0;   // multiplier/distance of the last iteration
  double slack = 0.0;       // the room left, as the interior-point method sees it [sigma]
  double multiplier = 0.0;  // the force along the gap
  double slack_step = 0.0, multiplier_step = 0.0;

  // How moves of both nodes, null for an end of the path, change the separation.
  Point displacement(const double* before, const double* behind) const {
    Point sum{};
    for (std::size_t sphere = 0; sphere < 2; ++sphere)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t q = at[sphere] + axis;
        sum[axis] += scales[sphere] * ((before ? shares[0] * before[q] : 0.0) + (behind ? shares[1] * behind[q] : 0.0));
      }
    return sum;
  }
  // How much wider they make the gap.
  double change(const double* before, const double* behind) const { return dot(displacement(before, behind), normal); }
  // Whether it lies within its segment, along which it may move.
  bool turning() const { return shares[0] != 0.0 && shares[1] != 0.0; }
  // How far they move the closest approach along its segment.
  double turn(const double* before, const double* behind) const {
    double sum = 0.0;
    for (std::size_t sphere = 0; sphere < 2; ++sphere)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t q = at[sphere] + axis;
        sum += (before ? turns[0][sphere][axis] * before[q] : 0.0) + (behind ? turns[1][sphere][axis] * behind[q] : 0.0);
      }
    return sum;
  }
  // Adds a force of this size, along a direction or along the gap, to a node of the segment, 0 or 1.
  void push(std::size_t node, double force, const Point& direction, double* out) const {
    for (std::size_t sphere = 0; sphere < 2; ++sphere)
      for (std::size_t axis = 0; axis < 3; ++axis)
        out[at[sphere] + axis] += shares[node] * force * scales[sphere] * direction[axis];
  }
  void push(std::size_t node, double force, double* out) const { push(node, force, normal, out); }
  void push_turn(std::size_t node, double force, double* out) const {
    for (std::size_t sphere = 0; sphere < 2; ++sphere)
      for (std::size_t axis = 0; axis < 3; ++axis) out[at[sphere] + axis] += force * turns[node][sphere][axis];
  }
};

// Of each segment of a path.
using SegmentGapConstraints = std::vector<std::vector<GapConstraint>>;

// The kinematic coordinates of the spheres without the padding of a layout: x y z of one sphere after the other.
class SphereCoordinates {
 public:
  explicit SphereCoordinates(const ParticleLayout& layout);

  std::size_t dimension() const { return slots_of_.size(); }
  std::size_t first_of(std::size_t slot) const { return first_[slot]; }
  // Of this coordinate in an array of the layout.
  std::size_t slot_coordinate(std::size_t q) const { return slots_of_[q]; }

 private:
  std::vector<std::size_t> first_, slots_of_;
};

// The gaps along a path of hard spheres that moves of its nodes could close. A pair has a constraint on a segment where it comes
// nearest inside it, which both nodes share, and one at each node: without these, a pair that slides along a short segment would be
// held at one of its ends only. On the first and the last segment the plane through the end of the path that touches the sphere
// replaces the closest approach, as no move of one node changes how near the end is.
//
// Closest approaches move along their segments, the faster the less the pair moves there: to first order they leave overlaps
// behind. Planes do not: with both nodes beyond a plane that touches the sphere, so is all of the segment.
class GapConstraints {
 public:
  struct Options {
    double reach;   // pairs with a larger gap have no constraint [sigma]
    double margin;  // taken off every gap [sigma]
    int threads = 1;
  };
  GapConstraints(const HardSpherePath& path, const Options& options);
  ~GapConstraints();

  // What a pair keeps to inside a segment, but the first and the last.
  enum class Shape : std::uint8_t { approaches, planes };
  // Follows the nodes, as many as begin() has been told. Slacks are those of before or fit the barrier, but are at least the gaps.
  // Multipliers are those of before, as far as their product with the slack is near the barrier; new ones fit it.
  void follow(const Polyline& nodes, double barrier, Shape shape);
  // The constraints of other nodes, with the multipliers of these.
  SegmentGapConstraints at(const Polyline& nodes);
  // Of any pair on any segment of the nodes that were looked at last, at most the reach [sigma].
  double smallest_gap() const;

  SegmentGapConstraints& of_segments() { return segments_; }
  // Forgets all constraints, of a path of this many segments.
  void begin(std::size_t segments) { segments_.assign(segments, {}); }
  const SphereCoordinates& coordinates() const { return coordinates_; }
  std::uint64_t evaluations() const { return evaluations_; }
  // Reading needs begin().
  void exchange(Archive& archive);

 private:
  struct Scratch;
  class Builder;
  void build(const Polyline& nodes, SegmentGapConstraints& segments);

  Box box_;
  KinematicMetric metric_;
  Options options_;
  SphereCoordinates coordinates_;
  AlignedArray scale_;  // dr/dq of each coordinate of the layout
  std::vector<std::unique_ptr<Scratch>> scratch_;
  std::uint64_t evaluations_ = 0;
  Shape shape_ = Shape::approaches;
  SegmentGapConstraints segments_;
  std::vector<double> smallest_;  // gap of each segment
};

}  // namespace lanescape
