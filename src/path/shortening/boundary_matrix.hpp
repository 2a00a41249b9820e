#pragma once

#include <cstddef>
#include <vector>

#include "path/polyline.hpp"
#include "path/shortening/node_blocks.hpp"
#include "path/shortening/string_laplacian.hpp"

namespace lanescape {

// The scalar product, in partial sums that do not wait for each other.
double ordered_product(const double* a, const double* b, std::size_t n);

// The matrix n_j.[(L + shift)^-1]_jk n_k of unit normals n, which many products share. Away from its diagonal it falls like
// exp(-sqrt(shift) |j - k|): what is below rounding is left out, and the rest is a band.
class BoundaryMatrix {
 public:
  // Of this inverse, and of normals that it has not seen.
  void prepare(const StringLaplacian& laplacian, std::size_t nodes);
  // The most nodes to either side of one that its row holds.
  std::size_t reach() const { return reach_; }
  // Computes what products among these nodes need, beside the nodes included before.
  void include(const VectorAlgebra& algebra, const Polyline& normals, const std::vector<char>& nodes, const NodeBlocks& blocks);
  // out = matrix times in, at the nodes of `wanted`, and 0 elsewhere. `in` is 0 at nodes that are not included.
  void multiply(const std::vector<double>& in, const std::vector<char>& wanted, std::vector<double>& out,
                const NodeBlocks& blocks) const;

 private:
  void compute_row(const VectorAlgebra& algebra, const Polyline& normals, std::size_t j);
  void mirror_row(std::size_t j);
  double row_times(const std::vector<double>& in, std::size_t j) const;
  double& at(std::size_t j, std::size_t k) { return band_[j * width_ + reach_ + k - j]; }

  std::size_t nodes_ = 0, reach_ = 0, width_ = 0;
  std::vector<double> couplings_, diagonal_;  // of the inverse
  std::vector<char> included_, new_;
  AlignedArray band_;  // width_ elements per node, the diagonal one at reach_
};

}  // namespace lanescape
