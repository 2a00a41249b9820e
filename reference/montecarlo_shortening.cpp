#include "reference/montecarlo_shortening.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace lanescape::reference {
namespace {

constexpr auto all_steps = std::numeric_limits<std::size_t>::max();

/// The configurations of a path that are the first to come below |R_f - R_i| k / (count + 1), k = count ... 1.
std::vector<Point> recorded(const SteppedPath& path, long count) {
  std::vector<Point> result;
  const double whole = distance(path.steps.front(), path.steps.back());
  long k = count;
  for (std::size_t s = 1; s + 1 < path.steps.size(); ++s) {
    const double left = distance(path.steps[s], path.steps.back()) / whole * static_cast<double>(count + 1);
    if (k < 1 || left > static_cast<double>(k)) continue;
    result.push_back(path.steps[s]);
    k = std::min(k - 1, static_cast<long>(std::ceil(left)) - 1);
  }
  return result;
}

/// Single-particle moves until |R - R'| exceeds the displacement. False if that takes too many.
bool displace(Point& position, const Allowed& allowed, const Uniform& uniform, const TrialOptions& options) {
  const Point origin = position;
  for (long move = 0; move < options.max_moves; ++move) {
    Point trial = position;
    const auto particle = static_cast<std::size_t>(uniform() * static_cast<double>(position.size() / 3));
    for (std::size_t axis = 0; axis < 3; ++axis) trial[3 * particle + axis] += options.move * (2.0 * uniform() - 1.0);
    if (!allowed(trial)) continue;
    position = trial;
    if (distance(origin, position) > options.displacement) return true;
  }
  return false;
}

}  // namespace

FindPath soft_paths(const Energy& energy, const Gradient& gradient, Method method, const GeodesicOptions& options) {
  GeodesicOptions all = options;
  all.record = all_steps;
  return [=](const Point& from, const Point& to) {
    Geodesic found = find_geodesic(from, to, energy, gradient, method, all);
    found.accepted.insert(found.accepted.begin(), from);
    return SteppedPath{found.outcome == Outcome::reached, found.length, found.accepted};
  };
}

FindPath hard_paths(std::span<const double> radii, const Vector& box, const AvoidanceOptions& options) {
  AvoidanceOptions all = options;
  all.record = all_steps;
  return [radii = std::vector<double>(radii.begin(), radii.end()), box, all](const Point& from, const Point& to) {
    const HardGeodesic found = find_avoidance_geodesic(from, to, radii, box, all);
    SteppedPath path{found.outcome == Outcome::reached, found.length, {from}};
    for (const AcceptedStep& step : found.accepted) path.steps.push_back(step.positions);
    return path;
  };
}

OptimisedPath optimise_path(const Point& start, const Point& finish, const FindPath& find, const Allowed& allowed,
                            const Uniform& uniform, const TrialOptions& options) {
  OptimisedPath best{find(start, finish)};
  if (!best.path.reached) throw std::invalid_argument("montecarlo_shortening: no path is found between the ends");
  std::vector<Point> choice = recorded(best.path, options.configurations);
  for (long failures = 0; failures < options.failures && !choice.empty(); ++best.trials) {
    Point middle = choice[static_cast<std::size_t>(uniform() * static_cast<double>(choice.size()))];
    ++failures;
    if (!displace(middle, allowed, uniform, options)) continue;
    const SteppedPath back = find(middle, start), on = find(middle, finish);
    if (!back.reached || !on.reached || back.length + on.length >= best.path.length) continue;
    best.path = {true, back.length + on.length, {back.steps.rbegin(), back.steps.rend()}};
    best.path.steps.insert(best.path.steps.end(), on.steps.begin() + 1, on.steps.end());
    choice = recorded(best.path, options.configurations);
    failures = 0;
    ++best.accepted;
  }
  return best;
}

}  // namespace lanescape::reference
