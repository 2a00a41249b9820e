#include "dynamics/event_driven.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "dynamics/maxwell.hpp"

namespace lanescape {
namespace {

// Least box edge, in largest diameters: in a shorter box a sphere could collide with two images of another.
constexpr double least_box = 2.05;
// Spheres that never meet leave their shells for ever.
constexpr std::uint64_t most_events_between_collisions = 10'000'000;

// For the functions of dynamics/maxwell.hpp.
template <class Spheres>
auto particles_of(Spheres& spheres, const AlignedArray& masses, const std::vector<std::uint32_t>& slot_of) {
  return [&spheres, &masses, &slot_of](auto action) {
    for (const std::uint32_t s : slot_of) action(masses[s], spheres[s].vx, spheres[s].vy, spheres[s].vz);
  };
}

}  // namespace

EventDriven::EventDriven(const Configuration& start, const std::vector<double>& masses, const kernels::KernelTable& table,
                         double growth)
    : table_(&table),
      box_(start.box),
      growth_(growth),
      slot_of_(start.size()),
      masses_(masses.begin(), masses.end()),
      spheres_(start.size()),
      images_(start.size()),
      grid_(start.box, start.box.shortest(), 0),
      shell_of_(start.size()),
      list_sizes_(start.size(), 0),
      found_(start.size()),
      calendar_(start.size(), table),
      events_(start.size()),
      collisions_of_(start.size(), 0) {
  check_periodic(box_, "event-driven dynamics");
  std::iota(slot_of_.begin(), slot_of_.end(), 0U);
  for (std::size_t i = 0; i < size(); ++i)
    spheres_[i] = {start.positions[3 * i], start.positions[3 * i + 1], start.positions[3 * i + 2], 0.0, 0.0, 0.0, 0.0,
                   start.radii[i]};
  largest_radius_ = *std::max_element(start.radii.begin(), start.radii.end());
  const double shortest = box_.shortest();
  if (!(shortest >= 2.0 * least_box * largest_radius_))
    throw_bad_input(
        fmt::format("box edge {} is not allowed: at least {} of the largest diameter {} is needed, or spheres could collide "
                    "with two images of another",
                    shortest, least_box, 2.0 * largest_radius_));
  resynchronise();
}

void EventDriven::draw_velocities(std::uint64_t seed) {
  draw_maxwell_velocities(particles_of(spheres_, masses_, slot_of_), [](double mass) { return 1.0 / std::sqrt(mass); }, seed);
  rescale();
}

void EventDriven::set_velocities(const std::vector<double>& velocities) {
  resynchronise();
  for (std::size_t i = 0; i < size(); ++i) {
    auto& s = spheres_[slot_of_[i]];
    s.vx = velocities[3 * i];
    s.vy = velocities[3 * i + 1];
    s.vz = velocities[3 * i + 2];
  }
  make_calendar();
}

Point EventDriven::momentum() const { return total_momentum(particles_of(spheres_, masses_, slot_of_)); }

double EventDriven::kinetic_energy() const {
  double sum = 0.0;
  for (const std::uint32_t i : slot_of_) {
    const auto& s = spheres_[i];
    sum += 0.5 * masses_[i] * (s.vx * s.vx + s.vy * s.vy + s.vz * s.vz);
  }
  return sum;
}

void EventDriven::rescale() {
  resynchronise();
  remove_momentum(particles_of(spheres_, masses_, slot_of_));
  const double kinetic = kinetic_energy();
  if (kinetic > 0.0) {
    const double factor = std::sqrt(1.5 * static_cast<double>(size()) / kinetic);
    for (auto& s : spheres_) {
      s.vx *= factor;
      s.vy *= factor;
      s.vz *= factor;
    }
  }
  make_calendar();
}

double EventDriven::compressibility(double virial_before, double time_before) const {
  const double n = static_cast<double>(size());
  const double temperature = 2.0 * kinetic_energy() / (3.0 * n - 3.0);
  return 1.0 + (virial_ - virial_before) / (3.0 * n * temperature * (time() - time_before));
}

void EventDriven::positions_at(double now, std::vector<double>& out) const {
  out.resize(3 * size());
  for (std::size_t i = 0; i < size(); ++i) {
    const auto& s = spheres_[slot_of_[i]];
    const Point& image = images_[slot_of_[i]];
    const double flown = now - s.time;
    out[3 * i] = s.x + s.vx * flown + image[0] * box_.length[0];
    out[3 * i + 1] = s.y + s.vy * flown + image[1] * box_.length[1];
    out[3 * i + 2] = s.z + s.vz * flown + image[2] * box_.length[2];
  }
}

void EventDriven::positions(double time, std::vector<double>& out) const { positions_at(time - time_base_, out); }

// Uses now_ instead of time(), whose rounding would shift spheres in contact.
std::vector<double> EventDriven::positions() const {
  std::vector<double> out;
  positions_at(now_, out);
  return out;
}

std::vector<double> EventDriven::velocities() const {
  std::vector<double> out;
  out.reserve(3 * size());
  for (const std::uint32_t i : slot_of_) out.insert(out.end(), {spheres_[i].vx, spheres_[i].vy, spheres_[i].vz});
  return out;
}

double EventDriven::mean_neighbours() const {
  double sum = 0.0;
  for (const std::int32_t n : list_sizes_) sum += n;
  return sum / static_cast<double>(size());
}

// Wraps a particle into the box, 0 <= x < L. A second call changes nothing.
void EventDriven::wrap(std::size_t i) {
  double* const position = &spheres_[i].x;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double &x = position[axis], &image = images_[i][axis];
    const double length = box_.length[axis];
    if (x >= 0.0 && x < length) continue;
    const double boxes = std::floor(x / length);
    x -= boxes * length;
    image += boxes;
    if (x < length) continue;
    // A tiny negative x is rounded to L above.
    x = 0.0;
    image += 1.0;
  }
}

