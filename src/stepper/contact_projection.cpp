#include "stepper/contact_projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lanescape {
namespace {

constexpr int sweeps_per_round = 3;
constexpr double linear = 1e-13;  // the curvature, relative to that of a single contact, of a dual that rounding has curved

}  // namespace

ContactProjection::ContactProjection(AlignedArray inverse_masses, const Options& options)
    : inverse_masses_(std::move(inverse_masses)),
      options_(options),
      wish_(inverse_masses_.size()),
      u_(wish_.size()),
      change_(wish_.size()) {}

// What is left of a gap beyond the margin. Contacts closer than that need not part, which may be impossible; overlaps must.
double ContactProjection::allowed_approach(double gap) const { return gap < 0.0 ? gap : std::max(0.0, gap - options_.margin); }

double ContactProjection::residual(const Row& row, const std::vector<Point>& u) const {
  return dot(row.a, difference(u[static_cast<std::size_t>(row.j)], u[static_cast<std::size_t>(row.i)]));
}

// Adds M^-1 a amount.
void ContactProjection::push(const Row& row, double amount, std::vector<Point>& u) const {
  const auto i = static_cast<std::size_t>(row.i), j = static_cast<std::size_t>(row.j);
  const double at_i = amount * inverse_masses_[i], at_j = amount * inverse_masses_[j];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    u[i][axis] -= at_i * row.a[axis];
    u[j][axis] += at_j * row.a[axis];
  }
}

// Gives a row to every pair that acted in the guess or that u brings too close; returns whether there was any new one.
bool ContactProjection::add_violated(std::span<const PairGap> pairs) {
  const std::size_t before = rows_.size();
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const PairGap& pair = pairs[c];
    if (listed_[c] || pair.first == pair.second) continue;
    const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
    const double b = allowed_approach(pair.gap);
    if (b + dot(pair.normal, difference(u_[j], u_[i])) >= -options_.tolerance) continue;
    const double scale = 1.0 / std::sqrt(inverse_masses_[i] + inverse_masses_[j]);
    const Point a{scale * pair.normal[0], scale * pair.normal[1], scale * pair.normal[2]};
    rows_.push_back({pair.first, pair.second, a, scale * b, scale, 0.0, c});
    listed_[c] = 1;
  }
  return rows_.size() > before;
}

void ContactProjection::collect(std::span<const PairGap> pairs, const AlignedArray& wish, const std::vector<double>& multipliers) {
  const std::size_t slots = wish_.size();
  for (std::size_t i = 0; i < slots; ++i) wish_[i] = {wish[i], wish[slots + i], wish[2 * slots + i]};
  rows_.clear();
  listed_.assign(pairs.size(), 0);
  u_ = wish_;
  add_violated(pairs);
  for (Row& row : rows_)
    if (row.pair < multipliers.size()) row.lambda = std::max(0.0, multipliers[row.pair] / row.scale);
}

// u from the multipliers, so that rounding does not add up.
void ContactProjection::reset_displacement() {
  u_ = wish_;
  for (const Row& row : rows_)
    if (row.lambda > 0.0) push(row, row.lambda, u_);
}

// One Gauss-Seidel sweep.
void ContactProjection::sweep() {
  for (Row& row : rows_) {
    const double lambda = std::max(0.0, row.lambda - row.b - residual(row, u_));
    if (lambda == row.lambda) continue;
    push(row, lambda - row.lambda, u_);
    row.lambda = lambda;
  }
}

// The largest gap of a row that acts, or the largest overlap of one that does not [sigma].
double ContactProjection::worst_row() const {
  double worst = 0.0;
  for (const Row& row : rows_) {
    const double gap = (row.b + residual(row, u_)) / row.scale;
    worst = std::max(worst, row.lambda > 0.0 ? std::abs(gap) : -gap);
  }
  return worst;
}

