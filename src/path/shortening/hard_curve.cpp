#include "path/shortening/hard_curve.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "path/bend.hpp"

namespace lanescape {
namespace {

constexpr double reach = 0.3;            // of planes [unit of length]
constexpr double relaxation = 1.5;       // of the way to the midpoint of the neighbours
constexpr double stiffness = 0.02;       // of the preconditioner: about 1/length^2 of contacts, in nodes
constexpr double largest_tension = 5.0;  // of short segments
constexpr double sliding_limit = 0.2;    // of the residual before corridors are made, in which nodes move less easily
// Of nodes that touch on both sides. Contacts that begin and end keep them from settling in dense systems.
constexpr std::uint64_t most_tight_iterations = 1000;
constexpr int most_restorations = 40;

}  // namespace

HardCurve::HardCurve(const HardSpherePath& path, const HardCurveOptions& options)
    : box_(path.box), layout_(path.layout), radii_(path.radii), metric_(path.metric), isa_(path.isa), options_(options) {}

void HardCurve::allocate(Polyline nodes) {
  earlier_evaluations_ = evaluations();
  const std::size_t count = nodes.size(), dimension = layout_.dimension();
  nodes_ = std::make_unique<HardNodes>(HardSpherePath{box_, layout_, radii_, metric_, isa_}, count,
                                       HardNodes::Options{reach * options_.length_unit, options_.length_unit, options_.threads});
  now_ = std::move(nodes);
  tight_iterations_ = 0;
  tensions_.assign(count - 1, 1.0);
  for (Polyline* field : {&rest_, &conditioned_, &direction_, &applied_, &step_})
    field->assign(count, AlignedArray(dimension, 0.0));
}

void HardCurve::begin(Polyline nodes) {
  allocate(std::move(nodes));
  restore();
  follow();
}

void HardCurve::follow() {
  nodes_->follow(now_);
  moved_ = now_;
}

void HardCurve::restore() {
  if (!nodes_->restore(now_)) throw Error(ErrorCode::goal_not_reached, "the spheres of a node of the path cannot be moved apart");
}

bool HardCurve::tighten() {
  if (nodes_->planes() == HardNodes::Planes::of_segments) return false;
  nodes_->use(nodes_->planes() == HardNodes::Planes::of_nodes ? HardNodes::Planes::of_nodes_evenly
                                                              : HardNodes::Planes::of_segments);
  if (nodes_->planes() == HardNodes::Planes::of_segments) restore();
  tight_iterations_ = 0;
  follow();
  return true;
}

void HardCurve::set_tensions() {
  const std::size_t segments = now_.size() - 1;
  const double mean = polyline_length(nodes_->algebra(), now_) / static_cast<double>(segments);
  for (std::size_t k = 0; k < segments; ++k)
    tensions_[k] = nodes_->planes() != HardNodes::Planes::of_segments
                       ? 1.0
                       : std::min(largest_tension, mean / nodes_->algebra().distance(now_[k], now_[k + 1]));
}

void HardCurve::pull_at(std::size_t k, AlignedArray& pull) const {
  const VectorAlgebra& algebra = nodes_->algebra();
  algebra.difference(pull, moved_[k + 1], moved_[k]);
  for (double& x : pull) x *= tensions_[k];
  algebra.combine(pull, pull, tensions_[k - 1], moved_[k - 1], -tensions_[k - 1], moved_[k]);
}

void HardCurve::apply(const Polyline& field, std::size_t k, AlignedArray& out) const {
  const VectorAlgebra& algebra = nodes_->algebra();
  algebra.difference(out, field[k], field[k + 1]);
  for (double& x : out) x *= tensions_[k];
  algebra.combine(out, out, tensions_[k - 1], field[k], -tensions_[k - 1], field[k - 1]);
}

double HardCurve::product(const Polyline& a, const Polyline& b) const {
  return nodes_->blocks().sum([&](std::size_t k) { return nodes_->algebra().dot(a[k], b[k]); });
}

// Moves every other node beyond the point of least energy between its neighbours, as far as the corridors allow.
void HardCurve::sweep(std::size_t colour) {
  nodes_->blocks().for_each_block([&](std::size_t block, std::size_t begin, std::size_t end) {
    const VectorAlgebra& algebra = nodes_->algebra();
    AlignedArray& way = applied_[begin];
    for (std::size_t k = begin + (begin + colour) % 2; k < end; k += 2) {
      pull_at(k, way);
      const double factor = relaxation / (tensions_[k - 1] + tensions_[k]);
      for (std::size_t q = 0; q < way.size(); ++q) way[q] = factor * way[q] + (moved_[k][q] - now_[k][q]);
      if (nodes_->project(k, block, way)) algebra.axpy(moved_[k], now_[k], 1.0, way);
    }
  });
}

// Conjugate gradients in the directions along all planes that act, until they have converged to a tenth.
void HardCurve::find_step() {
  const VectorAlgebra& algebra = nodes_->algebra();
  const NodeBlocks& blocks = nodes_->blocks();
  const auto condition = [&] {
    conditioned_ = rest_;
    laplacian_.solve(conditioned_, blocks);
    blocks.for_each_node([&](std::size_t k) { nodes_->keep_to_face(k, conditioned_[k]); });
    return product(rest_, conditioned_);
  };
  blocks.for_each_node([&](std::size_t k) {
    pull_at(k, rest_[k]);
    nodes_->keep_to_face(k, rest_[k]);
    std::fill(step_[k].begin(), step_[k].end(), 0.0);
  });
  double weight = condition();
  direction_ = conditioned_;
  const double enough = 0.01 * weight;
  for (int correction = 0; correction < most_restorations && weight > enough; ++correction) {
    blocks.for_each_node([&](std::size_t k) {
      apply(direction_, k, applied_[k]);
      nodes_->keep_to_face(k, applied_[k]);
    });
    const double length = weight / product(direction_, applied_);
    blocks.for_each_node([&](std::size_t k) {
      algebra.axpy(step_[k], step_[k], length, direction_[k]);
      algebra.axpy(rest_[k], rest_[k], -length, applied_[k]);
    });
    const double next = condition(), keep = next / weight;
    weight = next;
    blocks.for_each_node([&](std::size_t k) { algebra.axpy(direction_[k], conditioned_[k], keep, direction_[k]); });
  }
}

// Moves all nodes along the planes that act: by what all planes allow of that step, and of this the part with the least energy.
void HardCurve::correct() {
  const VectorAlgebra& algebra = nodes_->algebra();
  const NodeBlocks& blocks = nodes_->blocks();
  nodes_->prepare_faces();
  laplacian_.prepare(tensions_, stiffness);
  find_step();
  blocks.for_each_block([&](std::size_t block, std::size_t begin, std::size_t end) {
    AlignedArray& moved = applied_[begin];
    for (std::size_t k = begin; k < end; ++k) {
      algebra.difference(moved, moved_[k], now_[k]);
      algebra.axpy(step_[k], step_[k], 1.0, moved);
      if (nodes_->project(k, block, step_[k]))
        algebra.difference(step_[k], step_[k], moved);
      else
        std::fill(step_[k].begin(), step_[k].end(), 0.0);
    }
  });
  blocks.for_each_node([&](std::size_t k) {
    pull_at(k, rest_[k]);
    apply(step_, k, applied_[k]);
  });
  const double curvature = product(step_, applied_);
  if (!(curvature > 0.0)) return;
  const double share = std::clamp(product(rest_, step_) / curvature, 0.0, 1.0);
  blocks.for_each_node([&](std::size_t k) { algebra.axpy(moved_[k], moved_[k], share, step_[k]); });
}

double HardCurve::measured_residual() {
  BendNorms norms(now_.size());
  nodes_->blocks().for_each_block([&](std::size_t block, std::size_t begin, std::size_t end) {
    Bend bend(nodes_->algebra(), now_);
    AlignedArray rest;
    for (std::size_t k = begin; k < end; ++k) {
      rest = bend.at(k);
      if (nodes_->planes() != HardNodes::Planes::of_segments) pull_at(k, rest);
      const double tau = nodes_->algebra().norm(rest);
      nodes_->remove_support(k, block, rest);
      norms.set(k, tau, nodes_->algebra().norm(rest), bend.floor());
    }
  });
  return norms.residual();
}

Relaxation HardCurve::iterate() {
  set_tensions();
  for (const std::size_t colour : {0, 1, 0, 1}) sweep(colour);
  correct();
  for (const std::size_t colour : {1, 0}) sweep(colour);
  now_ = moved_;
  nodes_->follow(now_);
  residual_ = measured_residual();
  const double limit = nodes_->planes() == HardNodes::Planes::of_segments ? 1.0 : sliding_limit;
  if (residual_ < limit * stationary_residual) return Relaxation::stationary;
  const bool tight = nodes_->planes() != HardNodes::Planes::of_nodes;
  return tight && ++tight_iterations_ >= most_tight_iterations ? Relaxation::stopped : Relaxation::continues;
}

void HardCurve::exchange(Archive& archive) {
  std::uint64_t count = now_.size();
  archive.field("node_count", count);
  if (archive.reading()) allocate(Polyline(count, AlignedArray(layout_.dimension(), 0.0)));
  exchange_nodes(archive, "nodes", now_);
  archive.field("residual", residual_);
  archive.field("tight_iterations", tight_iterations_);
  archive.field("earlier_evaluations", earlier_evaluations_);
  nodes_->exchange(archive);
  if (archive.reading()) follow();
}

}  // namespace lanescape
