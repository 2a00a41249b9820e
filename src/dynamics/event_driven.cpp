#include "dynamics/event_driven.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/random.hpp"

namespace lanescape {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
// Mean number of neighbours that shells are made for: two vectors of eight hold nearly every list.
constexpr double wanted_neighbours = 13.0;
// Boxes below this many largest diameters let a sphere meet two images of another.
constexpr double least_box = 2.05;
// Growth until lists are made anew, of which they know.
constexpr double growth_per_resync = 0.01;

// Of two references, both inside the box: at most one box to take off.
double nearest(double d, double length) {
  if (d > 0.5 * length) return d - length;
  if (d < -0.5 * length) return d + length;
  return d;
}

}  // namespace

EventDriven::EventDriven(const Configuration& start, std::vector<double> masses, const kernels::KernelTable& table, double growth)
    : table_(&table),
      box_(start.box),
      masses_(std::move(masses)),
      growth_(growth),
      spheres_(start.size()),
      images_(start.size()),
      grid_(start.box, start.box.shortest(), 0),
      references_(start.size()),
      list_sizes_(start.size(), 0),
      calendar_(start.size(), table),
      events_(start.size()),
      collisions_of_(start.size(), 0) {
  for (std::size_t i = 0; i < size(); ++i)
    spheres_[i] = {start.positions[3 * i], start.positions[3 * i + 1], start.positions[3 * i + 2], 0.0, 0.0, 0.0, 0.0,
                   start.radii[i]};
  largest_radius_ = *std::max_element(start.radii.begin(), start.radii.end());
  const double shortest = box_.shortest();
  if (!(shortest >= 2.0 * least_box * largest_radius_))
    throw_bad_input(
        fmt::format("box edge {} is not allowed: at least {} of the largest diameter {} is needed, or spheres meet two "
                    "images of another",
                    shortest, least_box, 2.0 * largest_radius_));
  resynchronise();
}

void EventDriven::draw_velocities(std::uint64_t seed) {
  const CounterRandom random(seed, RandomStream::velocities);
  for (std::size_t i = 0; i < size(); ++i) {
    const double width = 1.0 / std::sqrt(masses_[i]);
    const auto particle = static_cast<std::uint32_t>(i);
    spheres_[i].vx = width * random.normal(0, particle, 0);
    spheres_[i].vy = width * random.normal(0, particle, 1);
    spheres_[i].vz = width * random.normal(0, particle, 2);
  }
  rescale();
}

void EventDriven::set_velocities(const std::vector<double>& velocities) {
  resynchronise();
  for (std::size_t i = 0; i < size(); ++i) {
    spheres_[i].vx = velocities[3 * i];
    spheres_[i].vy = velocities[3 * i + 1];
    spheres_[i].vz = velocities[3 * i + 2];
  }
  make_calendar();
}

std::array<double, 3> EventDriven::momentum() const {
  std::array<double, 3> sum{};
  for (std::size_t i = 0; i < size(); ++i) {
    sum[0] += masses_[i] * spheres_[i].vx;
    sum[1] += masses_[i] * spheres_[i].vy;
    sum[2] += masses_[i] * spheres_[i].vz;
  }
  return sum;
}

double EventDriven::kinetic_energy() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    const auto& s = spheres_[i];
    sum += 0.5 * masses_[i] * (s.vx * s.vx + s.vy * s.vy + s.vz * s.vz);
  }
  return sum;
}

void EventDriven::rescale() {
  resynchronise();
  double mass = 0.0;
  for (const double m : masses_) mass += m;
  const auto drift = momentum();
  for (auto& s : spheres_) {
    s.vx -= drift[0] / mass;
    s.vy -= drift[1] / mass;
    s.vz -= drift[2] / mass;
  }
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
    const auto& s = spheres_[i];
    const double flown = now - s.time;
    out[3 * i] = s.x + s.vx * flown + images_[i][0] * box_.length[0];
    out[3 * i + 1] = s.y + s.vy * flown + images_[i][1] * box_.length[1];
    out[3 * i + 2] = s.z + s.vz * flown + images_[i][2] * box_.length[2];
  }
}

void EventDriven::positions(double time, std::vector<double>& out) const { positions_at(time - time_base_, out); }

// Not by way of time(), whose digits would part spheres in contact from where they are.
std::vector<double> EventDriven::positions() const {
  std::vector<double> out;
  positions_at(now_, out);
  return out;
}

std::vector<double> EventDriven::velocities() const {
  std::vector<double> out;
  for (const auto& s : spheres_) out.insert(out.end(), {s.vx, s.vy, s.vz});
  return out;
}

double EventDriven::mean_neighbours() const {
  double sum = 0.0;
  for (const std::int32_t n : list_sizes_) sum += n;
  return sum / static_cast<double>(size());
}

void EventDriven::bring_to_now(std::size_t i) {
  auto& s = spheres_[i];
  const double flown = now_ - s.time;
  s.x += s.vx * flown;
  s.y += s.vy * flown;
  s.z += s.vz * flown;
  s.time = now_;
}

