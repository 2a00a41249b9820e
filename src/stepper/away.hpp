#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/archive.hpp"
#include "core/box.hpp"
#include "landscape/hard_landscape.hpp"
#include "stepper/direct.hpp"

namespace lanescape {

// The older method for hard spheres ([G] 5.2), the negative control. Straight flights along R_f - R to the first contact alternate
// with away steps, in which one of the two spheres in contact moves out of the other's way and the other advances beside it.
//
// Readings where [G] leaves things open, the same as in reference/hard_geodesic:
// - Of two spheres in contact, the one that lies ahead of the other is in its way. A sphere is out of the way when it lies beside
// the
//   other with a gap of `slack`; without a gap rounding would make the same two collide for ever.
// - The sphere that makes way moves first. Then, recursively and in the user's order, every sphere that its move runs into moves,
//   also one that has moved before.
// - Only the first sphere is cleared from a whole ray. For every later one the way ends where its move ends. With endless ways a
// short
//   move pushes away spheres far ahead, and above a packing fraction of 0.3 no path is found.
//
// Only the nearest image of each pair counts. A flight is divided into parts so short that no other image can be met. Each part
// costs O(N^2), each moved sphere O(N).
class AwayStepper {
 public:
  struct Options {
    std::uint64_t max_depth = 2000;     // spheres pushed one by the other
    std::uint64_t max_moves = 100'000;  // of single spheres in one away step
  };
  static constexpr double slack = 1e-10;  // [sigma]

  // `radii` per particle in the user's order [sigma], `goal` R_f in the layout's. Throws Error(bad_input) where the box is not
  // longer than two of the largest diameters.
  AwayStepper(const Box& box, const ParticleLayout& layout, const std::vector<double>& radii, HardLandscape& landscape,
              AlignedArray goal, const Options& options);

  // One flight, or the away step that follows it. A start in contact allows no flight: its first step is an away step. If the way
  // is free `next` is exactly the goal. `at` is the point of the last step.
  std::optional<StepKind> step(const PathPoint& at, AlignedArray& next);

  double step_length() const { return 1e-9; }                       // steps have none; the last one reaches the goal
  double monitored() const { return static_cast<double>(moved_); }  // spheres moved by the last step
  // How deep spheres overlap where the last step led: rounding at contacts, up to `slack` after an away step [sigma].
  double violation() const { return violation_; }
  std::uint64_t evaluations() const { return evaluations_; }  // of whole configurations, for contacts or for overlaps
  const std::string& failure() const { return failure_; }
  // How many away steps took 1, 2, 3, ... moves of single spheres; the last entry counts all beyond.
  const std::vector<std::uint64_t>& corrections() const { return corrections_; }

  void exchange(Archive& archive, const AlignedArray& position);

 private:
  using Vector = std::array<double, 3>;
  struct Contact {
    double time = std::numeric_limits<double>::infinity();  // of a flight, which takes 1 to the goal
    std::size_t i = 0, j = 0;
  };
  // A sphere that has moved, and how far the search for others in its way has come.
  struct Push {
    std::size_t sphere;
    Vector origin, direction;
    double length;
    std::size_t candidate;
  };

  void read(const AlignedArray& position);
  void write(AlignedArray& position) const;
  std::optional<StepKind> accept(StepKind kind, const AlignedArray& from, const AlignedArray& to);
  Contact fly();
  Contact first_contact(double now) const;
  double image_horizon() const;
  bool resolve(std::size_t p, std::size_t q);
  bool make_way(std::size_t p, std::size_t q, const Vector& origin, const Vector& direction, double length);
  bool push(std::size_t sphere, const Vector& direction, double length);
  bool settle();
  bool fail(std::string reason);

  Vector separation(const Vector& from, std::size_t to) const;
  Vector from_way(std::size_t sphere, const Vector& origin, const Vector& direction, double length) const;
  Vector heading(std::size_t sphere) const;
  double distance_to_goal(std::size_t sphere) const;

  Box box_;
  std::vector<double> radii_;  // here and below in the user's order, which ties are decided by
  std::vector<std::size_t> slots_of_;
  std::size_t slots_;
  HardLandscape* landscape_;
  AlignedArray goal_array_;
  Options options_;
  double room_;  // that the nearest-image rule leaves to two of the largest spheres [sigma]
  std::vector<Vector> goal_, position_, velocity_;
  std::vector<Push> pushes_;
  std::uint64_t moves_ = 0;                      // in this away step
  std::uint64_t contact_i_ = 0, contact_j_ = 0;  // which the last flight ended with; equal: there is none to resolve
  std::uint64_t moved_ = 0, evaluations_ = 0;
  double violation_ = 0.0;
  std::vector<std::uint64_t> corrections_;
  std::string failure_;
};

}  // namespace lanescape
