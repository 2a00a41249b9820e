#include "verification/event_driven_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/aligned_array.hpp"
#include "core/padded.hpp"
#include "core/random.hpp"
#include "dynamics/event_calendar.hpp"
#include "reference/event_driven.hpp"
#include "reference/hard_sphere.hpp"
#include "verification/check.hpp"

namespace lanescape {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A sphere and its neighbours, each at its own time.
struct FlightCase {
  std::vector<kernels::FlyingSphere, AlignedAllocator<kernels::FlyingSphere>> spheres;
  std::vector<std::int32_t> neighbours;
  std::size_t count;
  double now, growth;
  reference::Vector box;

  FlightCase(std::size_t neighbours_wanted, std::uint64_t which, double growth_rate, double speed)
      : neighbours(padded(neighbours_wanted), 0), count(neighbours_wanted), now(1.5), growth(growth_rate), box{5.0, 6.0, 4.5} {
    const CounterRandom random(5, RandomStream::displacements);
    for (std::uint32_t i = 0; i < neighbours_wanted + 5; ++i) {
      auto draw = [&, k = 0U]() mutable { return random.uniform(which, i, k++); };
      kernels::FlyingSphere s{};
      s.radius = 0.4 + 0.2 * draw();
      s.time = 1.5 * draw();
      s.vx = speed * (2.0 * draw() - 1.0);
      s.vy = speed * (2.0 * draw() - 1.0);
      s.vz = speed * (2.0 * draw() - 1.0);
      // At most a few boxes away, as between two resynchronisations.
      s.x = 2.0 * box[0] * draw() - box[0];
      s.y = 2.0 * box[1] * draw() - box[1];
      s.z = 2.0 * box[2] * draw() - box[2];
      spheres.push_back(s);
    }
    // The neighbours of sphere 2 in a shuffled order; the entries after them are padding.
    for (std::size_t k = 0; k < count; ++k) neighbours[k] = static_cast<std::int32_t>(3 + (count + 4 - k) % count);
  }

  // Places a sphere at the distance s(now) + gap from sphere 2. It moves away at the rate `parting` (approaches if negative)
  // relative to the growing surfaces.
  void place_near_contact(std::int32_t which, double gap, double parting) {
    const kernels::FlyingSphere& self = spheres[2];
    kernels::FlyingSphere& s = spheres[static_cast<std::size_t>(which)];
    const double sum = self.radius + s.radius, r = sum * (1.0 + growth * now) + gap, rate = sum * growth + parting;
    s.time = now;
    s.x = self.x + self.vx * (now - self.time) + r * 0.6;
    s.y = self.y + self.vy * (now - self.time) - r * 0.8;
    s.z = self.z + self.vz * (now - self.time);
    s.vx = self.vx + rate * 0.6;
    s.vy = self.vy - rate * 0.8;
    s.vz = self.vz;
  }

  reference::FreeSphere free(std::int32_t which) const {
    const kernels::FlyingSphere& s = spheres[static_cast<std::size_t>(which)];
    return {{s.x, s.y, s.z}, {s.vx, s.vy, s.vz}, s.time, s.radius, s.radius * growth};
  }
  kernels::CollisionEvent find(const kernels::KernelTable& table) const {
    return table.sphere_first_collision({spheres.data(), neighbours.data(), count, 2, now, growth, {box[0], box[1], box[2]}});
  }
  kernels::CollisionEvent expected() const {
    kernels::CollisionEvent first{infinity, -1};
    for (std::size_t k = 0; k < count; ++k) {
      const double time = reference::collision_time(free(2), free(neighbours[k]), now, box);
      if (time < first.time) first = {time, neighbours[k]};
    }
    return first;
  }
  // |r - s| of a pair at a time, relative to s plus coordinates and the distances flown.
  double off_contact(std::int32_t partner, double time) const {
    const kernels::FlyingSphere &a = spheres[2], &b = spheres[static_cast<std::size_t>(partner)];
    const auto at = [](double x, double v, double start, double t) {
      return static_cast<long double>(x) + static_cast<long double>(v) * (static_cast<long double>(t) - start);
    };
    const std::array<double, 3> xa = {a.x, a.y, a.z}, xb = {b.x, b.y, b.z}, va = {a.vx, a.vy, a.vz}, vb = {b.vx, b.vy, b.vz};
    long double squared = 0.0L, flown = 0.0L;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // The image that is nearest at `now`.
      const long double d_now = at(xb[axis], vb[axis], b.time, now) - at(xa[axis], va[axis], a.time, now);
      const long double d = at(xb[axis], vb[axis], b.time, time) - at(xa[axis], va[axis], a.time, time) -
                            box[axis] * std::nearbyint(d_now / box[axis]);
      squared += d * d;
      flown += std::abs(xa[axis]) + std::abs(xb[axis]) +
               std::abs(static_cast<long double>(vb[axis]) - va[axis]) * (static_cast<long double>(time) - now);
    }
    const long double s = (static_cast<long double>(a.radius) + b.radius) * (1.0L + static_cast<long double>(growth) * time);
    return relative(std::sqrt(squared), s, s + flown);
  }
};

struct FlightChecks {
  Check exact, growing, calendar;

  explicit FlightChecks(const kernels::KernelTable& table)
      : exact(table, "sphere_first_collision", tolerance::exact),
        growing(table, "sphere_first_collision growing", tolerance::growing_contact),
        calendar(table, "calendar_update", tolerance::exact) {}

