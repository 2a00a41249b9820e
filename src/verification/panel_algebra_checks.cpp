#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/aligned_array.hpp"
#include "core/random.hpp"
#include "verification/check.hpp"
#include "views/panel.hpp"

namespace lanescape {
namespace {

using kernels::panel_count;
using kernels::panel_width;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(), broken = std::numeric_limits<double>::infinity();

// Numbers of either sign with fractions that fill the mantissa.
class Numbers {
 public:
  explicit Numbers(std::uint64_t which) : which_(which) {}
  double next() { return 2.0 * random_.uniform(which_, count_++) - 1.0; }

 private:
  CounterRandom random_{2, RandomStream::displacements};
  std::uint64_t which_;
  std::uint32_t count_ = 0;
};

struct PanelMatrix {
  std::size_t rows;
  AlignedArray elements = AlignedArray(panel_count(rows) * panel_width * rows, 0.0);

  double& at(std::size_t row, std::size_t column) { return elements[kernels::panel_offset(rows, row, column)]; }
  double at(std::size_t row, std::size_t column) const { return elements[kernels::panel_offset(rows, row, column)]; }
  // Of a factor, whose diagonal holds the reciprocals.
  long double upper(std::size_t row, std::size_t column) const {
    return row == column ? 1.0L / at(row, row) : static_cast<long double>(at(row, column));
  }
};

PanelMatrix random_matrix(std::size_t rows, std::uint64_t which) {
  PanelMatrix matrix{rows};
  Numbers numbers(which);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < rows; ++j) matrix.at(i, j) = numbers.next();
  return matrix;
}

// Positive definite by its diagonal; what must not be used is not a number.
PanelMatrix random_symmetric(std::size_t rows, std::uint64_t which) {
  PanelMatrix matrix = random_matrix(rows, which);
  for (std::size_t i = 0; i < rows; ++i) {
    matrix.at(i, i) = 2.0 * std::sqrt(static_cast<double>(rows)) + 2.0;
    for (std::size_t j = 0; j < i; ++j) matrix.at(i, j) = not_a_number;
  }
  return matrix;
}

AlignedArray random_vector(std::size_t rows, std::uint64_t which) {
  AlignedArray vector(panel_count(rows) * panel_width, 0.0);
  Numbers numbers(which);
  for (std::size_t i = 0; i < rows; ++i) vector[i] = numbers.next();
  return vector;
}

// By how much sums of products miss what they should be, relative to the absolute terms.
double relative_to_terms(const TermSum& left) { return relative(left.value, 0.0L, left.magnitude); }

struct PanelAlgebraChecks {
  explicit PanelAlgebraChecks(const kernels::KernelTable& kernels) : table(kernels) {}

  const kernels::KernelTable& table;
  Check cholesky{table, "panel_cholesky", tolerance::vector_sum}, gram{table, "panel_subtract_gram", tolerance::vector_sum},
      solve{table, "panel_solve_transposed", tolerance::vector_sum}, forward{table, "panel_forward", tolerance::vector_sum},
      backward{table, "panel_backward", tolerance::vector_sum};

  // U^T U is the matrix; and one that is not positive definite in its last row is refused.
  void add_cholesky(const std::string& name, const PanelMatrix& matrix) {
    PanelMatrix factor = matrix;
    double worst = table.panel_cholesky(factor.elements.data(), matrix.rows) ? 0.0 : broken;
    for (std::size_t i = 0; i < matrix.rows; ++i)
      for (std::size_t j = i; j < matrix.rows; ++j) {
        TermSum left;
        left.add(-matrix.at(i, j));
        for (std::size_t k = 0; k <= i; ++k) left.add(factor.upper(k, i) * factor.upper(k, j));
        worst = std::max(worst, relative_to_terms(left));
      }
    PanelMatrix indefinite = matrix;
    indefinite.at(matrix.rows - 1, matrix.rows - 1) = -1.0;
    if (table.panel_cholesky(indefinite.elements.data(), matrix.rows)) worst = broken;
    cholesky.add(name, worst);
  }

  void add_gram(const std::string& name, const PanelMatrix& before, const PanelMatrix& w) {
    PanelMatrix after = before;
    for (std::size_t panel = 0; panel < panel_count(w.rows); ++panel)
      table.panel_subtract_gram(after.elements.data(), w.elements.data(), w.rows, panel);
    double worst = 0.0;
    for (std::size_t i = 0; i < w.rows; ++i)
      for (std::size_t j = i; j < w.rows; ++j) {
        TermSum left;
        left.add(before.at(i, j));
        left.add(-after.at(i, j));
        for (std::size_t k = 0; k < w.rows; ++k) left.add(-static_cast<long double>(w.at(k, i)) * w.at(k, j));
        worst = std::max(worst, relative_to_terms(left));
      }
    gram.add(name, worst);
  }

  void add_solve(const std::string& name, const PanelMatrix& factor, const PanelMatrix& right) {
    PanelMatrix x = right;
    for (std::size_t panel = 0; panel < panel_count(x.rows); ++panel)
      table.panel_solve_transposed(factor.elements.data(), x.elements.data() + panel * panel_width * x.rows, x.rows);
    double worst = 0.0;
    for (std::size_t i = 0; i < x.rows; ++i)
      for (std::size_t j = 0; j < panel_count(x.rows) * panel_width; ++j) {
        TermSum left;
        left.add(-right.at(i, j));
        for (std::size_t k = 0; k <= i; ++k) left.add(factor.upper(k, i) * x.at(k, j));
        worst = std::max(worst, relative_to_terms(left));
      }
    solve.add(name, worst);
  }

  void add_substitutions(const std::string& name, const PanelMatrix& factor, const AlignedArray& right) {
    AlignedArray x = right, y = right;
    table.panel_forward(factor.elements.data(), x.data(), factor.rows);
    table.panel_backward(factor.elements.data(), y.data(), factor.rows);
    double worst_forward = 0.0, worst_backward = 0.0;
    for (std::size_t i = 0; i < factor.rows; ++i) {
      TermSum of_forward, of_backward;
      of_forward.add(-right[i]);
      of_backward.add(-right[i]);
      for (std::size_t k = 0; k <= i; ++k) of_forward.add(factor.upper(k, i) * x[k]);
      for (std::size_t k = i; k < factor.rows; ++k) of_backward.add(factor.upper(i, k) * y[k]);
      worst_forward = std::max(worst_forward, relative_to_terms(of_forward));
      worst_backward = std::max(worst_backward, relative_to_terms(of_backward));
    }
    forward.add(name, worst_forward);
    backward.add(name, worst_backward);
  }
};

}  // namespace

std::vector<Deviation> verify_panel_algebra(const kernels::KernelTable& table) {
  PanelAlgebraChecks checks(table);
  // Parts of a panel and whole ones.
  for (const std::size_t rows : {8U, 16U, 24U, 32U, 48U, 64U, 72U, 136U, 200U}) {
    const std::string name = fmt::format("{} rows", rows);
    const PanelMatrix symmetric = random_symmetric(rows, 1), w = random_matrix(rows, 2);
    PanelMatrix factor = symmetric;
    table.panel_cholesky(factor.elements.data(), rows);
    checks.add_cholesky(name, symmetric);
    checks.add_gram(name, symmetric, w);
    checks.add_solve(name, factor, w);
    checks.add_substitutions(name, factor, random_vector(rows, 3));
  }
  return {checks.cholesky.deviation, checks.gram.deviation, checks.solve.deviation, checks.forward.deviation,
          checks.backward.deviation};
}

}  // namespace lanescape
