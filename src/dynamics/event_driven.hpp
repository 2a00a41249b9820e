#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "configuration/configuration.hpp"
#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "core/point.hpp"
#include "dynamics/event_calendar.hpp"
#include "kernel_table.hpp"
#include "neighbour/cell_grid.hpp"

namespace lanescape {

// Event-driven dynamics of hard spheres ([G] 3.2.3.1): free flight between elastic collisions, exact up to rounding, for any
// diameters and masses. Each particle keeps its own time and its earliest event. A calendar finds the earliest event of all.
// Neighbour lists limit the pairs that are examined. Time in sigma sqrt(m / k_B T).
//
// The shell of a particle is a sphere of radius `shell` around the position at which its list was built. The list holds all
// particles that it can touch before either of the two leaves its shell. Leaving the shell is an event, after which the list is
// rebuilt. Every resync_interval() collisions all particles advance to one time, this time is reset to zero, and lists and calendar
// are rebuilt. The interval depends on the number of particles only. So rounding errors do not grow with time, and the state at
// such a count is positions, velocities and counters only.
class EventDriven {
 public:
  // Starts at rest. `masses` per particle. `growth`: relative growth of the diameters per unit of time, with respect to those at
  // the last resynchronisation. Spheres must not overlap. Throws Error(bad_input) if a box edge is shorter than 2.05 of the largest
  // diameter: a particle could then collide with two images of another.
  EventDriven(const Configuration& start, const std::vector<double>& masses, const kernels::KernelTable& table,
              double growth = 0.0);

  // Draws velocities from Maxwell's distribution at T = 1, then calls rescale().
  void draw_velocities(std::uint64_t seed);
  // Sets velocities (3N, the user's order) without any rescaling.
  void set_velocities(const std::vector<double>& velocities);
  // Removes the total momentum and scales to sum m v^2 / 2 = (3/2) N T with T = 1, the convention of [G].
  void rescale();

  // Advances to the next collision. At least one particle must be moving. Throws Error(goal_not_reached) after ten million events
  // without one.
  void collide();
  // Advances to `time`, counted from the start, through all collisions until then.
  void advance_to(double time);
  // Advances all particles to one time and rebuilds lists and calendar. Later results depend, to the bit, on when this is called.
  void resynchronise();

