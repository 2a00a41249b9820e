#include "reference/neighbours.hpp"

#include <cmath>

namespace lanescape::reference {
namespace {

struct Shifts {
  int first, last;
};

// The shifts S for which d + S L can be nearer than the cutoff, and one more at either end.
Shifts shifts_within(double d, double length, double cutoff) {
  return {static_cast<int>(std::ceil((-cutoff - d) / length)) - 1, static_cast<int>(std::floor((cutoff - d) / length)) + 1};
}

}  // namespace

std::vector<NeighbourPair> neighbour_pairs(std::span<const double> positions, const Vector& box, double cutoff,
                                           const Periodic& periodic) {
  std::vector<NeighbourPair> pairs;
  const std::size_t n = positions.size() / 3;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      Vector apart;
      std::array<Shifts, 3> shifts;
      for (std::size_t k = 0; k < 3; ++k) {
        apart[k] = positions[3 * j + k] - positions[3 * i + k];
        shifts[k] = periodic[k] ? shifts_within(apart[k], box[k], cutoff) : Shifts{0, 0};
      }
      for (int x = shifts[0].first; x <= shifts[0].last; ++x)
        for (int y = shifts[1].first; y <= shifts[1].last; ++y)
          for (int z = shifts[2].first; z <= shifts[2].last; ++z) {
            if (i == j && x == 0 && y == 0 && z == 0) continue;
            const Vector d{apart[0] + x * box[0], apart[1] + y * box[1], apart[2] + z * box[2]};
            if (const double distance = std::sqrt(dot(d, d)); distance < cutoff) pairs.push_back({i, j, {x, y, z}, d, distance});
          }
    }
  return pairs;
}

}  // namespace lanescape::reference
