#include "interaction/pair/pair_segment_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lanescape {
namespace {

// In units of the smallest sigma. A longer reach makes passes rarer and bounds weaker.
constexpr double relative_reach = 0.13;

// In units of the smallest sigma. A pass costs about ten evaluations, and of longer steps one pass serves for ten at most.
constexpr double longest_segment = 0.025;

// A pass takes a time of N^2. At N = 16,000 it costs 500 evaluations and serves for 900 contour steps or more; at 32,000 the
// rounding allowed for, which grows as N^3, is 2.3 epsilon, and nothing is proven.
constexpr std::size_t most_particles = 16'000;

// Five times what rounding to single precision can do to a separation [sigma].
double rounding_of_separations(const Box& box) { return 2e-6 * (box.length[0] + box.length[1] + box.length[2]); }

}  // namespace

std::unique_ptr<SegmentBound> PairSegmentBound::make(const PairModel& model, const Box& box, const ParticleLayout& layout,
                                                     double longest) {
  const double smallest = *std::min_element(model.sigma.begin(), model.sigma.end());
  if (!PairLoss::exists(model) || layout.size() > most_particles || !(longest <= longest_segment * smallest)) return nullptr;
  if (!(rounding_of_separations(box) <= 0.01 * smallest)) return nullptr;
  return std::unique_ptr<SegmentBound>(new PairSegmentBound(model, box, layout, longest));
}

PairSegmentBound::PairSegmentBound(const PairModel& model, const Box& box, const ParticleLayout& layout, double longest)
    : box_(box),
      images_(model.images),
      blocks_(layout.blocks()),
      species_(model.species.size()),
      slots_(layout.slots()),
      particles_(layout.size()),
      reach_(relative_reach * *std::min_element(model.sigma.begin(), model.sigma.end())) {
  // |u_i - u_j| <= sqrt 2 for a unit vector u.
  const double change = 1.001 * std::numbers::sqrt2 * longest, padded_reach = reach_ + rounding_of_separations(box);
  for (std::size_t ab = 0; ab < model.sigma.size(); ++ab) {
    losses_.emplace_back(model, model.numbers(ab), padded_reach, change);
    flips_.push_back(flip(losses_.back(), change));
  }
  // r^2 of the two images differs by L (L - 2 |d|), which has to be passed within `reach` of |d| = L/2.
  flip_difference_ = 2.0 * *std::max_element(box.length.begin(), box.length.end()) * padded_reach;
  squared_.resize(slots_);
  steps_.resize(slots_);
  next_squared_.resize(slots_);
}

// Where the nearest image changes along axis k, at |d_k| = L_k/2, the slope |phi'| |d_k| |w_k|/r of that axis changes its sign. On
// one segment several axes can change at different r; their |d_k|/r are then components of a vector no longer than r/(r - change).
PairLoss::Entry PairSegmentBound::flip(const PairLoss& loss, double change) const {
  PairLoss::Entry entry;
  if (images_ != ImageRule::minimum) return entry;
  const double half = 0.5 * box_.shortest(), least = half - change;
  entry.kink = least > 0.0 ? 2.0 * half / least * loss.steepest_beyond(least) : std::numeric_limits<double>::infinity();
  return entry;
}

void PairSegmentBound::wrap(const AlignedArray& centre) {
  wrapped_.resize(centre.size());
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t k = axis * slots_; k < (axis + 1) * slots_; ++k)
      wrapped_[k] = static_cast<float>(box_.wrapped(axis, centre[k]));
}

// The quadratic form sum c_ij |u_i - u_j|^2 over pairs is at most 2 max_i sum_j c_ij, and sum w_ij |u_i - u_j| at most
// sqrt(sum_i (sum_j w_ij)^2).
SegmentLoss PairSegmentBound::around(const AlignedArray& centre) {
  wrap(centre);
  shares_.assign(slots_, {0.0, 0.0});
  Total total;
  for (std::size_t a = 0; a < blocks_.size(); ++a)
    for (std::size_t b = a; b < blocks_.size(); ++b) add_pairs(a, b, total);
  double curvature = 0.0, kinks = 0.0, farthest = 0.0;
  for (const Share& share : shares_) {
    curvature = std::max(curvature, share.curvature);
    kinks += share.kink * share.kink;
  }
  for (const double x : centre) farthest = std::max(farthest, std::abs(x));
  constexpr double infinite = std::numeric_limits<double>::infinity(), epsilon = std::numeric_limits<double>::epsilon();
  // Beyond this, rounding of positions is not small beside what `reach` leaves over.
  if (!(farthest < 1e6 * reach_)) return {infinite, infinite, infinite};
  // Each factor is derived in src/interaction/README.md.
  const double terms = total.pairs + static_cast<double>(particles_) + 1000.0;
  const double rounding =
      4.0 * epsilon * terms * total.energy +
      epsilon * (64.0 * (farthest + box_.length[0] + box_.length[1] + box_.length[2]) + 4.0 * terms * reach_) * total.slope;
  return {std::sqrt(kinks), 2.0 * curvature, rounding};
}

