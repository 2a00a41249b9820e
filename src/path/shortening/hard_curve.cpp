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
// Of products of slacks and multipliers [mean segment squared]: while the path relaxes; what it falls to, by a factor in each
// iteration that leaves a calm path; and what it is tightened to.
constexpr double first_barrier = 1e-5, last_barrier = 1e-8, tight_barrier = 1e-10, barrier_decay = 0.7, tight_decay = 0.1;
// A level is at rest below this residual, or when its length falls by less than this part in so many iterations: at a high barrier
// residuals are not better than the multipliers, about 0.1.
constexpr double calm_at_first = 0.03, least_progress = 7e-5;
// An iteration takes twice as long on each level. From the third level on a path relaxes for a few only: what it falls along
// valleys would be taken for what the refinement changes.
constexpr std::uint64_t progress_iterations = 6, relaxing_levels = 2, few_iterations = 12;
constexpr double calm = 0.07, calm_move = 0.03;  // a residual, or [unit of length] moves of spheres, that let the barrier fall
constexpr double settled = 8e-3, settled_tight = 9.5e-3;  // residuals; a path below 10^-2 is called stationary
constexpr double warmth = 10.0;                           // multipliers of the last iteration fit this barrier, times that aimed at
constexpr double largest_tension = 5.0;                   // of short segments
constexpr double most_momentum = 0.7;                     // at most, of the last move
constexpr double bulge = 0.5;                             // share of that of gaps which is taken into account
constexpr double later_softness = 0.9;                    // of the string along its segments, while the barrier falls
// Of moves: 1 is that of a node held by strings of its own. While the barrier falls it is this over the square of the number of
// segments, which slows a wave along the path by the same factor on each level.
constexpr double later_damping = 150.0, tight_damping = 10.0, clear_damping = 1000.0;
constexpr int few_steps = 2, more_steps = 4, most_steps = 8;  // of the interior-point method: relaxing, falling, at last
constexpr std::uint64_t most_iterations = 400, most_tight_iterations = 40;
constexpr double matrix_memory = 4.0 * 1024 * 1024 * 1024;  // [bytes]
constexpr double matrix_share = 1.25;                       // of numbers for a node, to the square of its coordinates
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
  return 2 + static_cast<std::size_t>(matrix_memory / (matrix_share * dimension * dimension * sizeof(double)));
}

void HardCurve::allocate(std::size_t nodes) {
  interior_ = std::make_unique<InteriorPoint>(kernel_table(isa_), nodes, 3 * layout_.size(), options_.threads);
  gaps_.begin(nodes - 1);
  tensions_.assign(nodes - 1, 1.0);
  gradient_.assign(nodes - 2, AlignedArray(3 * layout_.size(), 0.0));
  tangents_.assign(nodes - 1, AlignedArray(3 * layout_.size(), 0.0));
}

void HardCurve::begin(Polyline nodes) {
  allocate(nodes.size());
  now_ = std::move(nodes);
  from_ = last_ = now_;
  barrier_ = first_barrier;
  ++levels_;
  begin_phase(Phase::relaxes);
}

bool HardCurve::tighten() {
  if (phase_ != Phase::relaxes) return false;
  begin_phase(Phase::settles);
  return true;
}

void HardCurve::begin_phase(Phase phase) {
  phase_ = phase;
  phase_iterations_ = onward_ = 0;
  last_length_ = 0.0;
  from_ = now_;
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
  const bool tight = phase_ >= Phase::tightens, relaxes = phase_ == Phase::relaxes, clears = phase_ == Phase::clears;
  const double target = barrier_ * mean_ * mean_, size = std::min(1.0, residual_);
  const auto segments = static_cast<double>(tensions_.size());
  gaps_.follow(from_, warmth * target, clears ? GapConstraints::Shape::planes : GapConstraints::Shape::approaches);
  const int steps = clears ? most_steps : relaxes ? few_steps : more_steps;
  const InteriorPoint::Goal goal{target, (tight ? 1e-10 : 1e-2) * options_.length_unit, (tight ? 1e-3 : 0.1) * size * mean_, steps};
  const double damping = clears ? clear_damping : tight ? tight_damping : relaxes ? 0.0 : later_damping / (segments * segments);
  const double softness = tight || relaxes ? 0.0 : later_softness;
  interior_->solve({gradient_, tensions_, tangents_, softness, damping, bulge}, gaps_.of_segments(), goal);
}

// Takes the moves that were found, shortened so that no pair without a constraint can meet.
void HardCurve::move() {
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
  longest_ = share * wanted;
}

// Starts the next iteration ahead of the path, in the direction of the last one, until an iteration turns back (O'Donoghue and
// Candes 2015).
void HardCurve::look_ahead() {
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
      on ? std::min(most_momentum * since / (since + 3.0), furthest * options_.length_unit / std::max(longest_, 1e-300)) : 0.0;
  onward_ = on ? onward_ + 1 : 0;
  from_ = now_;
  if (share > 0.0)
    for (std::size_t k = 1; k + 1 < now_.size(); ++k) algebra_.combine(from_[k], now_[k], share, now_[k], -share, last_[k]);
}

// The Kuhn-Tucker residual by the multipliers of the last iteration. Of the path handed out, only pairs that touch have any. Forces
// on planes say nothing about it: moves that end overlaps leave it as it was.
void HardCurve::judge() {
  const SegmentGapConstraints segments = gaps_.at(now_);
  if (phase_ == Phase::clears) return;
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
  move();
  judge();
  look_ahead();
  ++phase_iterations_;
  return next_phase();
}

// Whether a path that relaxes may go on to the next level.
bool HardCurve::is_calm() {
  const std::uint64_t most = levels_ <= relaxing_levels ? most_iterations : few_iterations;
  if (residual_ < calm_at_first || phase_iterations_ >= most) return true;
  if (phase_iterations_ % progress_iterations != 0) return false;
  const double length = polyline_length(algebra_, now_);
  const bool stays = last_length_ > 0.0 && last_length_ - length < least_progress * length;
  last_length_ = length;
  return stays;
}

Relaxation HardCurve::next_phase() {
  if (phase_ == Phase::relaxes) return is_calm() ? Relaxation::stationary : Relaxation::continues;
  if (phase_ == Phase::clears) return cleared();
  const bool tight = phase_ == Phase::tightens;
  const double lowest = tight ? tight_barrier : last_barrier;
  const bool low = barrier_ <= lowest;
  if (tight)
    barrier_ = std::max(lowest, tight_decay * barrier_);
  else if (residual_ < calm || longest_ < calm_move * options_.length_unit)
    barrier_ = std::max(lowest, barrier_decay * barrier_);
  const bool at_rest = low && residual_ < (tight ? settled_tight : settled);
  if (at_rest || phase_iterations_ >= (tight ? most_tight_iterations : most_iterations))
    begin_phase(tight ? Phase::clears : Phase::tightens);
  return Relaxation::continues;
}

Relaxation HardCurve::cleared() const {
  if (gaps_.smallest_gap() >= -largest_overlap * options_.length_unit)
    return residual_ < settled_tight ? Relaxation::stationary : Relaxation::stopped;
  if (phase_iterations_ < most_tight_iterations) return Relaxation::continues;
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
  archive.field("last_length", last_length_);
  archive.field("levels", levels_);
  archive.field("onward", onward_);
  gaps_.exchange(archive);
}

}  // namespace lanescape
