// Prediction of events, and collisions.
#include <algorithm>
#include <cmath>

#include "dynamics/event_driven.hpp"

namespace lanescape {

// The time at which particle i leaves its shell if it does not collide before.
double EventDriven::shell_exit(std::size_t i) const {
  const auto& s = spheres_[i];
  const auto& at = shell_of_[i].centre;
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
  // In an elastic collision the surfaces separate as fast as they approached; surfaces also move by the growth of both radii.
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

}  // namespace lanescape
