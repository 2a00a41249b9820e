#include "reference/event_driven.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reference/hard_sphere.hpp"
#include "reference/separation.hpp"

namespace lanescape::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vector position_at(const FreeSphere& sphere, double time) {
  Vector p;
  for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = sphere.position[axis] + sphere.velocity[axis] * (time - sphere.time);
  return p;
}

}  // namespace

// |d + w tau| = s + a tau, squared: f(tau) = p tau^2 + 2 q tau + c = 0 with p = w2 - a^2, q = d.w - s a, c = r2 - s^2. The
// collision is at the first tau >= 0 after which f is negative. Without growth p = w2 and q = b.
// - q < 0, c <= 0: in contact or overlapping, and approaching: now.
// - q < 0, c > 0: the smaller root if p > 0, the only positive one if p <= 0: (-q - sqrt(q^2 - p c))/p in both cases. Near contact
// this
//   formula subtracts two nearly equal numbers, and p may vanish; c/(sqrt(q^2 - p c) - q), the same root, adds two positive ones
//   and is as exact as c.
// - q >= 0, p >= 0: f does not decrease; never.
// - q >= 0, p < 0: the surfaces separate at first and meet later because of growth; f falls through zero at the larger root,
//   (-q - sqrt(q^2 - p c))/p, here without cancellation. If there is no root they overlap at all times.
double collision_time(const FreeSphere& i, const FreeSphere& j, double now, const Vector& box) {
  const Vector d = separation(position_at(i, now).data(), position_at(j, now).data(), box);
  Vector w;
  for (std::size_t axis = 0; axis < 3; ++axis) w[axis] = j.velocity[axis] - i.velocity[axis];
  const double s = (i.radius + i.growth * now) + (j.radius + j.growth * now);
  const double a = i.growth + j.growth;
  const double p = dot(w, w) - a * a;
  const double q = dot(d, w) - s * a;
  const double c = dot(d, d) - s * s;

  if (q >= 0.0 && p >= 0.0) return kInfinity;
  if (q < 0.0 && c <= 0.0) return now;
  const double discriminant = q * q - p * c;
  if (discriminant < 0.0) return kInfinity;
  const double root = std::sqrt(discriminant);
  const double tau = q < 0.0 ? c / (root - q) : (-q - root) / p;
  if (s + a * tau < 0.0) return kInfinity;  // the spheres have shrunk to nothing: a root of the square only
  return now + std::max(tau, 0.0);
}

double image_horizon(const std::vector<FreeSphere>& spheres, const Vector& box) {
  double radius = 0.0;
  double speed_squared = 0.0;
  for (const FreeSphere& sphere : spheres) {
    radius = std::max(radius, sphere.radius);
    speed_squared = std::max(speed_squared, dot(sphere.velocity, sphere.velocity));
  }
  const double room = 0.5 * std::min({box[0], box[1], box[2]}) - 2.0 * radius;
  if (!(room > 0.0)) throw std::invalid_argument("image_horizon: every box edge must exceed two of the largest diameters");
  return speed_squared > 0.0 ? room / (2.0 * std::sqrt(speed_squared)) : kInfinity;
}

Contact fly_to_contact(std::vector<FreeSphere>& spheres, const Vector& box, double until) {
  check_box(box);
  if (!std::isfinite(until)) throw std::invalid_argument("fly_to_contact: the time to stop at must be finite");
  if (spheres.empty() || until < spheres.front().time) return {};
  for (;;) {
    const double now = spheres.front().time;
    Contact first;
    for (std::size_t i = 0; i < spheres.size(); ++i)
      for (std::size_t j = i + 1; j < spheres.size(); ++j) {
        const double time = collision_time(spheres[i], spheres[j], now, box);
        if (time < first.time) first = {time, i, j};
      }
    const double horizon = now + image_horizon(spheres, box);
    const double target = std::min({first.time, horizon, until});
    for (FreeSphere& sphere : spheres) {
      sphere.position = position_at(sphere, target);
      sphere.time = target;
    }
    if (first.time <= target) return first;
    if (until <= target) return {};
  }
}

Collision elastic_collision(const Vector& separation, const Vector& relative_velocity, double mass_i, double mass_j) {
  if (!(mass_i > 0.0) || !(mass_j > 0.0)) throw std::invalid_argument("elastic_collision: masses must be positive");
  const double b = dot(separation, relative_velocity);
  const double b_over_r2 = b / dot(separation, separation);
  Collision collision;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    collision.velocity_change_i[axis] = 2.0 * mass_j / (mass_i + mass_j) * b_over_r2 * separation[axis];
    collision.velocity_change_j[axis] = -2.0 * mass_i / (mass_i + mass_j) * b_over_r2 * separation[axis];
  }
  collision.virial = 2.0 * (mass_i * mass_j / (mass_i + mass_j)) * std::abs(b);
  return collision;
}

EventDriven::EventDriven(std::span<const double> positions, std::span<const double> velocities, std::span<const double> radii,
                         std::span<const double> masses, const Vector& box)
    : spheres_(radii.size()), masses_(masses.begin(), masses.end()), box_(box) {
  check(positions, radii, box);
  if (velocities.size() != positions.size() || masses.size() != radii.size())
    throw std::invalid_argument("EventDriven: three velocity components and one mass are needed for each particle");
  for (const double mass : masses)
    if (!(mass > 0.0)) throw std::invalid_argument("EventDriven: masses must be positive");
  if (any_overlap(positions, radii, box)) throw std::invalid_argument("EventDriven: the spheres overlap at the start");
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    spheres_[i].radius = radii[i];
    std::copy_n(&positions[3 * i], 3, spheres_[i].position.begin());
    std::copy_n(&velocities[3 * i], 3, spheres_[i].velocity.begin());
  }
}

bool EventDriven::step(double until) {
  const Contact contact = fly_to_contact(spheres_, box_, until);
  time_ = std::max(time_, std::min(contact.time, until));
  if (contact.time > until) return false;
  FreeSphere& i = spheres_[contact.i];
  FreeSphere& j = spheres_[contact.j];
  Vector w;
  for (std::size_t axis = 0; axis < 3; ++axis) w[axis] = j.velocity[axis] - i.velocity[axis];
  const Collision collision =
      elastic_collision(separation(i.position.data(), j.position.data(), box_), w, masses_[contact.i], masses_[contact.j]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    i.velocity[axis] += collision.velocity_change_i[axis];
    j.velocity[axis] += collision.velocity_change_j[axis];
  }
  virial_ += collision.virial;
  ++collisions_;
  return true;
}

double EventDriven::kinetic_energy() const {
  double energy = 0.0;
  for (std::size_t i = 0; i < spheres_.size(); ++i) energy += 0.5 * masses_[i] * dot(spheres_[i].velocity, spheres_[i].velocity);
  return energy;
}

std::vector<double> EventDriven::positions() const {
  std::vector<double> all;
  for (const FreeSphere& sphere : spheres_) all.insert(all.end(), sphere.position.begin(), sphere.position.end());
  return all;
}

std::vector<double> EventDriven::velocities() const {
  std::vector<double> all;
  for (const FreeSphere& sphere : spheres_) all.insert(all.end(), sphere.velocity.begin(), sphere.velocity.end());
  return all;
}

double EventDriven::compressibility() const {
  const double n = static_cast<double>(spheres_.size());
  const double temperature = 2.0 * kinetic_energy() / (3.0 * n - 3.0);
  return 1.0 + virial_ / (3.0 * n * temperature * time_);
}

}  // namespace lanescape::reference
