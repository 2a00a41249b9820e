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

// The older method for hard spheres ([G] 5.2), the negative control: straight flights R_f - R to the first contact, in turn with
// away steps, in which of the two in contact one moves out of the other's way and the other advances beside it.
//
// Where [G] leaves things open, as reference/hard_geodesic:
// - Of two in contact that one is in the other's way which lies ahead of it. Beside it, to `slack`, is out of the way, and a
//   sphere that makes way goes on to that gap: else rounding alone would make the same two collide for ever.
// - The sphere that makes way moves first, then one by one, in the user's order and recursively, whatever its own move runs
//   into, spheres that have moved before included.
// - Only the first sphere is cleared from a whole ray. The way of every later one ends where its move ends: with endless ways a
//   short move pushes spheres far ahead aside, and from a packing fraction of 0.3 on no path is found.
//
// Each pair's nearest image alone counts. A flight is made in parts so short that no other image can be met in one. O(N^2) for
// each part, O(N) for each sphere moved.
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

  // One flight, or the away step that follows it; from a start in contact, which allows no flight, the away step at once. With the
  // way free `next` is exactly the goal. Nothing where there is no step, failure() then says why. `at` is where the last step
  // led; `next` is overwritten either way.
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
  std::vector<double> radii_;        // here and below in the user's order, which ties are decided by
  std::vector<std::size_t> places_;  // slots
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
