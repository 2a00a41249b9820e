#pragma once

#include <cstddef>
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
  // The same with a tension for each segment, by which its square counts.
  void prepare(const std::vector<double>& tensions, double shift);

  double diagonal() const { return diagonal_; }
  // Overwrites the inner nodes of `field` by the solution of (L + shift) x = field. Both ends stay 0. O(nodes x coordinates).
  void solve(Polyline& field, const NodeBlocks& blocks) const;

 private:
  double diagonal_ = 2.0;
  std::vector<double> tensions_;  // by segment
  std::vector<double> pivot_;     // one over the pivots of the elimination, by node
};

// R_{k-1} - 2 R_k + R_{k+1} of each inner node, the pull of the string: of a geodesic it is normal to the boundary.
void string_pull(const VectorAlgebra& algebra, const Polyline& nodes, Polyline& pull, const NodeBlocks& blocks);
// L times a field that is 0 at both ends, at node k.
void apply_string(const VectorAlgebra& algebra, const Polyline& field, std::size_t k, AlignedArray& out);

}  // namespace lanescape
