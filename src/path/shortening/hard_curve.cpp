#include "path/shortening/hard_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "path/bend.hpp"

namespace lanescape {
namespace {

// [unit of length]
constexpr double reach = 0.5;              // of gaps that have constraints
constexpr double margin = 1e-8;            // of gaps: more than the square of the last moves
constexpr double largest_overlap = 5e-10;  // of the path that is handed out
constexpr double longest_move = 0.22;      // of a sphere: two that meet from beyond the reach do not touch
constexpr double furthest = 0.16;          // that an iteration starts ahead of the path, by sphere
// Of products of slacks and multipliers [mean segment squared]. While the path relaxes the barrier stays; then it falls by a factor
// in each iteration that leaves a calm path.
constexpr double first_barrier = 1e-5, later_barrier = 1e-6, last_barrier = 1e-8, tight_barrier = 1e-12, barrier_decay = 0.7;
constexpr double calm_at_first = 0.03, calm = 0.07;  // residuals
// A level, and the path handed out, have come to rest below these residuals; a path below 10^-2 is called stationary.
constexpr double settled_level = 0.012, settled = 8e-3, settled_tight = 9.5e-3;
constexpr double warmth = 10.0;          // multipliers of the last iteration fit this barrier, times that aimed at
constexpr double largest_tension = 5.0;  // of short segments
constexpr double most_momentum = 0.7;    // at most, of the last move
constexpr double bulge = 0.5;            // share of that of gaps which is taken into account
constexpr double later_softness = 0.9;   // of the string along its segments, but while it relaxes
// Of moves: 1 is that of a node held by strings of its own. While the barrier falls it is this over the square of the number of
// segments, which slows a wave along the path by the same factor on each level.
constexpr double later_damping = 150.0, last_damping = 10.0;
constexpr int few_steps = 2, more_steps = 4, most_steps = 40;  // of the interior-point method: relaxing, falling, at last
constexpr std::uint64_t most_iterations = 400, most_tight_iterations = 40;
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
  tangents_.assign(nodes - 1, AlignedArray(3 * layout_.size(), 0.0));
}

void HardCurve::begin(Polyline nodes) {
  const bool first = now_.empty();
  allocate(nodes.size());
  now_ = std::move(nodes);
  from_ = last_ = now_;
  barrier_ = first ? first_barrier : later_barrier;
  begin_phase(first ? Phase::relaxes : Phase::falls);
}

bool HardCurve::tighten() {
  if (phase_ >= Phase::settles) return false;
  begin_phase(Phase::settles);
  return true;
}

void HardCurve::begin_phase(Phase phase) {
  phase_ = phase;
  phase_iterations_ = onward_ = 0;
  if (phase != Phase::relaxes) from_ = now_;
}

void HardCurve::set_string() {
  const std::size_t segments = from_.size() - 1;
  mean_ = polyline_length(algebra_, from_) / static_cast<double>(segments);
  const SphereCoordinates& coordinates = gaps_.coordinates();
  for (std::size_t k = 0; k < segments; ++k) {
    const double length = algebra_.distance(from_[k], from_[k + 1]);
    tensions_[k] = std::min(largest_tension, mean_ / length);
    for (std::size_t c = 0; c < coordinates.dimension(); ++c) {
      const std::size_t q = coordinates.slot_coordinate(c);
      tangents_[k][c] = (from_[k + 1][q] - from_[k][q]) / length;
      if (k > 0)
        gradient_[k - 1][c] = tensions_[k - 1] * (from_[k][q] - from_[k - 1][q]) - tensions_[k] * (from_[k + 1][q] - from_[k][q]);
    }
  }
}

void HardCurve::solve() {
  const bool tight = phase_ == Phase::tightens, relaxes = phase_ == Phase::relaxes;
  const double unit = mean_ * mean_, target = (tight ? tight_barrier : barrier_) * unit, size = std::min(1.0, residual_);
  const auto segments = static_cast<double>(tensions_.size());
  gaps_.follow(from_, warmth * target, !tight);
  const int steps = tight ? most_steps : relaxes ? few_steps : more_steps;
  const InteriorPoint::Goal goal{target, (tight ? 1e-10 : 1e-2) * options_.length_unit, (tight ? 1e-3 : 0.1) * size * mean_, steps};
  const double damping = tight ? last_damping : relaxes ? 0.0 : later_damping / (segments * segments);
  const double softness = tight || relaxes ? 0.0 : later_softness;
  interior_->solve({gradient_, tensions_, tangents_, softness, damping, bulge}, gaps_.of_segments(), goal);
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
  const bool on = along >= 0.0 && phase_ == Phase::relaxes;
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
        if (phase_ != Phase::tightens || c.gap + taken_off < contact_) c.push(node, c.multiplier / mean_, rest.data());
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
  ++phase_iterations_;
  return next_phase();
}

Relaxation HardCurve::next_phase() {
  if (phase_ == Phase::tightens) return tightened();
  if (residual_ < (phase_ == Phase::relaxes ? calm_at_first : calm)) {
    if (phase_ == Phase::relaxes) begin_phase(Phase::falls);
    barrier_ = std::max(last_barrier, barrier_decay * barrier_);
  }
  const bool at_rest = barrier_ <= last_barrier && residual_ < (phase_ == Phase::settles ? settled : settled_level);
  const bool ended = at_rest || phase_iterations_ >= most_iterations;
  if (ended && phase_ == Phase::settles) begin_phase(Phase::tightens);
  if (!ended || phase_ == Phase::tightens) return Relaxation::continues;
  return at_rest ? Relaxation::stationary : Relaxation::stopped;
}

Relaxation HardCurve::tightened() const {
  const bool clear = gaps_.smallest_gap() >= -largest_overlap * options_.length_unit;
  if (clear && residual_ < settled_tight) return Relaxation::stationary;
  if (phase_iterations_ < most_tight_iterations) return Relaxation::continues;
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
  auto phase = static_cast<std::uint64_t>(phase_);
  archive.field("phase", phase);
  phase_ = static_cast<Phase>(phase);
  archive.field("phase_iterations", phase_iterations_);
  archive.field("barrier", barrier_);
  archive.field("onward", onward_);
  gaps_.exchange(archive);
}

}  // namespace lanescape
