#include "insertion/search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lanescape {
namespace {

using Point = InsertionSearch::Point;

constexpr int most_uphill_in_a_row = 3;
constexpr int most_line_evaluations = 3;  // [U] III.A: better estimates of the minimum gain nothing
constexpr int most_bracket_evaluations = 100;
// A line minimisation ends when the slope falls below this share of the initial slope.
constexpr double line_tolerance = 0.1;

constexpr std::size_t candidates_at_once = 16;
// Limit of candidates per start. After it the last candidate is used, for instance if no point of the region is clear.
constexpr int most_candidates = 16'384;

// Axes along which a search ends at the sides of its region, or at open faces; along a whole periodic edge it goes round.
std::array<bool, 3> walls_of(const std::optional<Region>& region, const Box& box) {
  std::array<bool, 3> walls{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool whole = !region || region->high[axis] - region->low[axis] >= (1.0 - 1e-12) * box.length[axis];
    walls[axis] = !(box.periodic[axis] && whole);
  }
  return walls;
}

double default_largest_step(const ProbeField& fluid) {
  double reduced_volume = 1.0;
  for (const double edge : fluid.box().length) reduced_volume *= edge / fluid.length_unit();
  return 0.1 * std::pow(static_cast<double>(fluid.size()) / reduced_volume, -1.5) * fluid.length_unit();
}

}  // namespace

InsertionSearch::InsertionSearch(const ProbeField& fluid, const InsertionOptions& options, std::uint64_t number, double allowed,
                                 std::uint64_t most_iterations, Observer observer)
    : fluid_(&fluid),
      options_(&options),
      random_(options.seed, RandomStream::insertion),
      number_(number),
      most_iterations_(most_iterations),
      allowed_(allowed),
      largest_step_(options.largest_step.value_or(default_largest_step(fluid))),
      traverse_step_(options.traverse_step.value_or(1.5 * fluid.length_unit())),
      clearances_(fluid.clearances(options.clear_energy)),
      region_(options.region.value_or(Region{{}, fluid.box().length})),
      has_walls_(walls_of(options.region, fluid.box())),
      whole_box_(has_walls_ == std::array{false, false, false}),
      observer_(std::move(observer)) {}

InsertionSearch::Site InsertionSearch::probe(const Point& position) {
  const ProbeField::Sample sample = fluid_->sample(position);
  ++result_.evaluations;
  ++spent_;
  if (observer_) observer_(result_.trials, position, sample.energy);
  Site site{position, sample.energy, sample.gradient, 0.0};
  if (!whole_box_ && options_->wall == RegionWall::well) {
    const double wall = 10.0 * std::sqrt(dot(site.gradient, site.gradient)) + 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!has_walls_[axis]) continue;
      // The next step goes down the gradient for sign 1 and up for sign -1; it must lead back into the region.
      const double sign = sign_at(site);
      if (position[axis] < region_.low[axis]) site.gradient[axis] = -sign * wall;
      if (position[axis] > region_.high[axis]) site.gradient[axis] = sign * wall;
    }
  }
  site.slope = std::sqrt(dot(site.gradient, site.gradient));
  return site;
}

Point InsertionSearch::in_region(const Point& fraction) const {
  Point position{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    position[axis] = region_.low[axis] + (region_.high[axis] - region_.low[axis]) * fraction[axis];
  return position;
}

Point InsertionSearch::start_of(std::uint64_t trial) {
  if (options_->method == InsertionMethod::screened) return clear_start();
  const auto particle = static_cast<std::uint32_t>(trial);
  return in_region(random_.uniform_point(number_, particle));
}

Point InsertionSearch::clear_start() {
  std::array<Point, candidates_at_once> candidates{};
  std::array<double, 3 * candidates_at_once> in_box;  // a region may lie across its faces
  for (int k = 0; k < most_candidates / static_cast<int>(candidates_at_once); ++k) {
    for (std::size_t c = 0; c < candidates_at_once; ++c) {
      candidates[c] = in_region(random_.uniform_point(number_, static_cast<std::uint32_t>(result_.candidates + c)));
      for (std::size_t axis = 0; axis < 3; ++axis) in_box[3 * c + axis] = fluid_->box().wrapped(axis, candidates[c][axis]);
    }
    const std::size_t clear = fluid_->first_clear(clearances_, in_box);
    result_.candidates += std::min(clear + 1, candidates_at_once);
    if (clear < candidates_at_once) return candidates[clear];
  }
  return candidates.back();
}

void InsertionSearch::keep_inside(Point& position) const {
  if (whole_box_ || options_->wall == RegionWall::well) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!has_walls_[axis]) continue;
    const double low = region_.low[axis], high = region_.high[axis];
    double& x = position[axis];
    if (x < low) x = 2.0 * low - x;
    if (x > high) x = 2.0 * high - x;
    x = std::clamp(x, low, high);  // a region may be shorter than a step
  }
}

