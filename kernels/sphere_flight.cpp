// Event-driven dynamics: the first collision of one sphere among its neighbours, and the calendar of events.

#include "kernel_declarations.hpp"
#include "simd/simd.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

namespace {

// The earliest event of all lanes. For equal times it takes the first in the list, whatever the number of lanes.
CollisionEvent first_of(const CollisionQuery& query, const Vector& earliest, const Vector& place) {
  const double wait = reduce_min(earliest);
  if (!(wait < __builtin_inf())) return {__builtin_inf(), -1};
  const double first = reduce_min(select(equal(earliest, broadcast(wait)), place, broadcast(__builtin_inf())));
  return {query.now + wait, query.neighbours[static_cast<std::size_t>(first)]};
}

}  // namespace

// t = [-b - sqrt(b^2 - v^2 (r^2 - s^2))]/v^2 ([G] Eq. 3.45), written as (r^2 - s^2)/[sqrt(...) - b], which loses no digits when the
// spheres are nearly in contact. Products and sums are rounded one by one and no sum crosses lanes, so every instruction set finds
// the same time to the bit.
CollisionEvent sphere_first_collision(const CollisionQuery& query) noexcept {
  const FlyingSphere& self = query.spheres[query.self];
  const double flown = query.now - self.time;
  const Vector x = broadcast(self.x + self.vx * flown), y = broadcast(self.y + self.vy * flown),
               z = broadcast(self.z + self.vz * flown);
  const Vector vx = broadcast(self.vx), vy = broadcast(self.vy), vz = broadcast(self.vz), now = broadcast(query.now);
  const Vector lx = broadcast(query.box[0]), ly = broadcast(query.box[1]), lz = broadcast(query.box[2]);
  const Vector inverse_lx = broadcast(1.0 / query.box[0]), inverse_ly = broadcast(1.0 / query.box[1]),
               inverse_lz = broadcast(1.0 / query.box[2]);
  const Vector zero = broadcast(0.0), swell = broadcast(1.0 + query.growth * query.now), growth = broadcast(query.growth);
  const Vector radius = broadcast(self.radius);

  Vector earliest = broadcast(__builtin_inf()), place = zero;
  for (std::size_t k = 0; k < query.count; k += lanes) {
    Vector other[8];
    gather_records(&query.spheres[0].x, query.neighbours + k, other);
    const Vector lag = now - other[6];
    Vector dx = (other[0] + other[3] * lag) - x, dy = (other[1] + other[4] * lag) - y, dz = (other[2] + other[5] * lag) - z;
    dx = dx - lx * nearest_whole(dx * inverse_lx);
    dy = dy - ly * nearest_whole(dy * inverse_ly);
    dz = dz - lz * nearest_whole(dz * inverse_lz);
    const Vector wx = other[3] - vx, wy = other[4] - vy, wz = other[5] - vz;
    const Vector sum = radius + other[7];
    const Vector s = sum * swell, a = sum * growth;
    const Vector b = ((dx * wx + dy * wy) + dz * wz) - s * a;
    const Vector c = ((dx * dx + dy * dy) + dz * dz) - s * s;
    const Vector w2 = ((wx * wx + wy * wy) + wz * wz) - a * a;
    const Vector discriminant = b * b - w2 * c;
    // Spheres hit if they approach, or if their surfaces grow faster than their centres separate (w2 < 0).
    const Mask there = lanes_below(static_cast<std::ptrdiff_t>(query.count) - static_cast<std::ptrdiff_t>(k));
    Mask hits = both(either(less(b, zero), less(w2, zero)), and_not(there, less(discriminant, zero)));
    if (!any(hits)) continue;
    const Vector wait = maximum(c / (square_root(maximum(discriminant, zero)) - b), zero);
    hits = both(hits, less(wait, earliest));
    earliest = select(hits, wait, earliest);
    place = select(hits, count_from(static_cast<double>(k)), place);
  }
  return first_of(query, earliest, place);
}

void calendar_update(const CalendarView& calendar, std::size_t event, double time) noexcept {
  constexpr std::size_t vectors = calendar_block / lanes;
  std::size_t entry = event;
  auto winner = static_cast<std::int32_t>(event);
  for (std::size_t level = 0; level + 1 < calendar.levels; ++level) {
    double* const times = calendar.times[level];
    const std::size_t block = entry / calendar_block, first = block * calendar_block;
    // The new entry is inserted in registers: a vector load right after a scalar store would stall.
    Vector entries[vectors];
    Vector least = broadcast(__builtin_inf());
    const Vector changed = broadcast(static_cast<double>(entry - first)), new_time = broadcast(time);
#pragma GCC unroll 8
    for (std::size_t v = 0; v < vectors; ++v) {
      entries[v] = select(equal(count_from(static_cast<double>(v * lanes)), changed), new_time, load(times + first + v * lanes));
      least = minimum(least, entries[v]);
    }
    times[entry] = time;
    if (level > 0) calendar.winners[level][entry] = winner;
    const double lowest = reduce_min(least);
    unsigned mask = 0;
#pragma GCC unroll 8
    for (std::size_t v = 0; v < vectors; ++v) mask |= bits(equal(entries[v], broadcast(lowest))) << (v * lanes);
    const std::size_t best = first + static_cast<std::size_t>(__builtin_ctz(mask));
    if (best != entry) winner = level == 0 ? static_cast<std::int32_t>(best) : calendar.winners[level][best];
    if (calendar.times[level + 1][block] == lowest && calendar.winners[level + 1][block] == winner) return;
    entry = block;
    time = lowest;
  }
  calendar.times[calendar.levels - 1][0] = time;
  calendar.winners[calendar.levels - 1][0] = winner;
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