  // Collisions between resynchronisations: 256 per particle, at most 100,000, but at least 4 per particle. Times then lose fewer
  // than four digits, and the O(N) cost of a resynchronisation is small per collision.
  std::uint64_t resync_interval() const {
    return std::max<std::uint64_t>(std::min<std::uint64_t>(100'000, 256 * size()), 4 * size());
  }

  std::size_t size() const { return spheres_.size(); }
  const Box& box() const { return box_; }
  std::uint64_t collisions() const { return collisions_; }
  double time() const { return time_base_ + now_; }  // of the last event or the last advance_to()
  double next_event_time() const { return time_base_ + calendar_.first_time(); }
  double kinetic_energy() const;
  Point momentum() const;
  // Sum over collisions of 2 mu |b|, with b = r.v at contact and mu the reduced mass.
  double virial() const { return virial_; }
  // Z = 1 + virial / (3 N k_B T t), virial and t counted from `virial_before` and `time_before`.
  // k_B T = 2 K / (3 N - 3), because the total momentum is zero.
  double compressibility(double virial_before = 0.0, double time_before = 0.0) const;
  double radius(std::size_t particle) const { return spheres_[slot_of_[particle]].radius * (1.0 + growth_ * now_); }

  // Unwrapped positions, 3N in the user's order: at `time`, which lies between the last event and the next, or at the last event.
  void positions(double time, std::vector<double>& out) const;
  std::vector<double> positions() const;
  std::vector<double> velocities() const;
  Configuration configuration() const;

  // True directly after a resynchronisation. Only a state written there continues with the same bits after it is read.
  bool at_resync() const { return fresh_; }
  void exchange(Archive& archive);

  struct Statistics {
    std::uint64_t predictions = 0, stale_events = 0, shell_exits = 0;
  };
  const Statistics& statistics() const { return statistics_; }
  double mean_neighbours() const;

 private:
  struct Event {
    std::int32_t partner;              // `none` if the particle leaves its shell
    std::uint32_t partner_collisions;  // the partner's collisions at the prediction; the event is stale once there are more
  };
  // Smaller systems stay in the user's order and do not look ahead: they are in the second cache.
  static constexpr std::size_t large_from = 10'000;
  static constexpr std::int32_t none = -1;
  static constexpr double never = std::numeric_limits<double>::infinity();
  // The nearest image of the difference d of two coordinates in the box, without a branch, which would often be predicted wrongly.
  static double nearest(double d, double length) { return d - std::copysign(std::fabs(d) > 0.5 * length ? length : 0.0, d); }
  // Which events come soon, so that what they need is in the cache by then. It changes no result.
  struct Outlook {
    int events_left = 0;                        // until the next look
    double time = 0.0, interval = 0.0;          // of the last look; mean time between two
    double until = 0.0;                         // events until then have been found
    std::vector<std::uint32_t> found, fetched;  // particles with such an event: found by the last look, and by the one before
  };
  // Half a cache line, so that the candidates of a list are read alone.
  struct alignas(32) Shell {
    Point centre;   // the position at which the list was built
    double radius;  // of the sphere, at time 0
  };
  // Copies of all shells, contiguous cell by cell.
  struct ShellsByCell {
    struct Copy {
      Shell shell;
      std::int32_t particle;
    };
    AlignedVector<Copy> all;
    std::vector<std::size_t> first;  // index of each cell's first shell, then the number of shells
  };
  // Tells whether two particles can touch before either leaves its shell. Their shells are centred in the box.
  struct Encounters {
    Box box;
    double swollen, shells;  // factor by which radii grow until the horizon; twice the shell radius [sigma]

    bool possible(const Shell& shell, const Shell& other) const;
  };

  void sort_in_space();
  void choose_shell();
  ShellsByCell shells_by_cell() const;
  void make_lists();
  void make_calendar();
  void positions_at(double now, std::vector<double>& out) const;
  double swell() const { return 1.0 + growth_ * now_; }
  void bring_to_now(std::size_t i) {
    auto& s = spheres_[i];
    const double flown = now_ - s.time;
    s.x += s.vx * flown;
    s.y += s.vy * flown;
    s.z += s.vz * flown;
    s.time = now_;
  }
  void wrap(std::size_t i);
  void renew_shell(std::size_t i) { shell_of_[i] = {{spheres_[i].x, spheres_[i].y, spheres_[i].z}, spheres_[i].radius}; }
  std::int32_t* list(std::size_t i) { return lists_.data() + i * list_capacity_; }
  Encounters encounters() const { return {box_, growth_ > 0.0 ? 1.0 + growth_ * horizon_ : 1.0, 2.0 * shell_}; }
  std::size_t find_neighbours(std::size_t i);
  void append(std::size_t i, std::int32_t neighbour);
  void remove(std::size_t i, std::int32_t neighbour);
  void grow_lists();
  void rebuild_list(std::size_t i);
  double shell_exit(std::size_t i) const;
  // Predicts the next event of particle i and returns its time.
  double predict(std::size_t i);
  void bounce(std::size_t i, std::size_t j);
  void look_ahead();
  void prefetch_particle(std::size_t i) const;
  void prefetch_neighbours(std::size_t i) const;
  void prefetch_shells(std::size_t i) const;
  // Processes the next event. Returns true if it is a collision.
  bool next_event();

  const kernels::KernelTable* table_;
  Box box_;
  double growth_;
  // All arrays are in the order of slots, which is the user's order in small systems.
  std::vector<std::uint32_t> slot_of_;  // of each of the user's particles
  AlignedVector<double> masses_;
  AlignedVector<kernels::FlyingSphere> spheres_;
  AlignedVector<Point> images_;  // number of box edges by which each wrapped position differs from the unwrapped one
  double now_ = 0.0, time_base_ = 0.0;
  std::uint64_t collisions_ = 0;
  double virial_ = 0.0;
  bool fresh_ = false;  // no event since the last resynchronisation

  // The rest is derived from the above at each resynchronisation.
  double shell_ = 0.0, largest_radius_ = 0.0, horizon_ = 0.0;
  CellGrid grid_;
  double shortest_cell_ = 0.0;  // edge for which the grid was made
  AlignedVector<Shell> shell_of_;
  std::size_t list_capacity_ = 32;
  AlignedVector<std::int32_t> lists_, list_sizes_;
  std::vector<std::int32_t> found_;  // scratch memory, one for each particle
  EventCalendar calendar_;
  AlignedVector<Event> events_;
  AlignedVector<std::uint32_t> collisions_of_;
  Statistics statistics_;
  Outlook outlook_;
};

}  // namespace lanescape
