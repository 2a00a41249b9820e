#include "path/shortening/soft_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "path/bend.hpp"
#include "path/path_check.hpp"

namespace lanescape {
namespace {

// Lengths in 3N space for 108 particles of unit diameter; they grow with sqrt(N), as |grad V| does.
constexpr double scale_particles = 108.0;
constexpr double longest_step = 0.3;             // of a node in one iteration
constexpr double longest_correction = 0.1;       // of a node in one move back along the gradient
constexpr double curvature_displacement = 0.01;  // for differences of gradients: smooths the jumps at cutoffs
// Of steps before the curvature of V is known, in units of 1/length^2. Below 3 they swing to and fro across narrow valleys.
constexpr double damping = 4.0;
constexpr double stationary_residual = 5e-3;  // of PHYSICS 4, below which a path has come to rest
constexpr double smallest_trust = 1e-7;
constexpr int most_improvements = 60;
constexpr double allowed_violation = 2.5e-4;  // of V - E_L on a segment that tighten() lets stand [epsilon]
// A node this far below its level is on the boundary [epsilon].
constexpr double boundary_tolerance = PathCheckOptions{}.boundary_tolerance;

// Multipliers of a coarser path at the nodes of a finer one: they are second differences, which fall with the square of the
// spacing.
std::vector<double> prolonged(const std::vector<double>& coarse, std::size_t nodes) {
  const double ratio = static_cast<double>(coarse.size() - 1) / static_cast<double>(nodes - 1);
  std::vector<double> fine(nodes, 0.0);
  for (std::size_t k = 1; k + 1 < nodes; ++k) {
    const double at = ratio * static_cast<double>(k);
    const auto before = std::min(static_cast<std::size_t>(at), coarse.size() - 2);
    const double part = at - static_cast<double>(before);
    fine[k] = ratio * ratio * ((1.0 - part) * coarse[before] + part * coarse[before + 1]);
  }
  return fine;
}

}  // namespace

SoftCurve::SoftCurve(SoftLandscapeMaker make_landscape, double landscape_energy, const SoftCurveOptions& options)
    : make_landscape_(std::move(make_landscape)), landscape_energy_(landscape_energy), options_(options) {}

void SoftCurve::allocate(Polyline nodes) {
  if (nodes_) earlier_evaluations_ += nodes_->evaluations();
  const std::size_t count = nodes.size(), dimension = nodes.front().size();
  nodes_ = std::make_unique<SoftNodes>(make_landscape_, count, options_.threads);
  scale_ = options_.length_unit * std::sqrt(static_cast<double>(make_landscape_()->particles()) / scale_particles);
  boundary_.emplace(nodes_->algebra(), nodes_->blocks(), count, dimension);
  now_.emplace(nodes);
  trial_.emplace(nodes);
  levels_.assign(count, landscape_energy_);
  curving_.assign(count, 0.0);
  for (Polyline* field : {&pull_, &step_, &rest_, &conditioned_, &direction_, &applied_})
    field->assign(count, AlignedArray(dimension, 0.0));
}

void SoftCurve::begin(Polyline nodes) {
  std::vector<double> multipliers = boundary_ ? prolonged(boundary_->multipliers(), nodes.size()) : std::vector<double>();
  allocate(std::move(nodes));
  if (!multipliers.empty()) boundary_->set_multipliers(std::move(multipliers));
  trust_ = longest_step * scale_;
  nodes_->evaluate(*now_);
  if (!nodes_->restore(*now_, levels_, longest_correction * scale_))
    throw Error(ErrorCode::goal_not_reached, "a node of the path cannot be moved back to V <= E_L along the gradient");
  trial_ = now_;
}

double SoftCurve::string_energy(const Polyline& nodes) const {
  const VectorAlgebra& algebra = nodes_->algebra();
  const auto half_square = [&](std::size_t k) {
    const double d = algebra.distance(nodes[k], nodes[k + 1]);
    return 0.5 * d * d;
  };
  return half_square(0) + nodes_->blocks().sum(half_square);
}

double SoftCurve::longest(const Polyline& field) const {
  return nodes_->blocks().largest([&](std::size_t k) { return nodes_->algebra().norm(field[k]); });
}

double SoftCurve::product(const Polyline& a, const Polyline& b) const {
  return nodes_->blocks().sum([&](std::size_t k) { return nodes_->algebra().dot(a[k], b[k]); });
}

// The second derivative of the string's energy less that of the multipliers' part of V, times a field. Returns their product.
double SoftCurve::apply_curved(const Polyline& direction, Polyline& out) {
  std::array<double, NodeBlocks::count> products{};
  nodes_->blocks().for_each_block([&](std::size_t block, std::size_t begin, std::size_t end) {
    double product = 0.0;
    for (std::size_t k = begin; k < end; ++k) {
      apply_string(nodes_->algebra(), direction, k, out[k]);
      nodes_->add_curvature(*now_, k, block, direction[k], curving_[k], curvature_displacement * scale_, out[k]);
      product += nodes_->algebra().dot(direction[k], out[k]);
    }
    products[block] = product;
  });
  return std::accumulate(products.begin(), products.end(), 0.0);
}

// The step without the curvature of V, cut to the trust region: it makes the string shorter to first order, whatever its length.
void SoftCurve::find_boundary_step() {
  const std::size_t count = now_->nodes.size();
  string_pull(nodes_->algebra(), now_->nodes, pull_, nodes_->blocks());
  std::vector<double> room(count, 0.0);
  for (std::size_t k = 1; k + 1 < count; ++k)
    room[k] = now_->slopes[k] > 0.0 ? std::max(0.0, levels_[k] - now_->energies[k]) / now_->slopes[k] : 1e300;
  const double spacing = polyline_length(nodes_->algebra(), now_->nodes) / static_cast<double>(count - 1);
  shift_ = damping * spacing * spacing / (scale_ * scale_);
  boundary_->solve(pull_, now_->normals, room, shift_, 1e-11 * scale_, step_);
  for (std::size_t k = 1; k + 1 < count; ++k)
    curving_[k] = boundary_->on_boundary(k) && now_->slopes[k] > 0.0 ? boundary_->multipliers()[k] / now_->slopes[k] : 0.0;
  const double cut = std::min(1.0, trust_ / longest(step_));
  is_cut_ = cut < 1.0;
  if (is_cut_)
    nodes_->blocks().for_each_node([&](std::size_t k) {
      for (double& x : step_[k]) x *= cut;
    });
}

// Conjugate gradients along the boundary from that step on, until they have converged to a tenth, the step reaches the end of the
// trust region, or the curvature is negative.
void SoftCurve::improve_step() {
  apply_curved(step_, applied_);
  nodes_->blocks().for_each_node([&](std::size_t k) { nodes_->algebra().difference(rest_[k], pull_[k], applied_[k]); });
  boundary_->project(rest_, now_->normals, conditioned_);
  direction_ = conditioned_;
  double weight = product(rest_, conditioned_);
  const double enough = 0.01 * weight;
  double stepped = longest(step_);
  for (int improvement = 0; improvement < most_improvements && weight > 0.0; ++improvement) {
    const double curvature = apply_curved(direction_, applied_), reach = longest(direction_);
    if (!(reach > 0.0)) return;
    const double furthest = std::max(0.0, trust_ - stepped) / reach;
    const double best = curvature > 0.0 ? weight / curvature : furthest, taken = std::min(best, furthest);
    stepped = nodes_->blocks().largest([&](std::size_t k) {
      nodes_->algebra().axpy(step_[k], step_[k], taken, direction_[k]);
      nodes_->algebra().axpy(rest_[k], rest_[k], -taken, applied_[k]);
      return nodes_->algebra().norm(step_[k]);
    });
    is_cut_ = !(best < furthest);
    if (is_cut_) return;
    boundary_->project(rest_, now_->normals, conditioned_);
    const double next = product(rest_, conditioned_);
    if (next < enough) return;
    const double keep = next / weight;
    weight = next;
    nodes_->blocks().for_each_node(
        [&](std::size_t k) { nodes_->algebra().axpy(direction_[k], conditioned_[k], keep, direction_[k]); });
  }
}

double SoftCurve::measured_residual() const {
  BendNorms norms(now_->nodes.size());
  nodes_->blocks().for_each_block([&](std::size_t, std::size_t begin, std::size_t end) {
    Bend bend(nodes_->algebra(), now_->nodes);
    AlignedArray left(now_->nodes.front().size(), 0.0);
    for (std::size_t k = begin; k < end; ++k) {
      const AlignedArray& tau = bend.at(k);
      const bool on_boundary = now_->energies[k] > levels_[k] - boundary_tolerance;
      const double lambda = on_boundary ? std::max(0.0, nodes_->algebra().dot(tau, now_->normals[k])) : 0.0;
      nodes_->algebra().axpy(left, tau, -lambda, now_->normals[k]);
      norms.set(k, nodes_->algebra().norm(tau), nodes_->algebra().norm(left), bend.floor());
    }
  });
  return norms.residual();
}

Relaxation SoftCurve::iterate() {
  find_boundary_step();
  improve_step();
  const double reach = longest(step_), before = string_energy(now_->nodes);
  const bool moved = nodes_->move(*trial_, *now_, step_, levels_, longest_correction * scale_);
  if (moved && string_energy(trial_->nodes) < before) {
    std::swap(now_, trial_);
    if (is_cut_) trust_ = std::min(1.5 * trust_, longest_step * scale_);
  } else {
    trust_ = reach / 3.0;
  }
  residual_ = measured_residual();
  if (residual_ < stationary_residual) return Relaxation::stationary;
  return trust_ < smallest_trust * scale_ ? Relaxation::stopped : Relaxation::continues;
}

// Between nodes on E_L a path that bends around the forbidden region cuts into it. Levels below E_L let each segment touch E_L: a
// node moves by what the worse of its segments is too high, or too low if it is on the boundary.
bool SoftCurve::tighten() {
  const std::vector<double> largest = nodes_->segment_energies(*now_, PathCheckOptions{}.samples);
  std::vector<double> levels = levels_;
  bool changed = false;
  for (std::size_t k = 1; k + 1 < levels.size(); ++k) {
    const double excess = std::max(largest[k - 1], largest[k]) - landscape_energy_;
    const bool on_boundary = boundary_->multipliers()[k] > 0.0;
    changed = changed || excess > allowed_violation || (on_boundary && excess < -boundary_tolerance);
    if (excess > 0.0 || on_boundary) levels[k] = std::min(landscape_energy_, levels[k] - excess - 0.5 * allowed_violation);
  }
  if (!changed) return false;
  levels_ = std::move(levels);
  if (!nodes_->restore(*now_, levels_, longest_correction * scale_))
    throw Error(ErrorCode::goal_not_reached, "a node of the path cannot be moved back below its level along the gradient");
  trust_ = longest_step * scale_;
  return true;
}

void SoftCurve::exchange(Archive& archive) {
  std::uint64_t count = nodes_ ? now_->nodes.size() : 0;
  archive.field("node_count", count);
  if (archive.reading()) allocate(Polyline(count, AlignedArray(make_landscape_()->dimension(), 0.0)));
  exchange_nodes(archive, "nodes", now_->nodes);
  exchange_nodes(archive, "normals", now_->normals);
  archive.field("energies", now_->energies);
  archive.field("slopes", now_->slopes);
  archive.field("levels", levels_);
  std::vector<double> multipliers = boundary_->multipliers();
  archive.field("multipliers", multipliers);
  boundary_->set_multipliers(std::move(multipliers));
  archive.field("trust", trust_);
  archive.field("residual", residual_);
  archive.field("earlier_evaluations", earlier_evaluations_);
  nodes_->exchange(archive);
  if (archive.reading()) trial_ = now_;
}

}  // namespace lanescape