void EventDriven::resynchronise() {
  const FloatEnvironment environment;
  for (std::size_t i = 0; i < size(); ++i) {
    bring_to_now(i);
    wrap(i);
    spheres_[i].time = 0.0;
    spheres_[i].radius *= swell();
  }
  largest_radius_ *= swell();
  time_base_ += now_;
  now_ = 0.0;
  choose_shell();
  if (size() >= large_from) sort_in_space();
  make_lists();
  make_calendar();
  fresh_ = true;
}

// Spheres near in space come near in memory: by cells of the grid, then by the user's numbers. So the order follows from the
// positions alone, and is the same after a resumption.
void EventDriven::sort_in_space() {
  std::vector<std::uint32_t> next(grid_.cells() + 1, 0), cell_of(size()), target(size());
  for (std::size_t i = 0; i < size(); ++i) {
    const auto& s = spheres_[i];
    cell_of[i] = static_cast<std::uint32_t>(grid_.cell_of({s.x, s.y, s.z}));
    ++next[cell_of[i] + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (std::uint32_t& slot : slot_of_) slot = target[slot] = next[cell_of[slot]]++;
  for (std::uint32_t i = 0; i < size(); ++i)
    while (target[i] != i) {
      const std::uint32_t to = target[i];
      std::swap(spheres_[i], spheres_[to]);
      std::swap(masses_[i], masses_[to]);
      std::swap(images_[i], images_[to]);
      std::swap(target[i], target[to]);
    }
}

void EventDriven::make_calendar() {
  std::vector<double> times(size());
  for (std::size_t i = 0; i < size(); ++i) times[i] = predict(i);
  calendar_.assign(times);
  outlook_ = Outlook{0, now_, outlook_.interval, now_, {}, {}};
}

bool EventDriven::next_event() {
  fresh_ = false;
  if (size() >= large_from && outlook_.events_left-- == 0) look_ahead();
  const std::size_t i = calendar_.first();
  if (calendar_.first_time() > horizon_) {
    now_ = horizon_;
    resynchronise();
    return false;
  }
  now_ = calendar_.first_time();
  const Event event = events_[i];
  if (event.partner == none) {
    ++statistics_.shell_exits;
    rebuild_list(i);
    calendar_.update(i, predict(i));
    return false;
  }
  const auto j = static_cast<std::size_t>(event.partner);
  if (collisions_of_[j] != event.partner_collisions) {
    ++statistics_.stale_events;
    calendar_.update(i, predict(i));
    return false;
  }
  bounce(i, j);
  calendar_.update(i, predict(i));
  calendar_.update(j, predict(j));
  if (collisions_ % resync_interval() == 0) resynchronise();
  return true;
}

void EventDriven::collide() {
  const FloatEnvironment environment;
  for (std::uint64_t events = 0; !next_event(); ++events)
    if (events == most_events_between_collisions)
      throw Error(ErrorCode::goal_not_reached,
                  fmt::format("no spheres collide within {} events, until time {}: they may fly side by side",
                              most_events_between_collisions, time()));
}

void EventDriven::advance_to(double time) {
  const FloatEnvironment environment;
  while (next_event_time() <= time) next_event();
  now_ = time - time_base_;
}

Configuration EventDriven::configuration() const {
  Configuration now{box_, std::vector<int>(size(), 0), positions(), {}};
  for (std::size_t i = 0; i < size(); ++i) now.radii.push_back(radius(i));
  return now;
}

void EventDriven::exchange(Archive& archive) {
  AlignedArray spheres(8 * size());
  std::vector<double> images(3 * size());
  for (std::size_t i = 0; i < size(); ++i) {
    std::copy_n(&spheres_[slot_of_[i]].x, 8, &spheres[8 * i]);
    std::copy_n(images_[slot_of_[i]].begin(), 3, &images[3 * i]);
  }
  archive.field("spheres", spheres);
  archive.field("images", images);
  archive.field("time", time_base_);
  archive.field("collisions", collisions_);
  archive.field("virial", virial_);
  if (!archive.reading()) return;
  if (spheres.size() != 8 * size() || images.size() != 3 * size())
    throw_bad_input(fmt::format("the state does not hold {} particles", size()));
  for (std::size_t i = 0; i < size(); ++i) {
    std::copy_n(&spheres[8 * i], 8, &spheres_[slot_of_[i]].x);
    std::copy_n(&images[3 * i], 3, images_[slot_of_[i]].begin());
  }
  largest_radius_ = 0.0;
  for (const auto& s : spheres_) largest_radius_ = std::max(largest_radius_, s.radius);
  now_ = 0.0;
  resynchronise();
}

}  // namespace lanescape
