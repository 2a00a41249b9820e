#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "reference/vector.hpp"

/// The arbiter for overlaps of hard spheres: scalar, O(N^2), written from PHYSICS 1.2 and 3.4.
///
/// In all functions positions are 3N, interleaved, wrapped or not [sigma]; radii are N [sigma]; the box is orthorhombic and
/// fully periodic, its edges in [sigma]. Only the nearest image of each pair counts, so results are exact for contact distances up
/// to half the shortest edge. Functions throw std::invalid_argument if sizes differ or radii or edges are not allowed.
///
/// Other implementations must take the same decisions to the bit, so the arithmetic is part of the definition: per axis d = x_j -
/// x_i, then d - L nearbyint(d/L); r2 = (dx dx + dy dy) + dz dz; s = radius_i + radius_j; i < j; no operations are fused. A
/// particle with a position that is not a number overlaps with no other.
namespace lanescape::reference {

struct Overlap {
  std::size_t i = 0;  // i < j
  std::size_t j = 0;
  double gap = 0.0;   // [sigma], sqrt(r2) - s; negative, or zero by rounding
  Vector separation;  // [sigma], nearest image of r_j - r_i
};

/// Pairs with r2 < s s, in the order of i, then j. Touching is not overlapping.
std::vector<Overlap> overlaps(std::span<const double> positions, std::span<const double> radii, const Vector& box);
bool any_overlap(std::span<const double> positions, std::span<const double> radii, const Vector& box);

/// Smallest sqrt(r2) - s [sigma]; infinity for fewer than two particles.
double smallest_gap(std::span<const double> positions, std::span<const double> radii, const Vector& box);

/// Pairs with r2 < t t, t = s + reach, in the order of i, then j; a neighbour list must hold them. reach: [sigma], not negative.
std::vector<std::pair<std::size_t, std::size_t>> pairs_within(std::span<const double> positions, std::span<const double> radii,
                                                              const Vector& box, double reach);

/// Potential of overlapping pairs in a collision-avoidance step; x = r/s < 1. PHYSICS 3.4, [G] Eqs. 3.18-3.22.
enum class FictitiousPotential {
  harmonic,  // s^2 (1 - x)^2 / 2; force s (1 - x), the overlap s - r
  linear,    // s^2 (1 - x), [G] Eq. 3.33 as printed; force s at any overlap
  cubic,     // s^3 (x^3/3 - x^2/2 + 1/6); force s^2 x (1 - x)
};

/// nu(r/s); zero for r >= s.
double fictitious_energy(FictitiousPotential potential, double r, double s);

/// -d nu(r/s)/dr, not negative; zero for r >= s.
double fictitious_force(FictitiousPotential potential, double r, double s);

/// Forces (3N) that push overlapping pairs apart. Particles at the same point exert no force on each other: it has no direction.
std::vector<double> fictitious_forces(std::span<const double> positions, std::span<const double> radii, const Vector& box,
                                      FictitiousPotential potential);

}  // namespace lanescape::reference
