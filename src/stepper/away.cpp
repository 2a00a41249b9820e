#include "stepper/away.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace lanescape {
namespace {

using Vector = std::array<double, 3>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double tiny = 1e-12;  // below this a vector has no direction [sigma]

double norm(const Vector& a) { return std::sqrt(dot(a, a)); }
Vector add(const Vector& a, double factor, const Vector& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

// The unit vector perpendicular to the unit vector v that leans most towards v's least axis: always the same for the same v.
Vector perpendicular(const Vector& v) {
  const auto least = std::min_element(v.begin(), v.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  Vector e{};
  e[static_cast<std::size_t>(least - v.begin())] = 1.0;
  e = add(e, -*least, v);
  return add({}, 1.0 / norm(e), e);
}

}  // namespace

AwayStepper::AwayStepper(const Box& box, const ParticleLayout& layout, const std::vector<double>& radii, HardLandscape& landscape,
                         AlignedArray goal, const Options& options)
    : box_(box),
      radii_(radii),
      slots_(layout.slots()),
      landscape_(&landscape),
      goal_array_(std::move(goal)),
      options_(options),
      goal_(radii.size()),
      position_(radii.size()),
      velocity_(radii.size()),
      corrections_(32, 0) {
  for (std::size_t i = 0; i < radii_.size(); ++i) slots_of_.push_back(layout.slot_of(i));
  const double diameter = 2.0 * *std::max_element(radii_.begin(), radii_.end());
  room_ = 0.5 * box_.shortest() - diameter;
  // A flight takes parts in inverse proportion to the room.
  if (!(room_ >= 1e-3 * diameter))
    throw_bad_input(fmt::format("away steps: a box edge of {} is too short for spheres of diameter {}: at least {} is needed",
                                box_.shortest(), diameter, 2.002 * diameter));
  read(goal_array_);
  goal_ = position_;
}

std::optional<StepKind> AwayStepper::step(const PathPoint& at, AlignedArray& next) {
  read(at.position);
  next = at.position;
  if (contact_i_ == contact_j_) {
    const Contact contact = fly();
    if (!(contact.time < 1.0)) {
      next = goal_array_;
      return accept(StepKind::direct, at.position, next);
    }
    contact_i_ = contact.i;
    contact_j_ = contact.j;
    write(next);
    if (next != at.position) return accept(StepKind::direct, at.position, next);
  }
  if (!resolve(contact_i_, contact_j_)) return std::nullopt;
  write(next);
  const auto kind = accept(StepKind::detour, at.position, next);
  if (!kind) return std::nullopt;
  contact_i_ = contact_j_ = 0;
  ++corrections_[std::min<std::size_t>(moves_, corrections_.size()) - 1];
  return kind;
}

void AwayStepper::exchange(Archive& archive, const AlignedArray&) {
  archive.field("contact_i", contact_i_);
  archive.field("contact_j", contact_j_);
  archive.field("moved", moved_);
  archive.field("violation", violation_);
  archive.field("evaluations", evaluations_);
  archive.field("corrections", corrections_);
}

void AwayStepper::read(const AlignedArray& position) {
  for (std::size_t i = 0; i < slots_of_.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) position_[i][axis] = position[axis * slots_ + slots_of_[i]];
}

void AwayStepper::write(AlignedArray& position) const {
  for (std::size_t i = 0; i < slots_of_.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) position[axis * slots_ + slots_of_[i]] = position_[i][axis];
}

// Flights cannot make an overlap deeper, away steps can.
std::optional<StepKind> AwayStepper::accept(StepKind kind, const AlignedArray& from, const AlignedArray& to) {
  const double violation = landscape_->violation(to);
  ++evaluations_;
  if (kind == StepKind::detour && violation > slack) {
    fail(fmt::format("spheres overlap by {:.3g} after an away step", violation));
    return std::nullopt;
  }
  violation_ = violation;
  moved_ = 0;
  for (const std::size_t s : slots_of_)
    if (from[s] != to[s] || from[slots_ + s] != to[slots_ + s] || from[2 * slots_ + s] != to[2 * slots_ + s]) ++moved_;
  return kind;
}

// Moves all spheres to their first contact; none where they are free for all of the time 1.
AwayStepper::Contact AwayStepper::fly() {
  for (std::size_t i = 0; i < goal_.size(); ++i) velocity_[i] = add(goal_[i], -1.0, position_[i]);
  const double horizon = image_horizon();
  for (double now = 0.0;;) {
    const Contact first = first_contact(now);
    ++evaluations_;
    const double target = std::min({first.time, now + horizon, 1.0});
    for (std::size_t i = 0; i < position_.size(); ++i) position_[i] = add(position_[i], target - now, velocity_[i]);
    if (first.time <= target) return first;
    if (target >= 1.0) return {};
    now = target;
  }
}

// Of nearest images as they are now. |d + w tau| = s has the first root tau = c / (sqrt(b^2 - w^2 c) - b), b = d.w < 0,
// c = d^2 - s^2: without cancellation where c is small.
AwayStepper::Contact AwayStepper::first_contact(double now) const {
  Contact first;
  for (std::size_t i = 0; i < position_.size(); ++i)
    for (std::size_t j = i + 1; j < position_.size(); ++j) {
      const Vector d = separation(position_[i], j);
      const Vector w = add(velocity_[j], -1.0, velocity_[i]);
      const double b = dot(d, w);
      if (b >= 0.0) continue;
      const double s = radii_[i] + radii_[j];
      const double c = dot(d, d) - s * s;
      const double discriminant = b * b - dot(w, w) * c;
      if (c > 0.0 && discriminant < 0.0) continue;
      const double time = c > 0.0 ? now + c / (std::sqrt(discriminant) - b) : now;
      if (time < first.time) first = {time, i, j};
    }
  return first;
}

// A second image is at least half an edge away on one axis; two spheres at the largest speed approach it.
double AwayStepper::image_horizon() const {
  double squared = 0.0;
  for (const Vector& v : velocity_) squared = std::max(squared, dot(v, v));
  return squared > 0.0 ? room_ / (2.0 * std::sqrt(squared)) : infinity;
}

// p and q are in contact and approach each other.
bool AwayStepper::resolve(std::size_t p, std::size_t q) {
  pushes_.clear();
  moves_ = 0;
  // A centre at contact distance is nearer than that to every ray that heads for its side.
  const double p_ahead = dot(separation(position_[q], p), heading(q));
  const double q_ahead = dot(separation(position_[p], q), heading(p));
  if (!(std::max(p_ahead, q_ahead) > 0.0)) return fail("two spheres collide and neither is in the other's way");
  const bool both = std::min(p_ahead, q_ahead) > slack;
  if (both ? distance_to_goal(q) < distance_to_goal(p) : q_ahead > p_ahead) std::swap(p, q);
  // From here on p makes way and q advances.
  const Vector v = heading(q);
  const Vector origin = position_[q];
  if (!make_way(p, q, origin, v, infinity) || !settle()) return false;
  const double projection = dot(separation(position_[q], p), v);       // [G]'s, for q at the origin
  return !(projection > 0.0) || (push(q, v, projection) && settle());  // else q was itself pushed past p
}

// Moves p straight out of the way of q, which goes from `origin` along the unit vector, to where they all but touch.
bool AwayStepper::make_way(std::size_t p, std::size_t q, const Vector& origin, const Vector& direction, double length) {
  const Vector d = from_way(p, origin, direction, length);
  const double distance = norm(d);
  const Vector e = distance < tiny ? perpendicular(direction) : add({}, 1.0 / distance, d);
  return push(p, e, radii_[p] + radii_[q] + slack - distance);
}

bool AwayStepper::push(std::size_t sphere, const Vector& direction, double length) {
  if (++moves_ > options_.max_moves) return fail(fmt::format("one away step takes over {} moves of spheres", options_.max_moves));
  if (pushes_.size() >= options_.max_depth)
    return fail(fmt::format("spheres push each other without end: over {} in a row", options_.max_depth));
  pushes_.push_back({sphere, position_[sphere], direction, length, 0});
  position_[sphere] = add(position_[sphere], length, direction);
  return true;
}

// Pushes what is in the way of the spheres pushed, depth first: a recursion with a stack of its own, which a long row of spheres
// cannot overflow.
bool AwayStepper::settle() {
  while (!pushes_.empty()) {
    Push& top = pushes_.back();
    const std::size_t k = top.candidate++;
    if (k == position_.size()) {
      pushes_.pop_back();
      continue;
    }
    if (k == top.sphere || dot(separation(top.origin, k), top.direction) <= 0.0) continue;
    const Vector d = from_way(k, top.origin, top.direction, top.length);
    if (norm(d) >= radii_[top.sphere] + radii_[k]) continue;
    const Push pusher = top;  // a push may move the stack
    if (!make_way(k, pusher.sphere, pusher.origin, pusher.direction, pusher.length)) return false;
  }
  return true;
}

bool AwayStepper::fail(std::string reason) {
  failure_ = std::move(reason);
  return false;
}

AwayStepper::Vector AwayStepper::separation(const Vector& from, std::size_t to) const {
  Vector d;
  for (std::size_t axis = 0; axis < 3; ++axis) d[axis] = box_.nearest_image(axis, position_[to][axis] - from[axis]);
  return d;
}

// From the nearest point of a way, which begins at `origin` and goes along the unit vector.
AwayStepper::Vector AwayStepper::from_way(std::size_t sphere, const Vector& origin, const Vector& direction, double length) const {
  const Vector d = separation(origin, sphere);
  return add(d, -std::min(dot(d, direction), length), direction);
}

// Unit vector to the goal; zero at the goal, where nothing is in the way.
AwayStepper::Vector AwayStepper::heading(std::size_t sphere) const {
  const double distance = distance_to_goal(sphere);
  return distance < tiny ? Vector{} : add({}, 1.0 / distance, add(goal_[sphere], -1.0, position_[sphere]));
}

double AwayStepper::distance_to_goal(std::size_t sphere) const { return norm(add(goal_[sphere], -1.0, position_[sphere])); }

}  // namespace lanescape
