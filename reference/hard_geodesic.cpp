#include "reference/hard_geodesic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reference/event_driven.hpp"
#include "reference/path_sum.hpp"

namespace lanescape::reference {
namespace {

constexpr double kTiny = 1e-12;  // below this a vector has no direction
// [sigma], the gap that a sphere leaves when it makes way. Two spheres that pass each other in contact would collide again and
// again, by rounding.
constexpr double kSlack = 1e-10;

void check(const Point& start, const Point& finish, const std::vector<double>& radii, const Vector& box) {
  if (start.size() != finish.size()) throw std::invalid_argument("hard_geodesic: both ends need the same number of coordinates");
  for (const Point* end : {&start, &finish}) {
    for (const double x : *end)
      if (!std::isfinite(x)) throw std::invalid_argument("hard_geodesic: a coordinate is not finite");
    if (any_overlap(*end, radii, box)) throw std::invalid_argument("hard_geodesic: spheres overlap at an end");
  }
}

/// The path so far and its progress towards the end point.
class Walk {
 public:
  Walk(const Point& start, const Point& finish, std::size_t record) : finish_(finish), record_(record) { path.end = start; }

  Point to_finish() const { return combine(finish_, -1.0, path.end); }

  bool comes_nearer(double resolution, long patience) {
    const Point left = to_finish();
    const double distance = std::sqrt(dot(left, left));
    if (distance < nearest_ - resolution) {  // a decrease by rounding is no progress
      nearest_ = distance;
      since_nearest_ = 0;
      return true;
    }
    return ++since_nearest_ < patience;
  }

  void advance(const Point& next, StepKind kind, long trials = 0) {
    sum_.add(combine(next, -1.0, path.end));
    path.end = next;
    if (path.accepted.size() < record_) path.accepted.push_back({kind, trials, next});
    if (kind == StepKind::direct) ++path.direct_steps;
    if (kind == StepKind::avoidance) ++path.avoidance_steps;
    if (kind == StepKind::away) ++path.away_steps;
    if (trials == 0) return;
    const auto k = static_cast<std::size_t>(trials);
    if (path.trials.size() <= k) path.trials.resize(k + 1, 0);
    ++path.trials[k];
  }

  HardGeodesic stop(Outcome outcome, const char* reason) {
    path.outcome = outcome;
    path.reason = reason;
    path.length = sum_.length();
    path.participation = sum_.participation();
    return path;
  }

  HardGeodesic path;