  void add_exact(const std::string& name, const FlightCase& flight, const kernels::KernelTable& table) {
    const kernels::CollisionEvent found = flight.find(table), wanted = flight.expected();
    exact.add(name, !same_bits(found.time, wanted.time) + (found.partner != wanted.partner));
  }
  void add_growing(const std::string& name, const FlightCase& flight, const kernels::KernelTable& table) {
    const kernels::CollisionEvent found = flight.find(table), wanted = flight.expected();
    if (found.partner != wanted.partner || found.partner < 0 || !(found.time >= flight.now))
      growing.add(name, found.partner == wanted.partner && found.time == wanted.time ? 0.0 : infinity);
    else if (wanted.time > flight.now)  // otherwise they overlap already and collide at once
      growing.add(name, flight.off_contact(found.partner, found.time));
    else
      growing.add(name, found.time != flight.now);
  }

  void run_flights(const kernels::KernelTable& table) {
    for (std::size_t n = 0; n <= 17; ++n)
      for (std::uint64_t which = 0; which < 12; ++which) {
        const std::string name = fmt::format("{} neighbours, draw {}", n, which);
        add_exact(name, FlightCase(n, which, 0.0, 1.0), table);
        for (const double growth : {1e-3, 0.1, 0.5})
          for (const double speed : {0.02, 0.07, 0.4, 1.0})
            add_growing(fmt::format("{}, growth {}, speed {}", name, growth, speed), FlightCase(n, which, growth, speed), table);
      }
  }

  // Just before and just after a collision, which leaves gaps of a few roundings of either sign; and centres that separate nearly
  // as fast as the surfaces grow.
  void run_contacts(const kernels::KernelTable& table) {
    for (const std::size_t n : {1U, 8U, 9U})
      for (const double gap : {0.0, 1e-16, 4e-16, -4e-16, 1e-12, -1e-12, 1e-6, 0.5})
        for (const double parting : {-1.0, -1e-3, -1e-6, 1e-3, 1.0})
          for (const double growth : {0.0, 1e-3, 0.1}) {
            FlightCase flight(n, 20, growth, 0.01);
            flight.place_near_contact(flight.neighbours[n - 1], gap, parting);
            const std::string name = fmt::format("{} neighbours, gap {}, parting {}, growth {}", n, gap, parting, growth);
            growth > 0.0 ? add_growing(name, flight, table) : add_exact(name, flight, table);
          }
  }

  // If several spheres collide at the same time, the first in the list is the result.
  void run_ties(const kernels::KernelTable& table) {
    for (std::size_t n = 2; n <= 17; ++n)
      for (std::size_t first = 0; first < n; ++first) {
        FlightCase flight(n, 30, 0.0, 0.01);
        flight.place_near_contact(flight.neighbours[first], 0.25, -100.0);
        for (std::size_t k = first + 3; k < n; k += 3)
          flight.spheres[static_cast<std::size_t>(flight.neighbours[k])] =
              flight.spheres[static_cast<std::size_t>(flight.neighbours[first])];
        const std::string name = fmt::format("{} neighbours, every third hits from {} on", n, first);
        if (flight.expected().partner != flight.neighbours[first]) exact.add(name + ": no such case", infinity);
        add_exact(name, flight, table);
      }
  }

  // Random updates, a fifth of them to times already present or to infinity. The result must be the first of the smallest times.
  void run_calendar(std::size_t events, const kernels::KernelTable& table) {
    const CounterRandom random(6, RandomStream::displacements);
    EventCalendar tested(events, table);
    std::vector<double> times(events, infinity);
    const std::string name = fmt::format("{} events", events);
    const auto wrong = [&] {
      const auto first = static_cast<std::size_t>(std::min_element(times.begin(), times.end()) - times.begin());
      return (tested.first() != first) + !same_bits(tested.first_time(), times[first]);
    };
    double count = 0.0;
    const auto draw = [&](std::uint32_t step) {
      const double time = random.uniform(events, step, 0);
      return random.below(5, events, step, 1) > 0 ? time : time < 0.2 ? infinity : std::floor(10.0 * time) / 10.0;
    };
    for (std::uint32_t k = 0; k < events; ++k) times[k] = draw(k);
    tested.assign(times);
    count += wrong();
    for (std::uint32_t k = 0; k < 2000; ++k) {
      // As in a run, it is mostly the first event that is replaced, by a later one.
      const auto step = static_cast<std::uint32_t>(events) + k;
      const bool first = random.below(3, events, step, 2) > 0;
      const std::size_t event = first ? tested.first() : random.below(static_cast<std::uint32_t>(events), events, step, 3);
      if (event >= events) break;  // already counted as wrong
      times[event] = draw(step) + (first ? 1e-3 * k : 0.0);
      tested.update(event, times[event]);
      count += wrong();
    }
    calendar.add(name, count);
  }
};

}  // namespace

std::vector<Deviation> verify_event_driven(const kernels::KernelTable& table) {
  FlightChecks flight(table);
  flight.run_flights(table);
  flight.run_contacts(table);
  flight.run_ties(table);
  for (const std::size_t events : {1U, 2U, 15U, 16U, 17U, 255U, 256U, 257U, 4097U}) flight.run_calendar(events, table);
  return {flight.exact.deviation, flight.growing.deviation, flight.calendar.deviation};
}

}  // namespace lanescape
