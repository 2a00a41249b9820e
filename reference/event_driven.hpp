#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "reference/vector.hpp"

/// Flights and collisions of hard spheres, and event-driven dynamics made of them: scalar, O(N^2), written from PHYSICS 1.3.
/// Positions, radii, box, separations and errors are those of hard_sphere.hpp.
namespace lanescape::reference {

/// A sphere in free flight: at time t its position is position + velocity (t - time), its radius radius + growth t.
struct FreeSphere {
  Vector position{};    // [sigma], at the sphere's own time
  Vector velocity{};    // [sigma/time]
  double time = 0.0;    // the sphere's own time
  double radius = 0.5;  // [sigma], at time zero
  double growth = 0.0;  // [sigma/time]
};

/// The time, not before `now`, at which two free spheres that are nearest images at `now` touch; infinity if never. PHYSICS 1.3.
///
/// Spheres that touch or overlap and approach each other collide at `now`. Other images are ignored: the result holds for flights
/// up to image_horizon() only.
double collision_time(const FreeSphere& i, const FreeSphere& j, double now, const Vector& box);

/// Time for which only nearest images can come into contact; growth is ignored [time].
///
/// A second image is at least L/2 away along one axis. Two spheres at the largest speed each must first travel half the shortest
/// edge less the largest contact distance. Throws if that is not positive.
double image_horizon(const std::vector<FreeSphere>& spheres, const Vector& box);

struct Contact {
  double time = std::numeric_limits<double>::infinity();
  std::size_t i = 0;
  std::size_t j = 0;
};

/// Moves all spheres, whose times are equal, to their first contact or, if there is none before it, to the finite time `until`.
///
/// Flights longer than image_horizon() are cut into parts, so that contacts with all periodic images are found. O(N^2) for each
/// part. Returns the contact; its time is infinity if there is none.
Contact fly_to_contact(std::vector<FreeSphere>& spheres, const Vector& box, double until);

struct Collision {
  Vector velocity_change_i{};  // [sigma/time]
  Vector velocity_change_j{};
  double virial = 0.0;  // [mass sigma^2/time], 2 mu |b|, the term of the collision in Z
};

/// Elastic collision of smooth spheres at contact. separation: nearest image of r_j - r_i; relative_velocity: v_j - v_i.
///
/// PHYSICS 1.3 with r^2 in place of s^2: they are equal at contact, and with r^2 rounding of the contact does not change the
/// energy.
Collision elastic_collision(const Vector& separation, const Vector& relative_velocity, double mass_i, double mass_j);

/// Event-driven dynamics by brute force: each collision predicts all pairs and moves all spheres.
class EventDriven {
 public:
  /// velocities: 3N [sigma/time]; masses: N. Throws if spheres overlap.
  EventDriven(std::span<const double> positions, std::span<const double> velocities, std::span<const double> radii,
              std::span<const double> masses, const Vector& box);

  /// Performs the next collision and returns true; if there is none before `until`, advances to that time and returns false. A
  /// limit is needed because spheres may never meet.
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
  /// 3N - 3 is exact for relative velocities at zero total momentum, and is used in comparisons with published values
  /// (PHYSICS 1.3). [G] uses 3N, which makes Z - 1 larger by N/(N - 1).
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