bool InsertionSearch::between_walls(const Point& position) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (has_walls_[axis] && !(position[axis] >= region_.low[axis] && position[axis] <= region_.high[axis])) return false;
  return true;
}

bool InsertionSearch::accepted(const Site& site) const {
  return std::abs(site.energy - options_->target) <= allowed_ && between_walls(site.position);
}

bool InsertionSearch::can_go_on(const Site& site) const {
  return spent_ < most_iterations_ && site.slope > 0.0 && std::isfinite(site.slope) && std::isfinite(site.energy);
}

// [U] Eq. 6. Above the overlap energy U = 4 epsilon (sigma/r)^12 gives the distance r to the overlapping particle; the step ends at
// the contact distance from it.
double InsertionSearch::usher_length(const Site& site) const {
  if (site.energy > options_->overlap_energy)
    return fluid_->largest_sigma() * (options_->contact - std::pow(4.0 / site.energy, 1.0 / 12.0));
  return std::min(std::abs(site.energy - options_->target) / site.slope, largest_step_);
}

InsertionSearch::Site InsertionSearch::step(const Site& from, double sign, double length) {
  Point next{};
  for (std::size_t axis = 0; axis < 3; ++axis) next[axis] = from.position[axis] - sign * length / from.slope * from.gradient[axis];
  keep_inside(next);
  return probe(next);
}

InsertionSearch::Site InsertionSearch::at(const Segment& segment, double part) {
  Point position{};
  for (std::size_t axis = 0; axis < 3; ++axis) position[axis] = segment.from.position[axis] + part * segment.along[axis];
  return probe(position);
}

namespace {

// The minimum of the cubic with these values and slopes at 0 and 1; 0.5 if it does not lie between them.
double cubic_minimum(double value0, double slope0, double value1, double slope1) {
  const double d = slope0 + slope1 - 3.0 * (value1 - value0), root = d * d - slope0 * slope1;
  if (!(root >= 0.0)) return 0.5;
  const double part = 1.0 - (slope1 + std::sqrt(root) - d) / (slope1 - slope0 + 2.0 * std::sqrt(root));
  return part > 0.0 && part < 1.0 ? part : 0.5;
}

}  // namespace

InsertionSearch::Segment::Segment(const Site& a, const Site& b) : from(a), to(b), along{} {
  for (std::size_t axis = 0; axis < 3; ++axis) along[axis] = b.position[axis] - a.position[axis];
}

InsertionSearch::Site InsertionSearch::line_minimum(const Segment& segment, double sign) {
  const auto slope = [&](const Site& site) { return sign * dot(site.gradient, segment.along); };
  double low = 0.0, high = 1.0;
  Site left = segment.from, right = segment.to, best = segment.from;
  const double slope_at_start = slope(left);
  for (int k = 0; k < most_line_evaluations; ++k) {
    const double width = high - low;
    const double within = cubic_minimum(sign * left.energy, width * slope(left), sign * right.energy, width * slope(right));
    const double part = low + width * std::clamp(within, 0.05, 0.95);
    const Site site = at(segment, part);
    if (sign * site.energy < sign * best.energy) best = site;
    if (accepted(site) || sign_at(site) != sign) return site;
    if (std::abs(slope(site)) < line_tolerance * std::abs(slope_at_start)) break;
    if (slope(site) > 0.0 || sign * site.energy > sign * left.energy) {
      high = part;
      right = site;
    } else {
      low = part;
      left = site;
    }
  }
  return best;
}

