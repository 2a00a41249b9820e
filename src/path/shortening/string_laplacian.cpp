#include "path/shortening/string_laplacian.hpp"

#include <algorithm>

namespace lanescape {
namespace {

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

void StringLaplacian::solve(Polyline& field, const NodeBlocks& blocks) const {
  std::fill(field.front().begin(), field.front().end(), 0.0);
  std::fill(field.back().begin(), field.back().end(), 0.0);
  // Each coordinate is a system of its own. Threads share them in whole cache lines.
  constexpr std::size_t line = 8;
  const std::size_t lines = (field.front().size() + line - 1) / line;
  const int parts = static_cast<int>(std::min(static_cast<std::size_t>(blocks.threads()), lines));
  for_each_part(parts, [&](int part) {
    solve_columns(field, tensions_, pivot_, line * part_begin(lines, part, parts),
                  std::min(field.front().size(), line * part_begin(lines, part + 1, parts)));
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
