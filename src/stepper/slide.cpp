#include "stepper/slide.hpp"

#include <algorithm>
#include <cmath>

#include "core/slot_point.hpp"

namespace lanescape {
namespace {

constexpr double blocked = 1e-3;         // a displacement that is this part of its wish is none
constexpr double regained = 0.99;        // of the distance where the path was stuck: from here on it goes on as before
constexpr std::uint64_t sharpest = 6;    // log2(p/2)
constexpr std::uint64_t patience = 300;  // steps with one exponent
constexpr double turn = 0.1;             // of the pull, tangent of the angle

std::uint64_t key(const PairGap& pair) {
  return static_cast<std::uint64_t>(pair.first) << 32 | static_cast<std::uint64_t>(pair.second);
}

}  // namespace

SlideStepper::SlideStepper(ContactLandscape& landscape, const Options& options)
    : landscape_(&landscape),
      options_(options),
      projection_(landscape.inverse_masses(), {.margin = 1e-12 * options.unit, .tolerance = 4e-13 * options.unit}),
      zero_(landscape.dimension(), 0.0),
      way_(zero_),
      displacement_(zero_),
      wish_length_(options.largest_move),
      corrections_(32, 0),
      sharpness_(sharpest + 1, 0.0) {}

// The pull of the goal, at most `wish_length_` long. It leads no sphere beyond its goal.
void SlideStepper::set_pull(const PathPoint& at) {
  const VectorAlgebra& algebra = landscape_->algebra();
  algebra.axpy(way_, zero_, std::min(1.0, wish_length_ / at.distance), at.to_goal);
  if (sharpened_ == 0) return;
  const std::size_t slots = zero_.size() / 3;
  double longest = 0.0;
  for (std::size_t j = 0; j < slots; ++j) longest = std::max(longest, dot(slot_point(at.to_goal, j), slot_point(at.to_goal, j)));
  const double power = static_cast<double>((std::uint64_t{1} << sharpened_) - 1);  // (p - 2)/2
  for (std::size_t j = 0; j < slots; ++j) {
    const Point d = slot_point(at.to_goal, j);
    const double weight = std::pow(dot(d, d) / longest, power);
    for (std::size_t axis = 0; axis < 3; ++axis) way_[axis * slots + j] = weight * d[axis];
  }
  const double length = algebra.norm(way_);
  if (length > wish_length_) algebra.axpy(way_, zero_, wish_length_ / length, AlignedArray(way_));
  turn_pull();
}

// Adds to each pull a part at right angles to it; opposite pulls turn to opposite sides.
void SlideStepper::turn_pull() {
  const std::size_t slots = zero_.size() / 3;
  for (std::size_t j = 0; j < slots; ++j) {
    const Point w = slot_point(way_, j);
    const std::size_t least = static_cast<std::size_t>(
        std::min_element(w.begin(), w.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) - w.begin());
    const std::size_t next = (least + 1) % 3, last = (least + 2) % 3;
    way_[next * slots + j] += turn * w[last];
    way_[last * slots + j] -= turn * w[next];
  }
}

// Raises the exponent of the pull; false where it is the highest already.
bool SlideStepper::sharpen(double distance) {
  if (sharpened_ == sharpest) {
    failure_ = "contacts balance the pull of the goal";
    return false;
  }
  if (sharpened_++ == 0) stuck_distance_ = distance;
  sharp_steps_ = 0;
  return true;
}

// A first guess of the multipliers from those of the last step, which had another wish and perhaps another list.
void SlideStepper::guess_multipliers(const std::vector<PairGap>& pairs, bool rebuilt) {
  const double length = landscape_->algebra().norm(way_), ratio = last_wish_ > 0.0 ? length / last_wish_ : 0.0;
  last_wish_ = length;
  if (!rebuilt) {
    for (double& multiplier : multipliers_) multiplier *= ratio;
    return;
  }
  multipliers_.assign(pairs.size(), 0.0);
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const auto found = std::lower_bound(acting_.begin(), acting_.end(), std::pair(key(pairs[c]), 0.0));
    if (found != acting_.end() && found->first == key(pairs[c])) multipliers_[c] = ratio * found->second;
  }
}

void SlideStepper::remember_multipliers(const std::vector<PairGap>& pairs) {
  acting_.clear();
  for (std::size_t c = 0; c < pairs.size(); ++c)
    if (multipliers_[c] > 0.0) acting_.emplace_back(key(pairs[c]), multipliers_[c]);
  std::sort(acting_.begin(), acting_.end());
}

