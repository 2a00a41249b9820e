#pragma once

#include <algorithm>
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

// Hard spheres of any diameters and masses in free flight between elastic collisions ([G] 3.2.3.1), event by event and exact:
// each particle keeps its own time and its earliest event, a calendar finds the first of all, neighbour lists bound the
// search. Time in sigma sqrt(m / k_B T).
//
// A particle's list holds every other one that it can touch before either leaves its shell, a sphere of radius `shell` around the
// position its list was built at; leaving is an event. Every resync_interval() collisions, at counts that depend on nothing else,
// all particles advance to one time, which becomes zero again, and lists and calendar are rebuilt. So rounding does not grow with
// time, and a state at such a count is positions, velocities and counters alone.
class EventDriven {
 public:
  // At rest. `masses` per particle. `growth`: diameters grow by this share of themselves per unit of time, of what they were at the
  // last resynchronisation. Spheres must not overlap; throws Error(bad_input) where the box is shorter than 2.05 of the largest
  // diameter, where a particle would meet two images of another.
  EventDriven(const Configuration& start, std::vector<double> masses, const kernels::KernelTable& table, double growth = 0.0);

  // Maxwell's distribution, total momentum removed, then sum m v^2 / 2 = (3/2) N T with T = 1, the convention of [G].
  void draw_velocities(std::uint64_t seed);
  // Sets velocities (3N, the user's order) as they are.
  void set_velocities(const std::vector<double>& velocities);
  // Removes the total momentum and scales to T = 1.
  void rescale();

  // Advances to the next collision. There must be one: not all particles may be at rest.
  void collide();
  // Advances to `time` since the start, through all collisions until then.
  void advance_to(double time);
  // Brings all particles to one time and rebuilds lists and calendar. The counts at which this happens affect the later bits.
  void resynchronise();

  // Collisions between resynchronisations: 256 per particle, at most 100,000, at least 4 per particle. Times then lose less than
  // four digits, and the O(N) cost of each is small.
  std::uint64_t resync_interval() const {
    return std::max<std::uint64_t>(std::min<std::uint64_t>(100'000, 256 * size()), 4 * size());
  }

  std::size_t size() const { return spheres_.size(); }
  const Box& box() const { return box_; }
  std::uint64_t collisions() const { return collisions_; }
  double time() const { return time_base_ + now_; }  // of the last event, or that advance_to() was given
  double next_event_time() const { return time_base_ + calendar_.first_time(); }
  double kinetic_energy() const;
  Point momentum() const;
  // sum over collisions of 2 mu |b|, b = r.v at contact, mu the reduced mass.
  double virial() const { return virial_; }
  // Z = 1 + virial / (3 N k_B T t) since `virial_before` and `time_before`; k_B T = 2 K / (3 N - 3), since the total momentum is
  // zero.
  double compressibility(double virial_before = 0.0, double time_before = 0.0) const;
  double radius(std::size_t particle) const { return spheres_[particle].radius * (1.0 + growth_ * now_); }

  // Unwrapped positions at `time`, from the last event to the next one, or at the last event, 3N in the user's order.
  void positions(double time, std::vector<double>& out) const;
  std::vector<double> positions() const;
  std::vector<double> velocities() const;
  Configuration configuration() const;

  // A state that is read continues with the same bits only if it was written right after resynchronise(), or at a multiple of
  // resync_interval() collisions.
  bool at_resync() const { return fresh_; }
  void exchange(Archive& archive);

  struct Statistics {
    std::uint64_t predictions = 0, stale_events = 0, shell_exits = 0;
  };
  const Statistics& statistics() const { return statistics_; }
  double mean_neighbours() const;

 private:
  struct Event {
    std::int32_t partner;              // none: the particle leaves its shell
    std::uint32_t partner_collisions;  // when the event was predicted: more by now, and it will not happen
  };
  static constexpr std::int32_t none = -1;
  static constexpr double never = std::numeric_limits<double>::infinity();
  // The nearest image of the difference d of two coordinates that are both in the box.
  static double nearest(double d, double length) {
    if (d > 0.5 * length) return d - length;
    if (d < -0.5 * length) return d + length;
    return d;
  }
  // Tells whether two particles with references in the box can touch before either leaves its shell.
  struct Encounters {
    Box box;
    double swollen, shells;  // largest radius until the horizon, in radii; two shells [sigma]

    bool possible(const Point& at, double radius, const Point& other, double other_radius) const;
  };

  void choose_shell();
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
  std::int32_t* list(std::size_t i) { return lists_.data() + i * list_capacity_; }
  Encounters encounters() const { return {box_, growth_ > 0.0 ? 1.0 + growth_ * horizon_ : 1.0, 2.0 * shell_}; }
  template <class Visit>
  void for_each_neighbour(std::size_t i, Visit visit);
  void append(std::size_t i, std::int32_t neighbour);
  void remove(std::size_t i, std::int32_t neighbour);
  void grow_lists();
  void rebuild_list(std::size_t i);
  double shell_exit(std::size_t i) const;
  // Finds the next event of particle i; the result is its time.
  double predict(std::size_t i);
  void bounce(std::size_t i, std::size_t j);
  // Processes the next event; true if it was a collision.
  bool next_event();

  const kernels::KernelTable* table_;
  Box box_;
  std::vector<double> masses_;
  double growth_;
  std::vector<kernels::FlyingSphere, AlignedAllocator<kernels::FlyingSphere>> spheres_;
  std::vector<Point> images_;  // whole boxes left behind
  double now_ = 0.0, time_base_ = 0.0;
  std::uint64_t collisions_ = 0;
  double virial_ = 0.0;
  bool fresh_ = false;  // nothing has happened since the last resynchronisation

  // Follows from the above at each resynchronisation.
  double shell_ = 0.0, largest_radius_ = 0.0, horizon_ = 0.0;
  CellGrid grid_;
  std::vector<Point> references_;  // where each list was built
  std::size_t list_capacity_ = 32;
  std::vector<std::int32_t> lists_, list_sizes_;
  EventCalendar calendar_;
  std::vector<Event> events_;
  std::vector<std::uint32_t> collisions_of_;
  Statistics statistics_;
};

}  // namespace lanescape
