#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "path/polyline.hpp"
#include "path/shortening/node_blocks.hpp"

namespace lanescape {

// The tension of a string through the nodes of a path, with both ends held: half the sum of squared segments has the second
// derivative L, 2 on the diagonal and -1 beside it, the same for each coordinate.
class StringLaplacian {
 public:
  // Of L + shift, shift >= 0.
  void prepare(std::size_t nodes, double shift);

  double diagonal() const { return diagonal_; }
  // By node: the diagonal of (L + shift)^-1, and the factor by which a column of it, above the diagonal, falls from the next node
  // to this one. Both are 0 at the ends.
  std::vector<double> inverse_diagonal() const;
  const std::vector<double>& couplings() const { return pivot_; }
  // Overwrites the inner nodes of `field` by the solution of (L + shift) x = field. Both ends stay 0. O(nodes x coordinates).
  // Each block of nodes stays with one thread: it is solved as if the path ended there, and then gets what comes from its
  // neighbours. begin(k) makes the right-hand side of node k in `field`, end(k) is called when its solution is there.
  using NodeAction = std::function<void(std::size_t)>;
  void solve(const VectorAlgebra& algebra, Polyline& field, const NodeBlocks& blocks, const NodeAction& begin,
             const NodeAction& end);

 private:
  void eliminate(const VectorAlgebra& algebra, Polyline& field, const NodeBlocks& blocks, const NodeAction& begin);
  void substitute(const VectorAlgebra& algebra, Polyline& field, const NodeBlocks& blocks);

  double diagonal_ = 2.0;
  std::vector<double> pivot_;  // one over the pivots of the elimination, by node
  // Of a solve, by block of nodes: its last node once it is eliminated, its first once it is substituted, what comes from other
  // blocks, and the parts of that which cross it. Then the parts that each node takes.
  Polyline last_, first_, carry_;
  std::vector<double> passed_, passed_back_;
  std::vector<double> parts_;
};

// R_{k-1} - 2 R_k + R_{k+1} of each inner node, the pull of the string: of a geodesic it is normal to the boundary.
void string_pull(const VectorAlgebra& algebra, const Polyline& nodes, Polyline& pull, const NodeBlocks& blocks);
// L times a field that is 0 at both ends, at node k.
void apply_string(const VectorAlgebra& algebra, const Polyline& field, std::size_t k, AlignedArray& out);

}  // namespace lanescape