// Newton's method along the segment; bisection where Newton's step leaves the interval that contains the target.
InsertionSearch::Site InsertionSearch::bracketed(const Segment& segment, double sign) {
  double low = 0.0, high = 1.0;  // sign (U - U0) is positive at low, negative at high
  const auto miss = [&](const Site& site) { return std::abs(site.energy - options_->target); };
  const bool from_low = miss(segment.from) < miss(segment.to);
  Site site = from_low ? segment.from : segment.to;
  double part = from_low ? low : high;
  for (int k = 0; k < most_bracket_evaluations && !accepted(site); ++k) {
    double next = part - (site.energy - options_->target) / dot(site.gradient, segment.along);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    part = next;
    site = at(segment, part);
    (sign * (site.energy - options_->target) > 0.0 ? low : high) = part;
  }
  return site;
}

bool InsertionSearch::usher_trial(Site& site) {
  int uphill_in_a_row = 0;
  while (!accepted(site)) {
    if (!can_go_on(site)) return false;
    const double sign = sign_at(site);
    const Site next = step(site, sign, usher_length(site));
    // A move across the target is not uphill.
    const bool uphill = sign * (next.energy - site.energy) > 0.0 && sign_at(next) == sign && !accepted(next);
    if (!uphill) {
      uphill_in_a_row = 0;
      site = next;
      continue;
    }
    const bool pursued =
        options_->method == InsertionMethod::usher_indirect ||
        (options_->method == InsertionMethod::usher_near && std::abs(next.energy - options_->target) < std::abs(options_->target));
    if (!pursued || ++uphill_in_a_row == most_uphill_in_a_row) return false;
    site = line_minimum({site, next}, sign);
  }
  return true;
}

// [U] III.A, Eqs. 3 and 4.
bool InsertionSearch::descent_trial(Site& site) {
  const double sign = sign_at(site);
  int uphill_in_a_row = 0;
  while (!accepted(site)) {
    if (!can_go_on(site)) return false;
    Site next = step(site, sign, largest_step_);
    if (sign_at(next) == sign && !accepted(next) && sign * (next.energy - site.energy) > 0.0) {
      if (++uphill_in_a_row == most_uphill_in_a_row) return false;
      const Site least = line_minimum({site, next}, sign);
      if (accepted(least) || sign_at(least) != sign) {
        next = least;
      } else {
        if (!can_go_on(least)) return false;
        site = least;
        next = step(least, sign, traverse_step_);
      }
    } else {
      uphill_in_a_row = 0;
    }
    if (accepted(next) || sign_at(next) == sign) {
      site = next;
      continue;
    }
    site = bracketed({site, next}, sign);
    return accepted(site);
  }
  return true;
}

void InsertionSearch::run() {
  while (!result_.found && result_.trials < options_->most_trials) {
    start_ = start_of(result_.trials++);
    spent_ = 0;
    Site site = probe(start_);
    result_.found = trial(site);
    if (result_.found) finish(site);
  }
}

bool InsertionSearch::is_near(const Point& a, const Point& b) const {
  double squared = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double d = fluid_->box().nearest_image(axis, a[axis] - b[axis]);
    squared += d * d;
  }
  return squared < fluid_->largest_cutoff() * fluid_->largest_cutoff();
}

// The result is in the box; its image in the region may be off by rounding.
Point InsertionSearch::place_in_region() const {
  if (whole_box_) return result_.position;
  Point place = region_.image(fluid_->box(), result_.position);
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (has_walls_[axis]) place[axis] = std::clamp(place[axis], region_.low[axis], region_.high[axis]);
  return place;
}

void InsertionSearch::follow(const std::vector<Point>& inserted, double constant_growth) {
  if (!result_.found || inserted.empty()) return;
  Site site{place_in_region(), result_.energy + constant_growth, {}, 0.0};
  const bool disturbed =
      std::any_of(inserted.begin(), inserted.end(), [&](const Point& p) { return is_near(p, result_.position); });
  if (disturbed || !accepted(site)) {
    spent_ = 0;
    site = probe(site.position);
    result_.found = trial(site);
  }
  if (result_.found)
    finish(site);
  else
    run();
}

void InsertionSearch::finish(const Site& site) {
  const Box& box = fluid_->box();
  double squared = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double d = box.nearest_image(axis, site.position[axis] - start_[axis]);
    squared += d * d;
    result_.position[axis] = box.wrapped(axis, site.position[axis]);
  }
  result_.distance = std::sqrt(squared);
  result_.energy = site.energy;
  result_.iterations = spent_;
  const double error = site.energy - options_->target;
  result_.error = options_->measure_in_force() == ErrorMeasure::absolute ? error : error / std::abs(options_->target);
}

}  // namespace lanescape