// The rows that act, their gaps, and the squared norm of these.
double ContactProjection::begin_face() {
  face_.clear();
  for (std::size_t k = 0; k < rows_.size(); ++k)
    if (rows_[k].lambda > 0.0) face_.push_back(k);
  gaps_.resize(face_.size());
  image_.resize(face_.size());
  double squared = 0.0;
  for (std::size_t f = 0; f < face_.size(); ++f) {
    const Row& row = rows_[face_[f]];
    gaps_[f] = row.b + residual(row, u_);
    squared += gaps_[f] * gaps_[f];
  }
  direction_ = gaps_;
  return squared;
}

// image = A M^-1 A^T direction; returns their product.
double ContactProjection::apply_face() {
  std::fill(change_.begin(), change_.end(), Point{});
  for (std::size_t f = 0; f < face_.size(); ++f) push(rows_[face_[f]], direction_[f], change_);
  double curvature = 0.0;
  for (std::size_t f = 0; f < face_.size(); ++f) {
    image_[f] = residual(rows_[face_[f]], change_);
    curvature += direction_[f] * image_[f];
  }
  return curvature;
}

// How far the minimum of the dual lies along the direction. Where contacts depend on each other the dual can be linear in it.
double ContactProjection::length_to_minimum(double squared, double curvature) const {
  double norm = 0.0;
  for (const double d : direction_) norm += d * d;
  return curvature > linear * norm ? squared / curvature : std::numeric_limits<double>::infinity();
}

// The longest step along the direction, up to `length`, that leaves no multiplier negative.
double ContactProjection::allowed_length(double length) const {
  double allowed = length;
  for (std::size_t f = 0; f < face_.size(); ++f)
    if (allowed * direction_[f] > rows_[face_[f]].lambda) allowed = rows_[face_[f]].lambda / direction_[f];
  return allowed;
}

// Conjugate gradients for the rows that act, until their gaps are closed or a multiplier reaches zero. Returns false where the dual
// has no minimum: then no displacement removes all overlaps.
bool ContactProjection::solve_face() {
  double squared = begin_face();
  const double target = 0.1 * options_.tolerance * options_.tolerance;
  for (std::size_t iteration = 0; iteration < 2 * face_.size() + 10 && squared > target; ++iteration) {
    ++iterations_;
    const double length = length_to_minimum(squared, apply_face()), allowed = allowed_length(length);
    if (std::isinf(allowed)) return false;
    double next_squared = 0.0;
    for (std::size_t f = 0; f < face_.size(); ++f) {
      Row& row = rows_[face_[f]];
      row.lambda = std::max(0.0, row.lambda - allowed * direction_[f]);
      gaps_[f] -= allowed * image_[f];
      next_squared += gaps_[f] * gaps_[f];
    }
    if (allowed < length) break;
    for (std::size_t f = 0; f < face_.size(); ++f) direction_[f] = gaps_[f] + next_squared / squared * direction_[f];
    squared = next_squared;
  }
  reset_displacement();
  return true;
}

bool ContactProjection::solve_rows() {
  reset_displacement();
  for (int round = 0; round < options_.max_rounds; ++round) {
    ++rounds_;
    for (int k = 0; k < sweeps_per_round; ++k) sweep();
    if (worst_row() <= options_.tolerance) return true;
    if (!solve_face()) return false;
  }
  return false;
}

void ContactProjection::give(AlignedArray& displacement, std::vector<double>& multipliers) const {
  const std::size_t slots = u_.size();
  for (std::size_t i = 0; i < slots; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) displacement[axis * slots + i] = u_[i][axis];
  multipliers.assign(listed_.size(), 0.0);
  for (const Row& row : rows_) multipliers[row.pair] = row.lambda * row.scale;
}

bool ContactProjection::project(std::span<const PairGap> pairs, AlignedArray& displacement, std::vector<double>& multipliers) {
  collect(pairs, displacement, multipliers);
  bool solved = true;
  do {
    solved = solve_rows();
  } while (solved && add_violated(pairs));
  give(displacement, multipliers);
  return solved;
}

}  // namespace lanescape