 private:
  const Point& finish_;
  std::size_t record_;
  PathSum sum_;
  double nearest_ = std::numeric_limits<double>::infinity();
  long since_nearest_ = 0;
};

/// Turns the failed direct trial into an allowed one, [G] Eqs. 3.23-3.32. Null, or why there is none.
const char* avoid(const Point& from, Point& trial, long& trials, const std::vector<double>& radii, const Vector& box,
                  const AvoidanceOptions& options) {
  Point sum(from.size(), 0.0);  // F_j
  for (trials = 1; trials <= options.max_trials; ++trials) {
    const Point f = fictitious_forces(trial, radii, box, options.potential);
    const double norm = std::sqrt(dot(f, f));  // over the whole system: a deep overlap outweighs a shallow one
    if (!(norm > 0.0)) return "the forces of the overlaps cancel";
    sum = combine(sum, 1.0 / norm, f);
    trial = from;
    bool moves = false;
    for (std::size_t j = 0; j < sum.size(); j += 3) {
      const double length = std::sqrt((sum[j] * sum[j] + sum[j + 1] * sum[j + 1]) + sum[j + 2] * sum[j + 2]);
      if (length < kTiny) continue;
      moves = true;
      for (std::size_t k = j; k < j + 3; ++k) trial[k] = from[k] + options.avoidance_step * (sum[k] / length);
    }
    if (!moves) return "the forces of the failed trials cancel";
    if (!any_overlap(trial, radii, box)) return nullptr;
  }
  return "no avoidance trial is free of overlaps";
}

Vector at(const Point& positions, std::size_t j) { return {positions[3 * j], positions[3 * j + 1], positions[3 * j + 2]}; }
Vector combine(const Vector& a, double factor, const Vector& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

/// A unit vector perpendicular to the unit vector v; a function of v.
Vector perpendicular(const Vector& v) {
  std::size_t least = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (std::abs(v[axis]) < std::abs(v[least])) least = axis;
  Vector e{};
  e[least] = 1.0;
  e = combine(e, -v[least], v);
  return combine(Vector{}, 1.0 / std::sqrt(dot(e, e)), e);
}

/// One away step: moves spheres out of the way of others, [G] 5.2.1.
class AwayStep {
 public:
  AwayStep(const Point& positions, const Point& finish, const std::vector<double>& radii, const Vector& box,
           const AwayOptions& options)
      : positions_(positions), finish_(finish), radii_(radii), box_(box), options_(options) {}

  /// p and q are in contact and approach each other. Null, or why there is no step.
  const char* resolve(std::size_t p, std::size_t q) {
    // At contact p is in the way of q if q heads for the side of p. A component of the order of rounding does not count: the same
    // two spheres would meet without end.
    const double p_ahead = dot(between(q, p), heading(q));
    const double q_ahead = dot(between(p, q), heading(p));
    if (!(std::max(p_ahead, q_ahead) > 0.0)) return "two spheres collide and neither is in the other's way";
    const bool both = std::min(p_ahead, q_ahead) > kSlack;
    if (both ? distance_to_goal(q) < distance_to_goal(p) : q_ahead > p_ahead) std::swap(p, q);
    // After the swap p makes way and q advances.
    const Vector v = heading(q);
    const double whole_ray = std::numeric_limits<double>::infinity();
    if (const char* failure = make_way(p, q, at(positions_, q), v, whole_ray)) return failure;
    const double projection = dot(between(q, p), v);  // [G] 5.2.1 for q at the origin
    if (projection > 0.0)                             // else q has been pushed past p
      if (const char* failure = move(q, v, projection)) return failure;
    if (smallest_gap(positions_, radii_, box_) < -kSlack) return "a moved sphere overlaps";
    return nullptr;
  }

  const Point& positions() const { return positions_; }

 private:
  /// Nearest image of r_to - from.
  Vector separation(const Vector& from, std::size_t to) const {
    Vector d = combine(at(positions_, to), -1.0, from);
    for (std::size_t axis = 0; axis < 3; ++axis) d[axis] = d[axis] - box_[axis] * std::nearbyint(d[axis] / box_[axis]);
    return d;
  }
  Vector between(std::size_t from, std::size_t to) const { return separation(at(positions_, from), to); }

  Vector to_goal(std::size_t j) const { return combine(at(finish_, j), -1.0, at(positions_, j)); }
  double distance_to_goal(std::size_t j) const { return std::sqrt(dot(to_goal(j), to_goal(j))); }

  /// Unit vector from j to its goal; zero at the goal, so that nothing is in the way of j.
  Vector heading(std::size_t j) const {
    const double distance = distance_to_goal(j);
    return distance < kTiny ? Vector{} : combine(Vector{}, 1.0 / distance, to_goal(j));
  }

  /// Separation of k from the nearest point of the segment from `origin` along the unit vector v.
  Vector from_way(std::size_t k, const Vector& origin, const Vector& v, double length) const {
    const Vector d = separation(origin, k);
    return combine(d, -std::min(dot(d, v), length), v);
  }

  /// Moves p perpendicularly out of the way of q, which moves from `origin` along v, until the gap is kSlack.
  const char* make_way(std::size_t p, std::size_t q, const Vector& origin, const Vector& v, double length) {
    const Vector d = from_way(p, origin, v, length);
    const double distance = std::sqrt(dot(d, d));
    const Vector e = distance < kTiny ? perpendicular(v) : combine(Vector{}, 1.0 / distance, d);
    return move(p, e, radii_[p] + radii_[q] + kSlack - distance);
  }

  /// Moves p along the unit vector v and then, recursively, the spheres in its way. The way is a cylinder that ends where the move
  /// ends. [G]'s cylinder has no end: it pushes spheres ahead aside by up to a diameter even for the shortest move and finds no
  /// path of 64 spheres at packing fractions of 0.30 and above.
  const char* move(std::size_t p, const Vector& v, double length) {
    if (++moves_ > options_.max_moves) return "too many moves in one away step";
    if (++depth_ > options_.max_depth) return "spheres push each other without end";
    const Vector origin = at(positions_, p);
    for (std::size_t axis = 0; axis < 3; ++axis) positions_[3 * p + axis] += length * v[axis];
    for (std::size_t k = 0; k < radii_.size(); ++k) {
      if (k == p || dot(separation(origin, k), v) <= 0.0) continue;
      const Vector d = from_way(k, origin, v, length);
      if (std::sqrt(dot(d, d)) >= radii_[p] + radii_[k]) continue;
      if (const char* failure = make_way(k, p, origin, v, length)) return failure;
    }
    --depth_;
    return nullptr;
  }

  Point positions_;
  const Point& finish_;
  const std::vector<double>& radii_;
  const Vector& box_;
  const AwayOptions& options_;
  long depth_ = 0;
  long moves_ = 0;
};

}  // namespace

HardGeodesic find_avoidance_geodesic(const Point& start, const Point& finish, const std::vector<double>& radii, const Vector& box,
                                     const AvoidanceOptions& options) {
  check(start, finish, radii, box);
  if (!(options.direct_step > 0.0) || !(options.avoidance_step > 0.0))
    throw std::invalid_argument("find_avoidance_geodesic: both steps must be positive");
  Walk walk(start, finish, options.record);
  for (;;) {
    const Point d = walk.to_finish();
    const double distance = std::sqrt(dot(d, d));
    if (distance < options.direct_step) break;
    if (!walk.comes_nearer(1e-6 * options.avoidance_step, options.patience))
      return walk.stop(Outcome::stalled, "no progress towards the end point");
    if (walk.path.direct_steps + walk.path.avoidance_steps >= options.max_steps) return walk.stop(Outcome::step_limit, "");

    Point trial = combine(walk.path.end, options.direct_step / distance, d);  // [G] Eq. 3.16
    if (!any_overlap(trial, radii, box)) {
      walk.advance(trial, StepKind::direct);
      continue;
    }
    long trials = 0;
    if (const char* failure = avoid(walk.path.end, trial, trials, radii, box, options)) return walk.stop(Outcome::stalled, failure);
    walk.advance(trial, StepKind::avoidance, trials);
  }
  walk.advance(finish, StepKind::last_hop);
  return walk.stop(Outcome::reached, "");
}

HardGeodesic find_away_geodesic(const Point& start, const Point& finish, const std::vector<double>& radii, const Vector& box,
                                const AwayOptions& options) {
  check(start, finish, radii, box);
  Walk walk(start, finish, options.record);
  for (;;) {
    if (!walk.comes_nearer(kSlack, options.patience)) return walk.stop(Outcome::stalled, "no progress towards the end point");
    const Point d = walk.to_finish();
    std::vector<FreeSphere> spheres(radii.size());
    for (std::size_t j = 0; j < spheres.size(); ++j) {
      spheres[j].position = at(walk.path.end, j);
      spheres[j].velocity = at(d, j);  // the end point lies one unit of time ahead, [G] Eq. 5.18
      spheres[j].radius = radii[j];
    }
    const Contact contact = fly_to_contact(spheres, box, 1.0);
    if (!(contact.time < 1.0)) break;
    if (walk.path.direct_steps + walk.path.away_steps >= options.max_steps) return walk.stop(Outcome::step_limit, "");
    if (contact.time > 0.0) {
      Point next;
      for (const FreeSphere& sphere : spheres) next.insert(next.end(), sphere.position.begin(), sphere.position.end());
      walk.advance(next, StepKind::direct);
    }
    AwayStep away(walk.path.end, finish, radii, box, options);
    if (const char* failure = away.resolve(contact.i, contact.j)) return walk.stop(Outcome::stalled, failure);
    walk.advance(away.positions(), StepKind::away);
  }
  walk.advance(finish, StepKind::last_hop);
  return walk.stop(Outcome::reached, "");
}

}  // namespace lanescape::reference
