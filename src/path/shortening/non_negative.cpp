#include "path/shortening/non_negative.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>

namespace lanescape {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The columns whose multipliers are positive, and the Cholesky factor of their products, which grows by a row per column.
class PositiveSet {
 public:
  explicit PositiveSet(Eigen::Map<const MatrixXd> gram) : gram_(gram), factor_(MatrixXd::Zero(gram.rows(), gram.rows())) {}

  const std::vector<Index>& columns() const { return columns_; }

  // False, and nothing is added, where the column depends on those in the set.
  bool add(Index column) {
    const Index n = size();
    VectorXd row(n);
    for (Index k = 0; k < n; ++k) row[k] = gram_(columns_[static_cast<std::size_t>(k)], column);
    factor_.topLeftCorner(n, n).triangularView<Eigen::Lower>().solveInPlace(row);
    const double pivot = gram_(column, column) - row.squaredNorm();
    if (!(pivot > 1e-12 * gram_(column, column))) return false;
    factor_.row(n).head(n) = row.transpose();
    factor_(n, n) = std::sqrt(pivot);
    columns_.push_back(column);
    return true;
  }

  // Keeps the columns whose x is positive. Rows of the factor before the first that goes stay as they are.
  void keep_positive(VectorXd& x) {
    std::vector<Index> later;
    std::size_t first = 0;
    while (first < columns_.size() && x[columns_[first]] > 0.0) ++first;
    for (std::size_t k = first; k < columns_.size(); ++k) {
      double& value = x[columns_[k]];
      if (value > 0.0)
        later.push_back(columns_[k]);
      else
        value = 0.0;
    }
    columns_.resize(first);
    for (const Index column : later)
      if (!add(column)) x[column] = 0.0;
  }

  // The multipliers of the set that minimise without regard to their signs.
  VectorXd minimum(const VectorXd& projections) const {
    VectorXd z(size());
    for (Index k = 0; k < size(); ++k) z[k] = projections[columns_[static_cast<std::size_t>(k)]];
    const auto factor = factor_.topLeftCorner(size(), size());
    factor.triangularView<Eigen::Lower>().solveInPlace(z);
    factor.transpose().triangularView<Eigen::Upper>().solveInPlace(z);
    return z;
  }

 private:
  Index size() const { return static_cast<Index>(columns_.size()); }

  Eigen::Map<const MatrixXd> gram_;
  MatrixXd factor_;
  std::vector<Index> columns_;
};

// Moves x towards the minimum of the set until the first multiplier reaches 0, drops that, and repeats until all are positive.
void minimise(PositiveSet& set, const VectorXd& projections, VectorXd& x) {
  for (;;) {
    const VectorXd z = set.minimum(projections);
    double step = 1.0;
    Index blocking = -1;
    for (Index k = 0; k < z.size(); ++k) {
      const Index column = set.columns()[static_cast<std::size_t>(k)];
      if (z[k] > 0.0 || x[column] / (x[column] - z[k]) > step) continue;
      step = x[column] > 0.0 ? x[column] / (x[column] - z[k]) : 0.0;
      blocking = column;
    }
    for (Index k = 0; k < z.size(); ++k) {
      double& value = x[set.columns()[static_cast<std::size_t>(k)]];
      value += step * (z[k] - value);
    }
    if (blocking < 0) return;
    x[blocking] = 0.0;
    set.keep_positive(x);
  }
}

}  // namespace

std::vector<double> non_negative_least_squares(std::span<const double> gram, std::span<const double> projections) {
  const auto n = static_cast<Index>(projections.size());
  const Eigen::Map<const MatrixXd> products(gram.data(), n, n);
  const VectorXd rhs = Eigen::Map<const VectorXd>(projections.data(), n);
  std::vector<bool> refused(projections.size(), false);  // dependent columns, and those that rounding alone makes look useful
  VectorXd x = VectorXd::Zero(n);
  PositiveSet set(products);
  const double rounding = 1e-13 * (n > 0 ? rhs.cwiseAbs().maxCoeff() : 0.0);
  for (Index rounds = 0; rounds < 10 * n; ++rounds) {
    const VectorXd slope = rhs - products * x;
    Index best = -1;
    for (Index c = 0; c < n; ++c)
      if (x[c] == 0.0 && !refused[static_cast<std::size_t>(c)] && slope[c] > (best < 0 ? rounding : slope[best])) best = c;
    if (best < 0) break;
    if (!set.add(best)) {
      refused[static_cast<std::size_t>(best)] = true;
      continue;
    }
    minimise(set, rhs, x);
    if (x[best] == 0.0)
      refused[static_cast<std::size_t>(best)] = true;
    else
      refused.assign(refused.size(), false);
  }
  return {x.data(), x.data() + n};
}

}  // namespace lanescape
