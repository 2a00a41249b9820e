#pragma once

#include <cstddef>
#include <vector>

#include "core/box.hpp"

namespace lanescape {

// Coordinates along one axis of a periodic box after wide gaps between them were narrowed. Two particles in one stretch without a
// wide gap, and in the same box, have the same shift to the bit, and so keep their separation; those of different stretches stay at
// least `least` apart.
struct ClosedGaps {
  double length = 0.0;         // of the narrowed box
  std::vector<double> shifts;  // to add to each coordinate; then 0 <= x < length
  std::vector<double> boxes;   // the whole boxes among each shift
};

// Narrows gaps wider than `least` to that width, the one across the faces included. Coordinates may be unwrapped; they are finite.
// A grid over the narrowed box follows the particles: a droplet in a large box costs what it would cost alone. O(N), but for nested
// clusters at very different scales.
ClosedGaps close_gaps(std::vector<double> coordinates, double length, double least);

// The same along an open axis, from the lowest coordinate; nothing lies across the faces, and no boxes are among the shifts.
ClosedGaps close_open_gaps(std::vector<double> coordinates, double least);

// Whether gaps may be worth closing: fewer than about one particle in a cube with this edge.
inline bool is_sparse(const Box& box, std::size_t particles, double edge) {
  return edge > 0.0 && static_cast<double>(particles) * edge * edge * edge < box.volume();
}

}  // namespace lanescape
