#include "path/shortening/boundary_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {
namespace {

constexpr double negligible_element = 1e-13;  // of an element, by those on the diagonal
// Multiplied on one thread, in some microseconds, where they are fewer.
constexpr std::size_t fewest_shared_elements = 30'000;

}  // namespace

double ordered_product(const double* a, const double* b, std::size_t n) {
  constexpr std::size_t partial_sums = 8;
  double sums[partial_sums] = {};
  std::size_t i = 0;
  for (; i + partial_sums <= n; i += partial_sums)
    for (std::size_t s = 0; s < partial_sums; ++s) sums[s] += a[i + s] * b[i + s];
  for (; i < n; ++i) sums[0] += a[i] * b[i];
  double total = 0.0;
  for (const double sum : sums) total += sum;
  return total;
}

void BoundaryMatrix::prepare(const StringLaplacian& laplacian, std::size_t nodes) {
  nodes_ = nodes;
  couplings_ = laplacian.couplings();
  diagonal_ = laplacian.inverse_diagonal();
  const double strongest = *std::max_element(couplings_.begin(), couplings_.end());
  const double reach = strongest > 0.0 ? std::ceil(std::log(negligible_element) / std::log(strongest)) : 1.0;
  reach_ = static_cast<std::size_t>(std::clamp(reach, 1.0, static_cast<double>(nodes)));
  width_ = 2 * reach_ + 1;
  included_.assign(nodes, 0);
}

void BoundaryMatrix::include(const VectorAlgebra& algebra, const Polyline& normals, const std::vector<char>& nodes,
                             const NodeBlocks& blocks) {
  if (std::find(included_.begin(), included_.end(), 1) == included_.end()) band_.assign(nodes_ * width_, 0.0);
  new_.assign(nodes_, 0);
  bool is_known = true;
  for (std::size_t k = 1; k + 1 < nodes_; ++k) {
    new_[k] = nodes[k] && !included_[k];
    included_[k] = included_[k] || nodes[k];
    is_known = is_known && !new_[k];
  }
  if (is_known) return;
  blocks.for_each_node([&](std::size_t j) { compute_row(algebra, normals, j); });
  blocks.for_each_node([&](std::size_t j) { mirror_row(j); });
}

// From the diagonal on. An element of the inverse is the one on the diagonal below it times the couplings between.
void BoundaryMatrix::compute_row(const VectorAlgebra& algebra, const Polyline& normals, std::size_t j) {
  if (!included_[j]) return;
  double coupling = 1.0;
  const std::size_t end = std::min(nodes_ - 1, j + reach_ + 1);
  for (std::size_t k = j; k < end; ++k) {
    if (included_[k] && (new_[j] || new_[k])) at(j, k) = coupling * diagonal_[k] * algebra.dot(normals[j], normals[k]);
    coupling *= couplings_[k];
  }
}

void BoundaryMatrix::mirror_row(std::size_t j) {
  if (!included_[j]) return;
  for (std::size_t k = j - std::min(j - 1, reach_); k < j; ++k) at(j, k) = at(k, j);
}

double BoundaryMatrix::row_times(const std::vector<double>& in, std::size_t j) const {
  const std::size_t begin = j - std::min(j, reach_), end = std::min(nodes_, j + reach_ + 1);
  return ordered_product(&band_[j * width_ + reach_ + begin - j], &in[begin], end - begin);
}

void BoundaryMatrix::multiply(const std::vector<double>& in, const std::vector<char>& wanted, std::vector<double>& out,
                              const NodeBlocks& blocks) const {
  out.front() = out.back() = 0.0;
  const auto row = [&](std::size_t j) { out[j] = wanted[j] ? row_times(in, j) : 0.0; };
  if (nodes_ * width_ >= fewest_shared_elements) return blocks.for_each_node(row);
  for (std::size_t j = 1; j + 1 < nodes_; ++j) row(j);
}

}  // namespace lanescape
