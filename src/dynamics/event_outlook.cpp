// What the next events need is fetched into the cache before they come. In a large system it would else come from memory.
#include "core/prefetch.hpp"
#include "dynamics/event_driven.hpp"

namespace lanescape {
namespace {

constexpr int events_per_look = 12;
constexpr double looks_ahead = 3.5;  // two looks fetch more of what an event needs before it comes
constexpr std::int32_t neighbours_per_line = 16;

}  // namespace

[[gnu::always_inline]] inline void EventDriven::prefetch_particle(std::size_t i) const {
  prefetch(&spheres_[i]);
  prefetch(&lists_[i * list_capacity_]);
  prefetch(&list_sizes_[i]);
  prefetch(&shell_of_[i]);
  prefetch(&masses_[i]);
  prefetch(&collisions_of_[i]);
  calendar_.prefetch(i);
}

[[gnu::always_inline]] inline void EventDriven::prefetch_neighbours(std::size_t i) const {
  const std::int32_t* const neighbours = &lists_[i * list_capacity_];
  for (std::int32_t k = 0; k < list_sizes_[i]; ++k) {
    prefetch(&spheres_[static_cast<std::size_t>(neighbours[k])]);
    prefetch(&collisions_of_[static_cast<std::size_t>(neighbours[k])]);
  }
}

// What particle i needs to leave its shell: the lists that it is on, and the candidates for its own.
[[gnu::always_inline]] inline void EventDriven::prefetch_shells(std::size_t i) const {
  const std::int32_t* const neighbours = &lists_[i * list_capacity_];
  for (std::int32_t k = 0; k < list_sizes_[i]; ++k) prefetch(&lists_[static_cast<std::size_t>(neighbours[k]) * list_capacity_]);
  grid_.for_each_near(shell_of_[i].centre,
                      [&](std::int32_t j) __attribute__((always_inline)) { prefetch(&shell_of_[static_cast<std::size_t>(j)]); });
}

// Each look finds the events of a stretch of time and fetches their particles. The next look can read from these who collides with
// whom, and fetches the partners. The next but one can read the lists, and fetches the neighbours.
void EventDriven::look_ahead() {
  for (const std::uint32_t i : outlook_.fetched) {
    prefetch_neighbours(i);
    const auto [partner, collisions] = events_[i];
    if (partner == none)
      prefetch_shells(i);
    else if (const auto j = static_cast<std::size_t>(partner); collisions_of_[j] == collisions)
      prefetch_neighbours(j);
  }
  for (const std::uint32_t i : outlook_.found) {
    if (list_sizes_[i] > neighbours_per_line) prefetch(&lists_[i * list_capacity_ + neighbours_per_line]);
    if (events_[i].partner != none)
      prefetch_particle(static_cast<std::size_t>(events_[i].partner));
    else {
      const CellGrid::NearCells near = grid_.cells_near(grid_.cell_with(i));
      for (const std::uint32_t cell : near.all()) grid_.prefetch(cell);
    }
  }
  outlook_.fetched.swap(outlook_.found);
  outlook_.found.clear();
  outlook_.events_left = events_per_look - 1;
  outlook_.interval += 0.1 * (now_ - outlook_.time - outlook_.interval);
  outlook_.time = now_;
  const double until = now_ + looks_ahead * outlook_.interval;
  if (!(until > outlook_.until)) return;
  calendar_.for_most_between(outlook_.until, until, [&](std::size_t i) __attribute__((always_inline)) {
    prefetch(&events_[i]);
    prefetch_particle(i);
    outlook_.found.push_back(static_cast<std::uint32_t>(i));
  });
  outlook_.until = until;
}

}  // namespace lanescape
