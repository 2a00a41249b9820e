#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "path/polyline.hpp"

namespace lanescape {

// The bend of a path at its inner nodes: tau_k = t_{k+1} - t_k, the difference of the unit vectors along the segments behind and
// before node k.
class Bend {
 public:
  Bend(const VectorAlgebra& algebra, const Polyline& nodes)
      : algebra_(&algebra), nodes_(&nodes), zero_(nodes.front().size(), 0.0), before_(zero_), behind_(zero_), tau_(zero_) {}

  const AlignedArray& at(std::size_t k) {
    const Polyline& nodes = *nodes_;
    algebra_->difference(before_, nodes[k], nodes[k - 1]);
    algebra_->difference(behind_, nodes[k + 1], nodes[k]);
    const double before = algebra_->norm(before_), behind = algebra_->norm(behind_);
    algebra_->combine(tau_, zero_, 1.0 / behind, behind_, -1.0 / before, before_);
    // Rounding of coordinates turns a chord by eps |R|/h. A turn by sqrt(8 eps) changes the length by less than its last bit: the
    // shortest path in double precision is not known better.
    constexpr double eps = std::numeric_limits<double>::epsilon();
    floor_ = std::max(std::sqrt(8.0 * eps), 8.0 * eps * algebra_->norm(nodes[k]) / std::min(before, behind));
    return tau_;
  }
  // Below this |tau_k| of the last node is rounding.
  double floor() const { return floor_; }

 private:
  const VectorAlgebra* algebra_;
  const Polyline* nodes_;
  AlignedArray zero_, before_, behind_, tau_;
  double floor_ = 0.0;
};

// |tau_k| and |tau_k - lambda_k n_k| of each node, less what rounding accounts for.
struct BendNorms {
  explicit BendNorms(std::size_t nodes) : bend(nodes, 0.0), unexplained(nodes, 0.0) {}

  void set(std::size_t k, double tau, double rest, double floor) {
    bend[k] = std::max(0.0, tau - floor);
    unexplained[k] = std::max(0.0, rest - floor);
  }
  double residual() const {
    const double largest = *std::max_element(bend.begin(), bend.end());
    return largest > 0.0 ? *std::max_element(unexplained.begin(), unexplained.end()) / largest : 0.0;
  }

  std::vector<double> bend, unexplained;
};

}  // namespace lanescape
