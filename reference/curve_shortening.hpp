#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "reference/geodesic.hpp"
#include "reference/path_sum.hpp"
#include "reference/vector.hpp"

/// Constrained curve shortening as PHYSICS 4 states it, to check the method in src. Masses are equal.
namespace lanescape::reference {

struct CurveOptions {
  std::size_t coarse = 17;       // nodes at first, ends included
  std::size_t fine = 129;        // no level has more nodes; each has twice as many segments as the one before
  double over_relaxation = 1.8;  // of the way to the midpoint of the neighbours, below 2
  double tolerance = 1e-6;       // a sweep that moves no node by this part of a segment ends a level
  long max_sweeps = 100'000;     // of all levels together
};

struct ShortenedCurve {
  bool stationary = false;
  double length = 0.0;  // [sigma]
  long sweeps = 0;
  std::vector<Point> nodes;
};

/// Brings a point into the allowed region. False where that fails.
using Projection = std::function<bool(Point& position)>;

/// Newton steps along the gradient until V <= E_L.
Projection below_energy(const Energy& energy, const Gradient& gradient, double landscape_energy);
/// Moves the two of each overlapping pair apart along their line, pair by pair, until none overlaps.
Projection without_overlaps(std::span<const double> radii, const Vector& box);

/// Shortens a path between its ends, which are allowed. Nodes are allowed; segments between them cut into the forbidden region by
/// the square of their length. Throws std::invalid_argument for fewer than three nodes, and where no projection of a node is found.
ShortenedCurve shorten_curve(const std::vector<Point>& start, const Projection& projection, const CurveOptions& options = {});

/// `count` points, equally spaced along the length of a path of straight segments.
std::vector<Point> spaced_equally(const std::vector<Point>& nodes, std::size_t count);

}  // namespace lanescape::reference