// Into the box, 0 <= x < L: done twice it changes nothing.
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
    // A little below zero is rounded to the far face.
    x = 0.0;
    image += 1.0;
  }
}

void EventDriven::resynchronise() {
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
  make_lists();
  make_calendar();
  fresh_ = true;
}

inline bool EventDriven::Encounters::possible(const std::array<double, 3>& at, double radius, const std::array<double, 3>& other,
                                              double other_radius) const {
  const double dx = nearest(other[0] - at[0], box.length[0]), dy = nearest(other[1] - at[1], box.length[1]),
               dz = nearest(other[2] - at[2], box.length[2]);
  const double reach = (radius + other_radius) * swollen + shells;
  return dx * dx + dy * dy + dz * dz < reach * reach;
}

// As large as lists of the wanted length and the nearest-image rule allow: two particles, each up to a shell away from where
// their lists were made, must still be nearer than half the box.
void EventDriven::choose_shell() {
  horizon_ = growth_ > 0.0 ? growth_per_resync / growth_ : never;
  const double swollen = growth_ > 0.0 ? 1.0 + growth_per_resync : 1.0;
  double mean_radius = 0.0;
  for (const auto& s : spheres_) mean_radius += s.radius / static_cast<double>(size());
  const double per_neighbour = box_.volume() / static_cast<double>(size());
  const double reach = std::cbrt(wanted_neighbours * per_neighbour * 3.0 / (4.0 * std::numbers::pi));
  const double largest = 2.0 * largest_radius_ * swollen;
  const double allowed = 0.25 * (0.5 * box_.shortest() - largest);
  shell_ = std::min(allowed, std::max(0.05 * largest, 0.5 * (reach - 2.0 * mean_radius * swollen)));
  grid_ = CellGrid(box_, largest + 2.0 * shell_, size());
}

void EventDriven::make_lists() {
  for (std::size_t i = 0; i < size(); ++i) {
    references_[i] = {spheres_[i].x, spheres_[i].y, spheres_[i].z};
    grid_.insert(static_cast<std::int32_t>(i), references_[i]);
  }
  lists_.assign(size() * list_capacity_, 0);
  list_sizes_.assign(size(), 0);
  // As for_each_neighbour() would, but cell by cell from copies that lie side by side: particles near in space are far apart in
  // memory.
  struct Copy {
    std::array<double, 3> reference;
    double radius;
    std::int32_t particle;
  };
  std::vector<Copy> copies;
  std::vector<std::size_t> first;  // of each cell, and the end
  for (std::size_t cell = 0; cell < grid_.cells(); ++cell) {
    first.push_back(copies.size());
    grid_.for_each_in(cell, [&](std::int32_t j) {
      copies.push_back({references_[static_cast<std::size_t>(j)], spheres_[static_cast<std::size_t>(j)].radius, j});
    });
  }
  first.push_back(copies.size());
  const Encounters encounters = this->encounters();
  std::vector<std::int32_t> found;
  for (std::size_t cell = 0; cell < grid_.cells(); ++cell)
    for (std::size_t self = first[cell]; self < first[cell + 1]; ++self) {
      found.clear();
      for (const std::uint32_t other : grid_.cells_near(cell))
        for (std::size_t k = first[other]; k < first[other + 1]; ++k)
          if (encounters.possible(copies[self].reference, copies[self].radius, copies[k].reference, copies[k].radius) && k != self)
            found.push_back(copies[k].particle);
      const auto i = static_cast<std::size_t>(copies[self].particle);
      while (found.size() > list_capacity_) grow_lists();
      std::copy(found.begin(), found.end(), list(i));
      list_sizes_[i] = static_cast<std::int32_t>(found.size());
    }
}

void EventDriven::make_calendar() {
  std::vector<double> times(size());
  for (std::size_t i = 0; i < size(); ++i) times[i] = predict(i);
  calendar_.assign(times);
}

// Calls visit(j) for all that can touch particle i before it or they leave their shells.
template <class Visit>
void EventDriven::for_each_neighbour(std::size_t i, Visit visit) {
  const Encounters encounters = this->encounters();
  const auto& at = references_[i];
  grid_.for_each_near(at, [&](std::int32_t candidate) {
    const auto j = static_cast<std::size_t>(candidate);
    if (encounters.possible(at, spheres_[i].radius, references_[j], spheres_[j].radius) && i != j) visit(candidate);
  });
}

void EventDriven::grow_lists() {
  const std::size_t capacity = list_capacity_ + 16;
  std::vector<std::int32_t> lists(size() * capacity, 0);
  for (std::size_t i = 0; i < size(); ++i) std::copy_n(list(i), list_sizes_[i], lists.data() + i * capacity);
  lists_.swap(lists);
  list_capacity_ = capacity;
}

void EventDriven::append(std::size_t i, std::int32_t neighbour) {
  if (static_cast<std::size_t>(list_sizes_[i]) == list_capacity_) grow_lists();
  list(i)[list_sizes_[i]++] = neighbour;
}

void EventDriven::remove(std::size_t i, std::int32_t neighbour) {
  std::int32_t* const begin = list(i);
  std::int32_t* const last = begin + --list_sizes_[i];
  *std::find(begin, last, neighbour) = *last;
}