void PairSegmentBound::add_pairs(std::size_t a, std::size_t b, Total& total) {
  const std::size_t begin = blocks_[a].begin, end = begin + blocks_[a].count;
  for (std::size_t i = begin; i < end; ++i)
    add_row(i, a == b ? i + 1 : blocks_[b].begin, blocks_[b].begin + blocks_[b].count, a * species_ + b, total);
}

// Writes r^2 of the nearest images, its step, and the least r^2 of another image.
void PairSegmentBound::find_separations(std::size_t i, std::size_t begin, std::size_t end, float steps_per_area) {
  const float *x = wrapped_.data(), *y = x + slots_, *z = y + slots_;
  const float xi = x[i], yi = y[i], zi = z[i];
  const auto lx = static_cast<float>(box_.length[0]), ly = static_cast<float>(box_.length[1]),
             lz = static_cast<float>(box_.length[2]);
  constexpr auto last = static_cast<float>(PairLoss::steps);
  const auto least = [](float a, float b) { return a < b ? a : b; };
  float *squared = squared_.data(), *next = next_squared_.data();
  std::int32_t* steps = steps_.data();
  for (std::size_t j = begin; j < end; ++j) {
    const float ax = std::abs(x[j] - xi), ay = std::abs(y[j] - yi), az = std::abs(z[j] - zi);
    const float dx = least(ax, lx - ax), dy = least(ay, ly - ay), dz = least(az, lz - az);
    const float r2 = dx * dx + dy * dy + dz * dz;
    squared[j] = r2;
    steps[j] = static_cast<std::int32_t>(least(r2 * steps_per_area, last));
    next[j] = r2 + least(lx * (lx - 2.0F * dx), least(ly * (ly - 2.0F * dy), lz * (lz - 2.0F * dz)));
  }
}

void PairSegmentBound::add_row(std::size_t i, std::size_t begin, std::size_t end, std::size_t ab, Total& total) {
  const PairLoss& loss = losses_[ab];
  find_separations(i, begin, end, static_cast<float>(loss.steps_per_area()));
  const auto range = static_cast<float>(loss.range_squared()), difference = static_cast<float>(flip_difference_);
  const bool all = images_ == ImageRule::all;
  PairLoss::Entry row;
  // Beyond the range the step is empty.
  for (std::size_t j = begin; j < end; ++j) {
    const PairLoss::Entry& nearest = loss.entries()[steps_[j]];
    shares_[j].add(nearest);
    row += nearest;
  }
  total.pairs += static_cast<double>(end - begin);
  for (std::size_t j = begin; j < end; ++j) {
    if (!(next_squared_[j] < range) || (!all && !(next_squared_[j] - squared_[j] < difference))) continue;
    const PairLoss::Entry others = all ? other_images(loss, separation(i, j), total.pairs) : flips_[ab];
    shares_[j].add(others);
    row += others;
  }
  shares_[i].add(row);
  total.energy += row.energy;
  total.slope += row.slope;
}

Point PairSegmentBound::separation(std::size_t i, std::size_t j) const {
  Point nearest{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double d = std::abs(static_cast<double>(wrapped_[axis * slots_ + j]) - static_cast<double>(wrapped_[axis * slots_ + i]));
    nearest[axis] = std::min(d, box_.length[axis] - d);
  }
  return nearest;
}

// Those beyond the nearest. Along an axis the images are |d|, L - |d|, L + |d|, 2L - |d|, ... away.
PairLoss::Entry PairSegmentBound::other_images(const PairLoss& loss, const Point& nearest, double& pairs) const {
  PairLoss::Entry sum;
  const double range = loss.range_squared();
  const auto image = [&](std::size_t axis, int k) {
    const double shift = static_cast<double>((k + 1) / 2) * box_.length[axis];
    return k % 2 == 0 ? shift + nearest[axis] : shift - nearest[axis];
  };
  double dx = 0.0, dy = 0.0, dz = 0.0;
  for (int a = 0; (dx = image(0, a), dx * dx < range); ++a)
    for (int b = 0; (dy = image(1, b), dx * dx + dy * dy < range); ++b)
      for (int c = a + b > 0 ? 0 : 1; (dz = image(2, c), dx * dx + dy * dy + dz * dz < range); ++c) {
        sum += loss.at(dx * dx + dy * dy + dz * dz);
        pairs += 1.0;
      }
  return sum;
}

}  // namespace lanescape
