#include "path/shortening/hard_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "path/bend.hpp"

namespace lanescape {
namespace {

// [unit of length]
constexpr double reach = 0.8;              // of gaps that have constraints
constexpr double margin = 1e-8;            // of gaps: more than the square of the last moves
constexpr double largest_overlap = 5e-10;  // of the path that is handed out
constexpr double longest_move = 0.36;      // of a sphere: two that meet from beyond the reach do not touch
// Of products of slacks and multipliers [mean segment squared]. The barrier falls by a factor an iteration, but no faster than the
// square of the residual.
constexpr double first_barrier = 1e-4, later_barrier = 1e-6, last_barrier = 1e-9, tight_barrier = 1e-12, barrier_decay = 0.85;
constexpr double residual_barrier = 1e-6;
// A level, and the path handed out, have come to rest below these residuals; a path below 10^-2 is called stationary.
constexpr double settled = 7e-3, settled_tight = 9e-3;
constexpr double warmth = 10.0;                // multipliers of the last iteration fit this barrier, times that aimed at
constexpr double largest_tension = 5.0;        // of short segments
constexpr double most_momentum = 0.9;          // at most, of the last move
constexpr double furthest = 0.16;              // that an iteration starts ahead of the path, by sphere [unit of length]
constexpr double last_damping = 1.0;           // of the last moves, that of a node held by strings of its own
constexpr int few_steps = 4, most_steps = 40;  // of the interior-point method, while the barrier falls and after
constexpr std::uint64_t most_level_iterations = 400, most_tight_iterations = 20;
constexpr double matrix_memory = 4.0 * 1024 * 1024 * 1024;  // [bytes]
constexpr double contact_gap = 5e-7;  // of pairs that touch [smallest diameter]: half of what the certificate takes for a contact

}  // namespace

HardCurve::HardCurve(const HardSpherePath& path, const HardCurveOptions& options)
    : box_(path.box),
      layout_(path.layout),
      radii_(path.radii),
      metric_(path.metric),
      isa_(path.isa),
      options_(options),
      algebra_(kernel_table(path.isa)),
      contact_(contact_gap * 2.0 * *std::min_element(path.radii.begin(), path.radii.end())),
      gaps_(HardSpherePath{box_, layout_, radii_, metric_, isa_},
            {reach * options.length_unit, margin * options.length_unit, options.threads}) {
  if (most_nodes() < 3)
    throw Error(
        ErrorCode::bad_input,
        fmt::format("curve shortening of {} hard spheres takes more than 4 GiB: use Monte Carlo shortening", layout_.size()));
}

std::size_t HardCurve::most_nodes() const {
  const auto dimension = static_cast<double>(3 * layout_.size());
  return 2 + static_cast<std::size_t>(matrix_memory / (2.0 * dimension * dimension * sizeof(double)));
}

void HardCurve::allocate(std::size_t nodes) {
  interior_ = std::make_unique<InteriorPoint>(kernel_table(isa_), nodes, 3 * layout_.size(), options_.threads);
  gaps_.begin(nodes - 1);
  tensions_.assign(nodes - 1, 1.0);
  gradient_.assign(nodes - 2, AlignedArray(3 * layout_.size(), 0.0));
}

void HardCurve::begin(Polyline nodes) {
  const bool first = now_.empty();
  allocate(nodes.size());
  now_ = std::move(nodes);
  from_ = last_ = now_;
  // Later levels begin where the barrier has fallen to.
  level_iterations_ = first ? 0 : static_cast<std::uint64_t>(std::log(later_barrier / first_barrier) / std::log(barrier_decay));
  onward_ = tightening_ = 0;
}

bool HardCurve::tighten() {
  if (tightening_ > 0) return false;
  tightening_ = 1;
  level_iterations_ = 0;
  from_ = now_;
  return true;
}

void HardCurve::set_string() {
  const std::size_t segments = from_.size() - 1;
  mean_ = polyline_length(algebra_, from_) / static_cast<double>(segments);
  for (std::size_t k = 0; k < segments; ++k)
    tensions_[k] = std::min(largest_tension, mean_ / algebra_.distance(from_[k], from_[k + 1]));
  const SphereCoordinates& coordinates = gaps_.coordinates();
  for (std::size_t k = 1; k < segments; ++k)
    for (std::size_t c = 0; c < coordinates.dimension(); ++c) {
      const std::size_t q = coordinates.slot_coordinate(c);
      gradient_[k - 1][c] = tensions_[k - 1] * (from_[k][q] - from_[k - 1][q]) - tensions_[k] * (from_[k + 1][q] - from_[k][q]);
    }
}

double HardCurve::barrier() const {
  if (tightening_ > 0) return tight_barrier;
  return std::max({last_barrier, residual_barrier * std::min(1.0, residual_ * residual_),
                   first_barrier * std::pow(barrier_decay, static_cast<double>(level_iterations_))});
}

void HardCurve::solve() {
  const double target = barrier(), unit = mean_ * mean_, size = std::min(1.0, residual_);
  const bool soft = target > last_barrier;
  gaps_.follow(from_, warmth * target * unit, soft);
  const InteriorPoint::Goal goal{target * unit, (soft ? 1e-2 : 1e-6) * options_.length_unit, (soft ? 0.1 : 1e-3) * size * mean_,
                                 soft ? few_steps : most_steps};
  interior_->solve({gradient_, tensions_, tightening_ > 0 ? last_damping : 0.0}, gaps_.of_segments(), goal);
}

// Takes the moves that were found, shortened so that no pair without a constraint can meet. Returns the longest of a sphere.
double HardCurve::move() {
  const SphereCoordinates& coordinates = gaps_.coordinates();
  const auto longest = [&](const std::vector<AlignedArray>& moves) {
    double largest = 0.0;
    for (const AlignedArray& y : moves)
      for (std::size_t c = 0; c < y.size(); c += 3) largest = std::max(largest, std::hypot(y[c], y[c + 1], y[c + 2]));
    return largest;
  };
  const double most = longest_move * options_.length_unit, wanted = longest(interior_->moves());
  const double share = wanted > most ? most / wanted : 1.0;
  last_ = std::move(now_);
  now_ = from_;
  for (std::size_t k = 0; k < interior_->moves().size(); ++k)
    for (std::size_t c = 0; c < coordinates.dimension(); ++c)
      now_[k + 1][coordinates.slot_coordinate(c)] += share * interior_->moves()[k][c];
  return share * wanted;
}

// Starts the next iteration ahead of the path, in the direction of the last one, until an iteration turns back (O'Donoghue and
// Candes 2015).
void HardCurve::look_ahead(double longest) {
  double along = 0.0;
  AlignedArray taken(layout_.dimension(), 0.0), moved(taken);
  for (std::size_t k = 1; k + 1 < now_.size(); ++k) {
    algebra_.difference(taken, now_[k], from_[k]);
    algebra_.difference(moved, now_[k], last_[k]);
    along += algebra_.dot(taken, moved);
  }
  const bool on = along >= 0.0 && tightening_ == 0;
  const auto since = static_cast<double>(onward_);
  const double share =
      on ? std::min(most_momentum * since / (since + 3.0), furthest * options_.length_unit / std::max(longest, 1e-300)) : 0.0;
  onward_ = on ? onward_ + 1 : 0;
  from_ = now_;
  if (share > 0.0)
    for (std::size_t k = 1; k + 1 < now_.size(); ++k) algebra_.combine(from_[k], now_[k], share, now_[k], -share, last_[k]);
}

// The Kuhn-Tucker residual by the multipliers of the last iteration. Of the path handed out, only pairs that touch have any.
void HardCurve::judge() {
  const SegmentGapConstraints segments = gaps_.at(now_);
  const SphereCoordinates& coordinates = gaps_.coordinates();
  const double taken_off = margin * options_.length_unit;
  BendNorms norms(now_.size());
  Bend bend(algebra_, now_);
  std::vector<double> rest(coordinates.dimension());
  for (std::size_t k = 1; k + 1 < now_.size(); ++k) {
    const AlignedArray& tau = bend.at(k);
    for (std::size_t c = 0; c < rest.size(); ++c) rest[c] = tau[coordinates.slot_coordinate(c)];
    for (std::size_t node = 0; node < 2; ++node)
      for (const GapConstraint& c : segments[node == 1 ? k - 1 : k]) {
        if (tightening_ == 0 || c.gap + taken_off < contact_) c.push(node, c.multiplier / mean_, rest.data());
      }
    double squared = 0.0;
    for (const double x : rest) squared += x * x;
    norms.set(k, algebra_.norm(tau), std::sqrt(squared), bend.floor());
  }
  residual_ = norms.residual();
}

Relaxation HardCurve::iterate() {
  set_string();
  solve();
  const double longest = move();
  judge();
  look_ahead(longest);
  ++level_iterations_;
  return state();
}

Relaxation HardCurve::state() {
  if (tightening_ == 0) {
    if (residual_ < settled && barrier() <= last_barrier) return Relaxation::stationary;
    return level_iterations_ < most_level_iterations ? Relaxation::continues : Relaxation::stopped;
  }
  const bool clear = gaps_.smallest_gap() >= -largest_overlap * options_.length_unit;
  if (clear && residual_ < settled_tight) return Relaxation::stationary;
  if (level_iterations_ < most_tight_iterations) return Relaxation::continues;
  if (clear) return Relaxation::stopped;
  throw Error(ErrorCode::goal_not_reached,
              fmt::format("spheres of the path still overlap by {:.3g} sigma, and cannot be moved apart", -gaps_.smallest_gap()));
}

void HardCurve::exchange(Archive& archive) {
  std::uint64_t count = now_.size();
  archive.field("node_count", count);
  if (archive.reading()) {
    allocate(count);
    for (Polyline* line : {&now_, &from_}) line->assign(count, AlignedArray(layout_.dimension(), 0.0));
  }
  exchange_nodes(archive, "nodes", now_);
  exchange_nodes(archive, "next_start", from_);
  archive.field("residual", residual_);
  archive.field("level_iterations", level_iterations_);
  archive.field("onward", onward_);
  archive.field("tightening", tightening_);
  gaps_.exchange(archive);
}

}  // namespace lanescape