// Particle i has left its shell: a new list around where it is, and its place in the lists of others.
void EventDriven::renew_list(std::size_t i) {
  bring_to_now(i);
  wrap(i);
  references_[i] = {spheres_[i].x, spheres_[i].y, spheres_[i].z};
  const auto self = static_cast<std::int32_t>(i);
  grid_.move(self, references_[i]);
  for (std::int32_t k = 0; k < list_sizes_[i]; ++k) remove(static_cast<std::size_t>(list(i)[k]), self);
  list_sizes_[i] = 0;
  for_each_neighbour(i, [&](std::int32_t j) {
    append(i, j);
    append(static_cast<std::size_t>(j), self);
  });
}

// When particle i leaves its shell if nothing stops it.
double EventDriven::shell_exit(std::size_t i) const {
  const auto& s = spheres_[i];
  const auto& at = references_[i];
  const double flown = now_ - s.time;
  const auto from_reference = [&](double x, double v, double reference, double length) {
    return nearest(x + v * flown - reference, length);
  };
  const double dx = from_reference(s.x, s.vx, at[0], box_.length[0]), dy = from_reference(s.y, s.vy, at[1], box_.length[1]),
               dz = from_reference(s.z, s.vz, at[2], box_.length[2]);
  const double b = dx * s.vx + dy * s.vy + dz * s.vz, v2 = s.vx * s.vx + s.vy * s.vy + s.vz * s.vz;
  const double c = std::min(0.0, dx * dx + dy * dy + dz * dz - shell_ * shell_);
  if (!(v2 > 0.0)) return never;
  const double root = std::sqrt(b * b - v2 * c);
  return now_ + (b > 0.0 ? -c / (b + root) : (root - b) / v2);
}

double EventDriven::predict(std::size_t i) {
  ++statistics_.predictions;
  const kernels::CollisionEvent hit = table_->sphere_first_collision({spheres_.data(),
                                                                      list(i),
                                                                      static_cast<std::size_t>(list_sizes_[i]),
                                                                      i,
                                                                      now_,
                                                                      growth_,
                                                                      {box_.length[0], box_.length[1], box_.length[2]}});
  const double exit = shell_exit(i);
  if (hit.time <= exit && hit.partner >= 0) {
    events_[i] = {hit.partner, collisions_of_[static_cast<std::size_t>(hit.partner)]};
    return hit.time;
  }
  events_[i] = {none, 0};
  return exit;
}

void EventDriven::bounce(std::size_t i, std::size_t j) {
  bring_to_now(i);
  bring_to_now(j);
  auto &m = spheres_[i], &n = spheres_[j];
  double d[3] = {n.x - m.x, n.y - m.y, n.z - m.z};
  for (std::size_t axis = 0; axis < 3; ++axis) d[axis] = box_.nearest_image(axis, d[axis]);
  const double b = d[0] * (n.vx - m.vx) + d[1] * (n.vy - m.vy) + d[2] * (n.vz - m.vz);
  const double squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  // Surfaces part as fast as they met, the growth of both counted.
  const double swelling = growth_ > 0.0 ? growth_ * (m.radius + n.radius) * std::sqrt(squared) : 0.0;
  const double impulse = 2.0 * (b - swelling) / squared / (masses_[i] + masses_[j]);
  const double to_m = impulse * masses_[j], to_n = impulse * masses_[i];
  m.vx += to_m * d[0];
  m.vy += to_m * d[1];
  m.vz += to_m * d[2];
  n.vx -= to_n * d[0];
  n.vy -= to_n * d[1];
  n.vz -= to_n * d[2];
  virial_ += 2.0 * masses_[i] * masses_[j] / (masses_[i] + masses_[j]) * std::fabs(b);
  ++collisions_of_[i];
  ++collisions_of_[j];
  ++collisions_;
}

bool EventDriven::next_event() {
  fresh_ = false;
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
    renew_list(i);
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
  while (!next_event()) {
  }
}

void EventDriven::advance_to(double time) {
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
  std::copy_n(&spheres_[0].x, 8 * size(), spheres.begin());
  for (std::size_t i = 0; i < size(); ++i) std::copy_n(images_[i].begin(), 3, images.begin() + static_cast<std::ptrdiff_t>(3 * i));
  archive.field("spheres", spheres);
  archive.field("images", images);
  archive.field("time", time_base_);
  archive.field("collisions", collisions_);
  archive.field("virial", virial_);
  if (!archive.reading()) return;
  if (spheres.size() != 8 * size() || images.size() != 3 * size())
    throw_bad_input(fmt::format("the state holds another number of particles than {}", size()));
  std::copy_n(spheres.begin(), 8 * size(), &spheres_[0].x);
  for (std::size_t i = 0; i < size(); ++i) std::copy_n(images.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, images_[i].begin());
  largest_radius_ = 0.0;
  for (const auto& s : spheres_) largest_radius_ = std::max(largest_radius_, s.radius);
  now_ = 0.0;
  resynchronise();
}

}  // namespace lanescape