// Sets way_ and displacement_ to what the contacts leave of the pull.
bool SlideStepper::project(const PathPoint& at, const std::vector<PairGap>& pairs, bool rebuilt) {
  const std::uint64_t rounds = projection_.rounds();
  set_pull(at);
  guess_multipliers(pairs, rebuilt);
  displacement_ = way_;
  landscape_->metric().to_positions(displacement_);
  if (!projection_.project(pairs, displacement_, multipliers_)) {
    failure_ = "contacts leave no way without overlaps";
    return false;
  }
  remember_multipliers(pairs);
  if (!acting_.empty()) ++corrections_[std::min<std::size_t>(projection_.rounds() - rounds, corrections_.size()) - 1];
  way_ = displacement_;
  landscape_->metric().to_kinematic(way_);
  return true;
}

// The share of the displacement to make: no sphere moves so far that it could meet one beyond the reach. Sets the length of the
// next wish so that the sphere that moves most will move by `largest_move`.
double SlideStepper::limit_displacement() {
  double squared = 0.0;
  moved_ = 0;
  for (std::size_t j = 0; j < zero_.size() / 3; ++j) {
    const Point u = slot_point(displacement_, j);
    squared = std::max(squared, dot(u, u));
    if (dot(u, u) > 0.0) ++moved_;
  }
  const double largest = std::sqrt(squared), most = std::min(most_move(options_), 0.5 * landscape_->reach());
  wish_length_ = last_wish_ * std::clamp(options_.largest_move / largest, 0.5, 1.5);
  return std::min(1.0, most / largest);
}

// At most so deep do pairs overlap along that share of the displacement: |r + t u| >= n.(r + t u), which is linear in t.
double SlideStepper::deepest_overlap(const std::vector<PairGap>& pairs, double share) const {
  double smallest = 0.0;
  for (const PairGap& pair : pairs) {
    const Point u = difference(slot_point(displacement_, static_cast<std::size_t>(pair.second)),
                               slot_point(displacement_, static_cast<std::size_t>(pair.first)));
    smallest = std::min({smallest, pair.gap, pair.gap + share * dot(pair.normal, u)});
  }
  return -smallest;
}

StepKind SlideStepper::accept(const PathPoint& at, const std::vector<PairGap>& pairs, AlignedArray& next) {
  const double share = limit_displacement();
  violation_ = deepest_overlap(pairs, share);
  sharpness_[sharpened_] += share * landscape_->algebra().norm(way_);
  landscape_->algebra().axpy(next, at.position, share, way_);
  return acting_.empty() ? StepKind::direct : StepKind::detour;
}

std::optional<StepKind> SlideStepper::step(const PathPoint& at, AlignedArray& next) {
  if (sharpened_ > 0 && at.distance < regained * stuck_distance_) sharpened_ = 0;
  if (sharpened_ > 0 && sharp_steps_++ >= patience && !sharpen(at.distance)) return std::nullopt;
  ++evaluations_;
  const std::uint64_t rebuilds = landscape_->rebuilds();
  const std::vector<PairGap>& pairs = landscape_->gaps(at.position);
  if (!project(at, pairs, landscape_->rebuilds() != rebuilds)) return std::nullopt;
  while (landscape_->algebra().norm(way_) < blocked * last_wish_)
    if (!sharpen(at.distance) || !project(at, pairs, false)) return std::nullopt;
  return accept(at, pairs, next);
}

std::vector<StepHistogram> SlideStepper::histograms() const { return {{"pull_sharpness", 0.0, 1.0, sharpness_}}; }

void SlideStepper::exchange(Archive& archive, const AlignedArray&) {
  std::vector<std::uint64_t> pairs;
  std::vector<double> multipliers;
  for (const auto& [pair, multiplier] : acting_) {
    pairs.push_back(pair);
    multipliers.push_back(multiplier);
  }
  archive.field("acting_pairs", pairs);
  archive.field("acting_multipliers", multipliers);
  acting_.clear();
  for (std::size_t k = 0; k < pairs.size(); ++k) acting_.emplace_back(pairs[k], multipliers[k]);
  archive.field("multipliers", multipliers_);
  archive.field("wish_length", wish_length_);
  archive.field("last_wish", last_wish_);
  archive.field("sharpened", sharpened_);
  archive.field("sharp_steps", sharp_steps_);
  archive.field("stuck_distance", stuck_distance_);
  archive.field("moved", moved_);  // the trace has it of the last step
  archive.field("evaluations", evaluations_);
  archive.field("corrections", corrections_);
  archive.field("sharpness", sharpness_);
  archive.enter("contacts");
  landscape_->exchange(archive);
  archive.leave();
}

}  // namespace lanescape
