#include "stepper/trial_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lanescape {
namespace {

// In a step of unit length two particles move apart by at most sqrt 2; the rest covers rounding.
constexpr double apart = 1.41422;

// Two particles have moved apart by at most this: the sum of the two longest ways.
double largest_change(const AlignedArray& from, const AlignedArray& to) {
  const std::size_t slots = from.size() / 3;
  const double *a = from.data(), *b = to.data();
  double largest = 0.0, second = 0.0;
  for (std::size_t j = 0; j < slots; ++j) {
    const double x = b[j] - a[j], y = b[j + slots] - a[j + slots], z = b[j + 2 * slots] - a[j + 2 * slots];
    const double squared = x * x + y * y + z * z;
    second = std::max(second, std::min(largest, squared));
    largest = std::max(largest, squared);
  }
  return std::sqrt(largest) + std::sqrt(second);
}

}  // namespace

SegmentBound* TrialBound::bound() {
  if (!bound_) bound_ = landscape_->segment_bound(step_);
  return bound_->get();
}

bool TrialBound::exceeds(const AlignedArray& here, double energy, double slope, double limit) {
  if (!bound()) return false;
  find_loss(here);
  const double least = energy + step_ * (slope - loss_.slope) - 0.5 * step_ * step_ * loss_.curvature;
  const double rounding = loss_.rounding + 16.0 * std::numeric_limits<double>::epsilon() * (std::abs(energy) + std::abs(limit));
  return least - rounding > limit;
}

void TrialBound::find_loss(const AlignedArray& here) {
  const double reach = (1.0 - 1e-6) * bound()->reach();
  const bool known = centre_.size() > 0;
  if (known && moved_apart_ + apart * (walked_ + step_) <= reach) return;
  if (known) moved_apart_ = largest_change(centre_, here);
  walked_ = 0.0;
  // What is left must last for some steps.
  if (known && moved_apart_ + apart * step_ <= 0.8 * reach) return;
  centre_.resize(here.size());
  // A path keeps its direction for a while: a centre ahead of it serves for longer, unless long steps have put it out of reach.
  const bool near = 0.7 * moved_apart_ + apart * step_ <= 0.8 * reach;
  const double ahead = known && near ? 0.7 : 0.0;
  for (std::size_t k = 0; k < here.size(); ++k) centre_[k] = here[k] + ahead * (here[k] - centre_[k]);
  moved_apart_ *= 1.000001 * ahead;
  loss_ = bound()->around(centre_);
}

void TrialBound::exchange(Archive& archive) {
  archive.field("bound_centre", centre_);
  archive.field("bound_moved_apart", moved_apart_);
  archive.field("bound_walked", walked_);
  if (archive.reading() && centre_.size() > 0 && bound()) loss_ = bound()->around(centre_);
}

}  // namespace lanescape
