#include "stepper/contact_projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/slot_point.hpp"

namespace lanescape {
namespace {

constexpr int sweeps_per_round = 3;
constexpr auto none = ~std::uint32_t{0};
constexpr double linear = 1e-13;  // the curvature, relative to that of a single contact, of a dual that rounding has curved

}  // namespace

ContactProjection::ContactProjection(AlignedArray inverse_masses, const Options& options)
    : inverse_masses_(std::move(inverse_masses)), options_(options), wish_(inverse_masses_.size()), u_(wish_.size()) {}

// What is left of a gap beyond the margin. Contacts closer than that need not part, which may be impossible; overlaps must.
double ContactProjection::allowed_approach(double gap) const { return gap < 0.0 ? gap : std::max(0.0, gap - options_.margin); }

void ContactProjection::add_row(const PairGap& pair, std::size_t number, double multiplier) {
  const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
  const double scale = 1.0 / std::sqrt(inverse_masses_[i] + inverse_masses_[j]);
  const Point a{scale * pair.normal[0], scale * pair.normal[1], scale * pair.normal[2]};
  rows_.push_back({i, j, number, a, scale});
  at_wish_.push_back(scale * allowed_approach(pair.gap) + dot(a, difference(wish_[j], wish_[i])));
  lambda_.push_back(multiplier / scale);
  listed_[number] = 1;
}

// Gives a row to every pair that u brings too close; returns whether there was any.
bool ContactProjection::add_violated(std::span<const PairGap> pairs) {
  const std::size_t before = rows_.size();
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const PairGap& pair = pairs[c];
    if (listed_[c]) continue;
    const Point approach = difference(u_[static_cast<std::size_t>(pair.second)], u_[static_cast<std::size_t>(pair.first)]);
    if (allowed_approach(pair.gap) + dot(pair.normal, approach) < -options_.tolerance) add_row(pair, c, 0.0);
  }
  return rows_.size() > before;
}

void ContactProjection::collect(std::span<const PairGap> pairs, const AlignedArray& wish, const std::vector<double>& multipliers) {
  const std::size_t slots = wish_.size();
  for (std::size_t i = 0; i < slots; ++i) wish_[i] = slot_point(wish, i);
  for (auto* array : {&lambda_, &at_wish_}) array->clear();
  rows_.clear();
  listed_.assign(pairs.size(), 0);
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    if (pairs[c].first == pairs[c].second)
      listed_[c] = 1;
    else if (c < multipliers.size() && multipliers[c] > 0.0)
      add_row(pairs[c], c, multipliers[c]);
  }
  u_ = wish_;
  add_violated(pairs);
}

double ContactProjection::coupling(const Row& row, std::size_t shared, const Row& other) const {
  const double sign = (row.i == shared) == (other.i == shared) ? 1.0 : -1.0;
  return sign * inverse_masses_[shared] * dot(row.a, other.a);
}

// The entries of A M^-1 A^T; those of two rows that share both spheres are given as two.
void ContactProjection::couple_rows() {
  slot_begin_.assign(wish_.size() + 1, 0);
  for (const Row& row : rows_)
    for (const std::size_t slot : {row.i, row.j}) ++slot_begin_[slot + 1];
  for (std::size_t slot = 0; slot < wish_.size(); ++slot) slot_begin_[slot + 1] += slot_begin_[slot];
  slot_rows_.resize(2 * rows_.size());
  std::vector<std::size_t> next = slot_begin_;
  for (std::size_t c = 0; c < rows_.size(); ++c)
    for (const std::size_t slot : {rows_[c].i, rows_[c].j}) slot_rows_[next[slot]++] = c;
  entries_.clear();
  row_begin_.assign(1, 0);
  for (std::size_t c = 0; c < rows_.size(); ++c) {
    for (const std::size_t slot : {rows_[c].i, rows_[c].j})
      for (std::size_t k = slot_begin_[slot]; k < slot_begin_[slot + 1]; ++k)
        if (slot_rows_[k] != c)
          entries_.push_back({static_cast<std::uint32_t>(slot_rows_[k]), coupling(rows_[c], slot, rows_[slot_rows_[k]])});
    row_begin_.push_back(entries_.size());
  }
}

// u from the multipliers.
void ContactProjection::move_by_multipliers() {
  u_ = wish_;
  for (std::size_t c = 0; c < rows_.size(); ++c) {
    const auto& [i, j, pair, a, scale] = rows_[c];
    const double at_i = lambda_[c] * inverse_masses_[i], at_j = lambda_[c] * inverse_masses_[j];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      u_[i][axis] -= at_i * a[axis];
      u_[j][axis] += at_j * a[axis];
    }
  }
}

