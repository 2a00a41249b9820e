#include "path/shortening/boundary_problem.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {
namespace {

constexpr std::size_t most_pivots = 100, most_multiplier_steps = 200;
// Nodes that a row of the matrix reaches to either side, per coordinate: a wider band costs more than solves of the string.
constexpr std::size_t widest_band = 2;

double product_sum(const std::vector<double>& a, const std::vector<double>& b) {
  return ordered_product(a.data(), b.data(), a.size());
}

}  // namespace

BoundaryProblem::BoundaryProblem(const VectorAlgebra& algebra, const NodeBlocks& blocks, std::size_t nodes, std::size_t dimension)
    : algebra_(&algebra),
      blocks_(&blocks),
      nodes_(nodes),
      active_(nodes, 0),
      multipliers_(nodes, 0.0),
      neighbour_(nodes, 0.0),
      residual_(nodes, 0.0),
      conditioned_(residual_),
      direction_(residual_),
      product_(residual_),
      field_(nodes, AlignedArray(dimension, 0.0)),
      free_(field_) {}

// field_ = (L + shift)^-1 of the normals of nodes on the boundary, by weight. Calls use(k) when that of node k is there.
void BoundaryProblem::spread(const Polyline& normals, const std::vector<double>& weights, const StringLaplacian::NodeAction& use) {
  const auto weighted_normal = [&](std::size_t k) {
    const double weight = active_[k] ? weights[k] : 0.0;
    algebra_->axpy(field_[k], field_.front(), weight, normals[k]);
  };
  laplacian_.solve(*algebra_, field_, *blocks_, weighted_normal, use);
}

void BoundaryProblem::multiply(const Polyline& normals, const std::vector<double>& weights, std::vector<double>& out) {
  if (matrix_.reach() <= widest_band * normals.front().size()) return matrix_.multiply(weights, active_, out, *blocks_);
  spread(normals, weights, [&](std::size_t k) { out[k] = active_[k] ? algebra_->dot(field_[k], normals[k]) : 0.0; });
}

// By n_j.(L + shift)_jk n_k, whose inverse is close to the matrix of multiply() where normals turn slowly along the path.
void BoundaryProblem::precondition(const std::vector<double>& in, std::vector<double>& out) const {
  for (std::size_t k = 1; k + 1 < nodes_; ++k) {
    out[k] = 0.0;
    if (!active_[k]) continue;
    out[k] = laplacian_.diagonal() * in[k];
    if (active_[k - 1]) out[k] -= neighbour_[k - 1] * in[k - 1];
    if (active_[k + 1]) out[k] -= neighbour_[k] * in[k + 1];
  }
}

void BoundaryProblem::prepare_neighbours(const Polyline& normals) {
  blocks_->for_each_node([&](std::size_t k) { neighbour_[k] = algebra_->dot(normals[k], normals[k + 1]); });
}

// Conjugate gradients from the multipliers that are there, to `accuracy` relative to the target.
void BoundaryProblem::solve_multipliers(const Polyline& normals, const std::vector<double>& target, double accuracy) {
  for (std::size_t k = 0; k < nodes_; ++k)
    if (!active_[k]) multipliers_[k] = 0.0;
  if (matrix_.reach() <= widest_band * normals.front().size()) matrix_.include(*algebra_, normals, active_, *blocks_);
  if (std::all_of(multipliers_.begin(), multipliers_.end(), [](double multiplier) { return multiplier == 0.0; }))
    product_.assign(nodes_, 0.0);
  else
    multiply(normals, multipliers_, product_);
  double wanted = 0.0, left = 0.0;
  for (std::size_t k = 1; k + 1 < nodes_; ++k) {
    residual_[k] = active_[k] ? target[k] - product_[k] : 0.0;
    if (active_[k]) wanted += target[k] * target[k];
    left += residual_[k] * residual_[k];
  }
  precondition(residual_, conditioned_);
  direction_ = conditioned_;
  double weight = product_sum(residual_, conditioned_);
  for (std::size_t steps = 0; steps < most_multiplier_steps && left > accuracy * accuracy * wanted; ++steps) {
    multiply(normals, direction_, product_);
    const double curvature = product_sum(direction_, product_);
    if (!(curvature > 0.0)) break;
    const double step = weight / curvature;
    for (std::size_t k = 1; k + 1 < nodes_; ++k) {
      multipliers_[k] += step * direction_[k];
      residual_[k] -= step * product_[k];
    }
    left = product_sum(residual_, residual_);
    precondition(residual_, conditioned_);
    const double next = product_sum(residual_, conditioned_), keep = next / weight;
    weight = next;
    for (std::size_t k = 1; k + 1 < nodes_; ++k) direction_[k] = conditioned_[k] + keep * direction_[k];
  }
}

