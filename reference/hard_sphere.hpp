#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "reference/vector.hpp"

/// The arbiter for hard spheres: scalar, O(N^2), written from PHYSICS 1.2, 1.3 and 3.4.
///
/// Everywhere: positions are 3N, interleaved, wrapped or not [sigma]; radii are N [sigma]; the box is orthorhombic and
/// fully periodic, its edges in [sigma]; of each pair the nearest image alone counts, so that contact distances up to half
/// the shortest edge are exact. std::invalid_argument is thrown where sizes, radii, masses or edges do not fit.
///
/// Other implementations must decide alike to the bit, so the arithmetic is part of the definition. Per axis d = x_j - x_i,
/// then d - L nearbyint(d/L); r2 = (dx dx + dy dy) + dz dz; s = radius_i + radius_j; i < j; nothing is fused. A position
/// that is not a number therefore overlaps with nothing.
namespace lanescape::reference {

struct Overlap {
  std::size_t i = 0;  // i < j
  std::size_t j = 0;
  double gap = 0.0;   // [sigma], sqrt(r2) - s, negative or, by rounding, zero
  Vector separation;  // [sigma], nearest image of r_j - r_i
};

/// Pairs with r2 < s s, in the order of i, then j. Touching is not overlapping.
std::vector<Overlap> overlaps(std::span<const double> positions, std::span<const double> radii, const Vector& box);
bool any_overlap(std::span<const double> positions, std::span<const double> radii, const Vector& box);

/// Smallest sqrt(r2) - s [sigma]; infinity for fewer than two particles.
double smallest_gap(std::span<const double> positions, std::span<const double> radii, const Vector& box);

/// Pairs with r2 < t t, t = s + reach, in the order of i, then j: what a neighbour list must hold. reach: [sigma], not
/// negative.
std::vector<std::pair<std::size_t, std::size_t>> pairs_within(std::span<const double> positions, std::span<const double> radii,
                                                              const Vector& box, double reach);

/// What overlapping pairs feel in a collision-avoidance step; x = r/s < 1. PHYSICS 3.4, [G] Eqs. 3.18-3.22.
enum class FictitiousPotential {
  harmonic,  // s^2 (1 - x)^2 / 2; force s (1 - x), the depth of the overlap
  linear,    // s^2 (1 - x), [G] Eq. 3.33 as printed; force s whatever the depth
  cubic,     // s^3 (x^3/3 - x^2/2 + 1/6); force s^2 x (1 - x)
};

/// nu(r/s), zero from contact on.
double fictitious_energy(FictitiousPotential potential, double r, double s);

/// -d nu(r/s)/dr, not negative, zero from contact on.
double fictitious_force(FictitiousPotential potential, double r, double s);

/// Forces on all particles (3N) that push overlapping pairs apart. Coincident centres have no direction and no force.
std::vector<double> fictitious_forces(std::span<const double> positions, std::span<const double> radii, const Vector& box,
                                      FictitiousPotential potential);

/// A sphere in free flight: at time t it is at position + velocity (t - time), with the radius radius + growth t.
struct FreeSphere {
  Vector position{};    // [sigma], at the sphere's own time
  Vector velocity{};    // [sigma/time]
  double time = 0.0;    // the sphere's own time
  double radius = 0.5;  // [sigma], at time zero
  double growth = 0.0;  // [sigma/time]
};

/// When the nearest images (at `now`) of two free spheres touch, at or after `now`; infinity if never. PHYSICS 1.3.
///
/// Spheres that touch or overlap and approach collide now. Other images are not looked at: the answer holds for flights
/// up to image_horizon() only.
double collision_time(const FreeSphere& i, const FreeSphere& j, double now, const Vector& box);

/// How long from now no image but the nearest of any pair can come into contact, growth left out [time].
///
/// A second image is at least L/2 away on one axis, so half the shortest edge less the largest contact distance must be
/// travelled first, by two spheres at up to the largest speed each. Throws where the box leaves nothing to travel.
double image_horizon(const std::vector<FreeSphere>& spheres, const Vector& box);

struct Contact {
  double time = std::numeric_limits<double>::infinity();
  std::size_t i = 0;
  std::size_t j = 0;
};

/// Moves all spheres, whose own times are equal, to their first contact or, without one, to the finite time `until`.
///
/// Flights longer than image_horizon() are made in parts, so that every periodic image is met. O(N^2) for each part.
/// Returns the contact, at infinity where there is none.
Contact fly_to_contact(std::vector<FreeSphere>& spheres, const Vector& box, double until);

struct Collision {
  Vector velocity_change_i{};  // [sigma/time]
  Vector velocity_change_j{};
  double virial = 0.0;  // [mass sigma^2/time], 2 mu |b|, what the collision adds to the sum in Z
};

/// Elastic collision of smooth spheres at contact. separation: nearest image of r_j - r_i; relative_velocity: v_j - v_i.
///
/// PHYSICS 1.3 with r^2 for s^2, equal at contact, so that energy is kept whatever rounding has left between them.
Collision elastic_collision(const Vector& separation, const Vector& relative_velocity, double mass_i, double mass_j);

/// Event-driven dynamics by brute force: every pair predicted anew and every sphere moved at each collision.
class EventDriven {
 public:
  /// velocities: 3N [sigma/time]; masses: N. Throws where spheres overlap.
  EventDriven(std::span<const double> positions, std::span<const double> velocities, std::span<const double> radii,
              std::span<const double> masses, const Vector& box);

  /// Goes on to the next collision, performs it and returns true; without one before `until`, stops there and returns
  /// false. Two spheres may never meet, so there is no call without a limit.
  bool step(double until);

  double time() const { return time_; }
  long collisions() const { return collisions_; }
  /// Sum of 2 mu |b| over the collisions so far [mass sigma^2/time].
  double virial() const { return virial_; }
  double kinetic_energy() const;
  std::vector<double> positions() const;   // 3N, unwrapped [sigma]
  std::vector<double> velocities() const;  // 3N [sigma/time]

  /// Z = P V / (N k_B T) = 1 + virial / (3 N k_B T time), k_B T = 2 (kinetic energy) / (3 N - 3).
  ///
  /// With zero total momentum relative velocities are those of this temperature, exactly; PHYSICS 1.3 asks for it
  /// in comparisons with published values. The source's convention, 3 N, makes Z - 1 larger by N/(N - 1).
  double compressibility() const;

 private:
  std::vector<FreeSphere> spheres_;
  std::vector<double> masses_;
  Vector box_;
  double time_ = 0.0;
  long collisions_ = 0;
  double virial_ = 0.0;
};

}  // namespace lanescape::reference