double ContactProjection::gap(std::size_t row) const {
  double sum = at_wish_[row] + lambda_[row];
  for (std::size_t k = row_begin_[row]; k < row_begin_[row + 1]; ++k) sum += entries_[k].value * lambda_[entries_[k].column];
  return sum;
}

void ContactProjection::sweep() {
  for (std::size_t c = 0; c < rows_.size(); ++c) lambda_[c] = std::max(0.0, lambda_[c] - gap(c));
}

// The largest gap of a row that acts, or the largest overlap of one that does not [sigma].
double ContactProjection::worst_row() const {
  double worst = 0.0;
  for (std::size_t c = 0; c < rows_.size(); ++c) {
    const double g = gap(c) / rows_[c].scale;
    worst = std::max(worst, lambda_[c] > 0.0 ? std::abs(g) : -g);
  }
  return worst;
}

// The rows that act, numbered anew, with their gaps and their part of the matrix; returns the squared norm of the gaps.
double ContactProjection::begin_face() {
  face_.clear();
  in_face_.assign(rows_.size(), none);
  for (std::size_t c = 0; c < rows_.size(); ++c)
    if (lambda_[c] > 0.0) {
      in_face_[c] = static_cast<std::uint32_t>(face_.size());
      face_.push_back(c);
    }
  const std::size_t n = face_.size();
  for (auto* array : {&gaps_, &image_, &at_face_}) array->resize(n);
  face_begin_.assign(1, 0);
  face_entries_.clear();
  double squared = 0.0;
  for (std::size_t f = 0; f < n; ++f) {
    const std::size_t c = face_[f];
    for (std::size_t k = row_begin_[c]; k < row_begin_[c + 1]; ++k)
      if (in_face_[entries_[k].column] != none) face_entries_.push_back({in_face_[entries_[k].column], entries_[k].value});
    face_begin_.push_back(face_entries_.size());
    at_face_[f] = lambda_[c];
    gaps_[f] = gap(c);
    squared += gaps_[f] * gaps_[f];
  }
  direction_ = gaps_;
  return squared;
}

// image = A M^-1 A^T direction; returns how far the minimum of the dual lies along the direction. Where contacts depend on each
// other the dual can be linear in it.
double ContactProjection::length_to_minimum(double squared) {
  double curvature = 0.0, norm = 0.0;
  for (std::size_t f = 0; f < face_.size(); ++f) {
    const double d = direction_[f];
    double sum = d;
    for (std::size_t k = face_begin_[f]; k < face_begin_[f + 1]; ++k)
      sum += face_entries_[k].value * direction_[face_entries_[k].column];
    image_[f] = sum;
    curvature += d * sum;
    norm += d * d;
  }
  return curvature > linear * norm ? squared / curvature : std::numeric_limits<double>::infinity();
}

// The longest step along the direction, up to `length`, that leaves no multiplier negative.
double ContactProjection::allowed_length(double length) const {
  double allowed = length;
  for (std::size_t f = 0; f < face_.size(); ++f)
    if (allowed * direction_[f] > at_face_[f]) allowed = at_face_[f] / direction_[f];
  return allowed;
}

// Conjugate gradients for the rows that act, until their gaps are closed or a multiplier reaches zero. Returns false where the dual
// has no minimum: then no displacement removes all overlaps.
bool ContactProjection::solve_face() {
  double squared = begin_face();
  const double target = 0.1 * options_.tolerance * options_.tolerance;
  for (std::size_t iteration = 0; iteration < 2 * face_.size() + 10 && squared > target; ++iteration) {
    const double length = length_to_minimum(squared), allowed = allowed_length(length);
    if (std::isinf(allowed)) return false;
    double next_squared = 0.0;
    for (std::size_t f = 0; f < face_.size(); ++f) {
      at_face_[f] = std::max(0.0, at_face_[f] - allowed * direction_[f]);
      gaps_[f] -= allowed * image_[f];
      next_squared += gaps_[f] * gaps_[f];
    }
    if (allowed < length) break;
    const double ratio = next_squared / squared;
    for (std::size_t f = 0; f < face_.size(); ++f) direction_[f] = gaps_[f] + ratio * direction_[f];
    squared = next_squared;
  }
  for (std::size_t f = 0; f < face_.size(); ++f) lambda_[face_[f]] = at_face_[f];
  return true;
}

bool ContactProjection::solve_rows() {
  couple_rows();
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
  for (std::size_t c = 0; c < rows_.size(); ++c) multipliers[rows_[c].pair] = lambda_[c] * rows_[c].scale;
}

bool ContactProjection::project(std::span<const PairGap> pairs, AlignedArray& displacement, std::vector<double>& multipliers) {
  collect(pairs, displacement, multipliers);
  bool solved = true;
  do {
    solved = solve_rows();
    move_by_multipliers();
  } while (solved && add_violated(pairs));
  give(displacement, multipliers);
  return solved;
}

}  // namespace lanescape
