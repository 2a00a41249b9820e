#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "reference/images.hpp"
#include "reference/vector.hpp"

/// Pairs of particles within a cutoff, with ASE's conventions.
namespace lanescape::reference {

struct NeighbourPair {
  std::size_t first, second;
  std::array<int, 3> shift;  // S, whole boxes
  Vector separation;         // D = r_second - r_first + S . box
  double distance;           // |D| < cutoff
};

/// All pairs in a box, from both ends, a particle's own images along periodic axes among them; sorted by first, second and shift.
/// O(N^2).
std::vector<NeighbourPair> neighbour_pairs(std::span<const double> positions, const Vector& box, double cutoff,
                                           const Periodic& periodic = all_periodic);

}  // namespace lanescape::reference
