#pragma once

#include <cstddef>
#include <vector>

#include "path/polyline.hpp"
#include "path/shortening/boundary_matrix.hpp"
#include "path/shortening/node_blocks.hpp"
#include "path/shortening/string_laplacian.hpp"

namespace lanescape {

// The step that shortens a string most, to first order of its constraints: with the pull p, the unit normals n and the room c of
// the nodes, x minimises x.(L + shift)x/2 - p.x subject to n_k.x_k <= c_k. The constraints have multipliers mu_k >= 0, which solve
// a linear complementarity problem with the matrix n_j.[(L + shift)^-1]_jk n_k: block principal pivoting (Judice and Pires 1994,
// doi 10.1016/0305-0548(94)90106-6) finds the nodes on the boundary, and conjugate gradients their multipliers.
class BoundaryProblem {
 public:
  BoundaryProblem(const VectorAlgebra& algebra, const NodeBlocks& blocks, std::size_t nodes, std::size_t dimension);

  // Overwrites `step`. Starts from the multipliers found last, and leaves the new ones. `tolerance` is how far a step may come
  // beyond c_k. Normals have unit length, or are zero where there is no constraint.
  void solve(const Polyline& pull, const Polyline& normals, const std::vector<double>& room, double shift, double tolerance,
             Polyline& step);
  // Overwrites `out` by the part of (L + shift)^-1 field that keeps n_k.out_k = 0 at the nodes on the boundary: the preconditioner
  // of steps along it. Uses shift and nodes of the last solve().
  void project(const Polyline& field, const Polyline& normals, Polyline& out);

  const std::vector<double>& multipliers() const { return multipliers_; }
  bool on_boundary(std::size_t k) const { return active_[k] != 0; }
  void set_multipliers(std::vector<double> multipliers) { multipliers_ = std::move(multipliers); }

 private:
  void solve_multipliers(const Polyline& normals, const std::vector<double>& target, double accuracy);
  void multiply(const Polyline& normals, const std::vector<double>& weights, std::vector<double>& out);
  void precondition(const std::vector<double>& in, std::vector<double>& out) const;
  void spread(const Polyline& normals, const std::vector<double>& weights, const StringLaplacian::NodeAction& use);
  void prepare_neighbours(const Polyline& normals);
  std::vector<std::size_t> infeasible(const Polyline& normals, const std::vector<double>& room, double tolerance,
                                      const Polyline& step) const;

  const VectorAlgebra* algebra_;
  const NodeBlocks* blocks_;
  StringLaplacian laplacian_;
  BoundaryMatrix matrix_;
  std::size_t nodes_;
  std::vector<char> active_;
  std::vector<double> multipliers_;
  std::vector<double> neighbour_;  // n_k.n_{k+1}
  std::vector<double> residual_, conditioned_, direction_, product_;
  Polyline field_, free_;
};

}  // namespace lanescape
