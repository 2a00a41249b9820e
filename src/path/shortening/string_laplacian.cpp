#include "path/shortening/string_laplacian.hpp"

#include <algorithm>

namespace lanescape {
namespace {

constexpr double negligible_part = 1e-25;  // part of what crosses a block of nodes

// Eliminates and substitutes on coordinates [begin, end) of all nodes.
void solve_columns(Polyline& field, const std::vector<double>& tensions, const std::vector<double>& pivot, std::size_t begin,
                   std::size_t end) {
  const std::size_t last = field.size() - 2;
  for (std::size_t k = 1; k <= last; ++k) {
    double* here = field[k].data();
    const double* before = field[k - 1].data();
    for (std::size_t q = begin; q < end; ++q) here[q] = (here[q] + tensions[k - 1] * before[q]) * pivot[k];
  }
  for (std::size_t k = last - 1; k >= 1; --k) {
    double* here = field[k].data();
    const double* behind = field[k + 1].data();
    const double part = pivot[k] * tensions[k];
    for (std::size_t q = begin; q < end; ++q) here[q] += part * behind[q];
  }
}

}  // namespace

void StringLaplacian::prepare(std::size_t nodes, double shift) { prepare(std::vector<double>(nodes - 1, 1.0), shift); }

void StringLaplacian::prepare(const std::vector<double>& tensions, double shift) {
  tensions_ = tensions;
  diagonal_ = 2.0 + shift;
  pivot_.assign(tensions.size() + 1, 0.0);
  for (std::size_t k = 1; k < tensions.size(); ++k)
    pivot_[k] = 1.0 / (tensions[k - 1] + tensions[k] + shift - tensions[k - 1] * tensions[k - 1] * pivot_[k - 1]);
}

std::vector<double> StringLaplacian::couplings() const {
  std::vector<double> couplings(pivot_.size(), 0.0);
  for (std::size_t k = 1; k < tensions_.size(); ++k) couplings[k] = pivot_[k] * tensions_[k];
  return couplings;
}

std::vector<double> StringLaplacian::inverse_diagonal() const {
  const std::vector<double> coupling = couplings();
  std::vector<double> diagonal(pivot_.size(), 0.0);
  for (std::size_t k = tensions_.size() - 1; k >= 1; --k) diagonal[k] = pivot_[k] + coupling[k] * coupling[k] * diagonal[k + 1];
  return diagonal;
}

void StringLaplacian::solve(Polyline& field, const NodeBlocks& blocks) const {
  std::fill(field.front().begin(), field.front().end(), 0.0);
  std::fill(field.back().begin(), field.back().end(), 0.0);
  // Each coordinate is a system of its own. Threads share them in whole cache lines.
  constexpr std::size_t line = 8;
  const std::size_t lines = (field.front().size() + line - 1) / line;
  blocks.for_each_share(lines, [&](std::size_t begin, std::size_t end) {
    solve_columns(field, tensions_, pivot_, line * begin, std::min(field.front().size(), line * end));
  });
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
      const double coupling = pivot_[k] * tensions_[k - 1];
      parts_[k] = passed_[block] *= coupling;
      const AlignedArray& before = field[k == first ? 0 : k - 1];  // the end of the path is 0
      algebra.combine(field[k], field[k], pivot_[k] - 1.0, field[k], coupling, before);
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
      const double coupling = pivot_[k] * tensions_[k];
      const AlignedArray& behind = field[k + 1 == last ? 0 : k + 1];
      algebra.combine(field[k], field[k], parts_[k], carry_[block], coupling, behind);
      parts_[k] = part *= coupling;
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
