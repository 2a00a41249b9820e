#include "path/shortening/string_laplacian.hpp"

#include <algorithm>

namespace lanescape {
namespace {

constexpr double negligible_part = 1e-25;  // part of what crosses a block of nodes

}  // namespace

void StringLaplacian::prepare(std::size_t nodes, double shift) {
  diagonal_ = 2.0 + shift;
  pivot_.assign(nodes, 0.0);
  for (std::size_t k = 1; k + 1 < nodes; ++k) pivot_[k] = 1.0 / (diagonal_ - pivot_[k - 1]);
}

std::vector<double> StringLaplacian::inverse_diagonal() const {
  std::vector<double> diagonal(pivot_.size(), 0.0);
  for (std::size_t k = pivot_.size() - 2; k >= 1; --k) diagonal[k] = pivot_[k] + pivot_[k] * pivot_[k] * diagonal[k + 1];
  return diagonal;
}

void StringLaplacian::solve(const VectorAlgebra& algebra, Polyline& field, const NodeBlocks& blocks, const NodeAction& begin,
                            const NodeAction& end) {
  field.front().assign(field.front().size(), 0.0);
  field.back() = field.front();
  for (Polyline* of_blocks : {&last_, &first_, &carry_}) of_blocks->resize(NodeBlocks::count, field.front());
  parts_.resize(field.size());
  passed_.assign(NodeBlocks::count, 1.0);
  passed_back_ = passed_;
  eliminate(algebra, field, blocks, begin);
  substitute(algebra, field, blocks);
  blocks.for_each_short_block([&](std::size_t block, std::size_t first, std::size_t last) {
    carry_[block].assign(field.front().size(), 0.0);
    double part = 1.0;
    for (std::size_t b = block + 1; b < NodeBlocks::count && part > negligible_part; part *= passed_back_[b++])
      algebra.axpy(carry_[block], carry_[block], part, first_[b]);
    for (std::size_t k = last; k-- > first;) {
      algebra.axpy(field[k], field[k], parts_[k], carry_[block]);
      end(k);
    }
  });
}

// Eliminates within each block.
void StringLaplacian::eliminate(const VectorAlgebra& algebra, Polyline& field, const NodeBlocks& blocks, const NodeAction& begin) {
  blocks.for_each_short_block([&](std::size_t block, std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      begin(k);
      parts_[k] = passed_[block] *= pivot_[k];
      const AlignedArray& before = field[k == first ? 0 : k - 1];  // the end of the path is 0
      algebra.combine(field[k], field[k], pivot_[k] - 1.0, field[k], pivot_[k], before);
    }
    last_[block] = field[last - 1];
  });
}

// Substitutes within each block, with what has come from the blocks before.
void StringLaplacian::substitute(const VectorAlgebra& algebra, Polyline& field, const NodeBlocks& blocks) {
  blocks.for_each_short_block([&](std::size_t block, std::size_t first, std::size_t last) {
    carry_[block].assign(field.front().size(), 0.0);
    double comes = 1.0, part = 1.0;
    for (std::size_t b = block; b-- > 0 && comes > negligible_part; comes *= passed_[b])
      algebra.axpy(carry_[block], carry_[block], comes, last_[b]);
    for (std::size_t k = last; k-- > first;) {
      const AlignedArray& behind = field[k + 1 == last ? 0 : k + 1];
      algebra.combine(field[k], field[k], parts_[k], carry_[block], pivot_[k], behind);
      parts_[k] = part *= pivot_[k];
    }
    first_[block] = field[first];
    passed_back_[block] = part;
  });
}

void string_pull(const VectorAlgebra& algebra, const Polyline& nodes, Polyline& pull, const NodeBlocks& blocks) {
  blocks.for_each_node([&](std::size_t k) {
    algebra.difference(pull[k], nodes[k + 1], nodes[k]);
    algebra.combine(pull[k], pull[k], -1.0, nodes[k], 1.0, nodes[k - 1]);
  });
}

void apply_string(const VectorAlgebra& algebra, const Polyline& field, std::size_t k, AlignedArray& out) {
  algebra.difference(out, field[k], field[k - 1]);
  algebra.combine(out, out, 1.0, field[k], -1.0, field[k + 1]);
}

}  // namespace lanescape