// Nodes on the boundary whose multiplier has the wrong sign, and others that would leave the allowed region.
std::vector<std::size_t> BoundaryProblem::infeasible(const Polyline& normals, const std::vector<double>& room, double tolerance,
                                                     const Polyline& step) const {
  std::vector<char> wrong(nodes_, 0);
  blocks_->for_each_node([&](std::size_t k) {
    wrong[k] = active_[k] ? multipliers_[k] < 0.0 : algebra_->dot(step[k], normals[k]) > room[k] + tolerance;
  });
  std::vector<std::size_t> found;
  for (std::size_t k = 1; k + 1 < nodes_; ++k)
    if (wrong[k]) found.push_back(k);
  return found;
}

void BoundaryProblem::solve(const Polyline& pull, const Polyline& normals, const std::vector<double>& room, double shift,
                            double tolerance, Polyline& step) {
  laplacian_.prepare(nodes_, shift);
  matrix_.prepare(laplacian_, nodes_);
  prepare_neighbours(normals);
  std::vector<double> target(nodes_, 0.0);
  const auto pull_of = [&](std::size_t k) { free_[k] = pull[k]; };
  laplacian_.solve(*algebra_, free_, *blocks_, pull_of, [&](std::size_t k) {
    target[k] = algebra_->dot(free_[k], normals[k]) - room[k];
    active_[k] = multipliers_[k] > 0.0;
  });
  std::size_t fewest = nodes_, tries = 3;
  for (std::size_t pivot = 0; pivot < most_pivots; ++pivot) {
    solve_multipliers(normals, target, 1e-6);
    spread(normals, multipliers_, [&](std::size_t k) { algebra_->axpy(step[k], free_[k], -1.0, field_[k]); });
    const std::vector<std::size_t> wrong = infeasible(normals, room, tolerance, step);
    if (wrong.empty()) break;
    // All at once while that makes them fewer, or has not for three times only; else one, which cannot go on for ever.
    const bool fewer = wrong.size() < fewest;
    if (fewer) fewest = wrong.size();
    if (fewer || tries > 0)
      for (const std::size_t k : wrong) active_[k] = !active_[k];
    else
      active_[wrong.back()] = !active_[wrong.back()];
    tries = fewer ? 3 : tries - (tries > 0 ? 1 : 0);
  }
  for (double& multiplier : multipliers_) multiplier = std::max(0.0, multiplier);
}

void BoundaryProblem::project(const Polyline& field, const Polyline& normals, Polyline& out) {
  std::vector<double> target(nodes_, 0.0), kept(nodes_, 0.0);
  laplacian_.solve(
      *algebra_, out, *blocks_, [&](std::size_t k) { out[k] = field[k]; },
      [&](std::size_t k) { target[k] = active_[k] ? algebra_->dot(out[k], normals[k]) : 0.0; });
  kept.swap(multipliers_);
  solve_multipliers(normals, target, 1e-6);
  spread(normals, multipliers_, [&](std::size_t k) {
    algebra_->axpy(out[k], out[k], -1.0, field_[k]);
    // The rest of the normal part, which the conjugate gradients leave.
    if (active_[k]) algebra_->axpy(out[k], out[k], -algebra_->dot(out[k], normals[k]), normals[k]);
  });
  kept.swap(multipliers_);
}

}  // namespace lanescape
