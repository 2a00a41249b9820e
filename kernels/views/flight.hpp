#pragma once

#include <cstddef>
#include <cstdint>

#include "views/layout.hpp"

// Hard spheres in flight: collisions and their calendar.
namespace lanescape::kernels {

// A sphere in free flight: its position at its own time. Eight doubles, one cache line.
struct alignas(64) FlyingSphere {
  double x, y, z;     // [sigma]
  double vx, vy, vz;  // [sigma / time]
  double time;        // of the position
  double radius;      // at time 0 [sigma]
};

// The first collision of one sphere with its neighbours after `now`.
struct CollisionQuery {
  const FlyingSphere* spheres;
  const std::int32_t* neighbours;  // room for a multiple of slot_padding; valid indices in all of it
  std::size_t count;
  std::size_t self;
  double now;
  double growth;  // radii are radius (1 + growth time)
  double box[3];
};

struct CollisionEvent {
  double time;           // infinity if there is none
  std::int32_t partner;  // -1 if there is none
};

// A tournament tree over event times. Level 0 holds the times themselves. Each later level holds the smallest of every block of
// calendar_block entries, and the index of its event. Entries beyond the last are infinite. The top level has one block.
inline constexpr std::size_t calendar_block = 16;
inline constexpr std::size_t calendar_levels = 8;
struct CalendarView {
  double* times[calendar_levels];
  std::int32_t* winners[calendar_levels];  // from level 1 on
  std::size_t levels;                      // at least 2; the last has one entry
};

}  // namespace lanescape::kernels
