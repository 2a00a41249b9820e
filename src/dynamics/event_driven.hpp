#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "configuration/configuration.hpp"
#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "dynamics/event_calendar.hpp"
#include "kernel_table.hpp"
#include "neighbour/cell_grid.hpp"

namespace lanescape {

// Hard spheres of any diameters and masses in free flight between elastic collisions ([G] 3.2.3.1), event by event and exact:
// each particle keeps its own time and its earliest event, a calendar finds the first of all, neighbour lists bound the
// search. Time in sigma sqrt(m / k_B T).
//
// A particle's list holds every other one that it can touch before either leaves a sphere of radius `shell` around the place
// its list was made at; leaving is an event. Every resync_interval() collisions, at counts that depend on nothing else, all
// particles are brought to one time, which becomes zero again, and lists and calendar are made anew: rounding then never
// grows with time, and a state between two collisions at such a count is positions, velocities and counters alone.
class EventDriven {
 public:
  // At rest. `masses` per particle. `growth`: diameters grow by this share of themselves per unit of time, of what they were at the
  // last resynchronisation. Spheres must not overlap; throws Error(bad_input) where the box is shorter than 2.05 of the largest
  // diameter, where a particle would meet two images of another.
  EventDriven(const Configuration& start, std::vector<double> masses, const kernels::KernelTable& table, double growth = 0.0);

  // Maxwell's distribution, total momentum removed, then sum m v^2 / 2 = (3/2) N T with T = 1, the source's convention.
  void draw_velocities(std::uint64_t seed);
  // Sets velocities (3N, the user's order) as they are.
  void set_velocities(const std::vector<double>& velocities);
  // Removes the total momentum and scales to T = 1.
  void rescale();

  // The next collision; nothing else changes the state. Must not be called where there is none to come: with all at rest.
  void collide();
  // Lets time pass up to `time` since the start, with all collisions until then.
  void advance_to(double time);
  // Everything to one time, lists and calendar anew. The counts at which this happens influence the bits of what follows.
  void resynchronise();

  // 256 per particle, at most 100,000, but 4 per particle at least: long before a time has lost four digits, and seldom enough to
  // cost little, as each takes O(N).
  std::uint64_t resync_interval() const {
    return std::max<std::uint64_t>(std::min<std::uint64_t>(100'000, 256 * size()), 4 * size());
  }

  std::size_t size() const { return spheres_.size(); }
  const Box& box() const { return box_; }
  std::uint64_t collisions() const { return collisions_; }
  double time() const { return time_base_ + now_; }  // of the last event, or that advance_to() was given
  double next_event_time() const { return time_base_ + calendar_.first_time(); }
  double kinetic_energy() const;
  std::array<double, 3> momentum() const;
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

  // Only right after resynchronise(), or at a multiple of resync_interval() collisions, does a state that is read go on with the
  // same bits as the one that was written.
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
  // Of two with references inside the box, whether they can touch before either leaves its shell.
  struct Encounters {
    Box box;
    double swollen, shells;  // radii until the horizon, in radii; two shells [sigma]

    bool possible(const std::array<double, 3>& at, double radius, const std::array<double, 3>& other, double other_radius) const;
  };

  void choose_shell();
  void make_lists();
  void make_calendar();
  void positions_at(double now, std::vector<double>& out) const;
  double swell() const { return 1.0 + growth_ * now_; }
  void bring_to_now(std::size_t i);
  void wrap(std::size_t i);
  std::int32_t* list(std::size_t i) { return lists_.data() + i * list_capacity_; }
  Encounters encounters() const { return {box_, growth_ > 0.0 ? 1.0 + growth_ * horizon_ : 1.0, 2.0 * shell_}; }
  template <class Visit>
  void for_each_neighbour(std::size_t i, Visit visit);
  void append(std::size_t i, std::int32_t neighbour);
  void remove(std::size_t i, std::int32_t neighbour);
  void grow_lists();
  void renew_list(std::size_t i);
  double shell_exit(std::size_t i) const;
  // Finds particle i's next event from now on.
  double predict(std::size_t i);
  void bounce(std::size_t i, std::size_t j);
  // Whatever comes next; whether it was a collision.
  bool next_event();

  const kernels::KernelTable* table_;
  Box box_;
  std::vector<double> masses_;
  double growth_;
  std::vector<kernels::FlyingSphere, AlignedAllocator<kernels::FlyingSphere>> spheres_;
  std::vector<std::array<double, 3>> images_;  // whole boxes left behind
  double now_ = 0.0, time_base_ = 0.0;
  std::uint64_t collisions_ = 0;
  double virial_ = 0.0;
  bool fresh_ = false;  // nothing has happened since the last resynchronisation

  // Follows from the above at each resynchronisation.
  double shell_ = 0.0, largest_radius_ = 0.0, horizon_ = 0.0;
  CellGrid grid_;
  std::vector<std::array<double, 3>> references_;  // where each list was made
  std::size_t list_capacity_ = 32;
  std::vector<std::int32_t> lists_, list_sizes_;
  EventCalendar calendar_;
  std::vector<Event> events_;
  std::vector<std::uint32_t> collisions_of_;
  Statistics statistics_;
};

}  // namespace lanescape
