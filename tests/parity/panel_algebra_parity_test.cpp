#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "dispatch/isa.hpp"
#include "every_isa.hpp"
#include "verification/kernel_checks.hpp"
#include "views/panel.hpp"
#include "wrong_kernels.hpp"

namespace lanescape {
namespace {

using kernels::KernelTable;
using kernels::panel_offset;

using PanelAlgebraParity = testing::EveryIsa;

INSTANTIATE_TEST_SUITE_P(EveryIsa, PanelAlgebraParity, testing::all_isas(), testing::isa_name);

TEST_P(PanelAlgebraParity, AgreesWithPlainSumsForEveryNumberOfRows) {
  for (const Deviation& deviation : verify_panel_algebra(kernel_table(GetParam()))) {
    EXPECT_TRUE(deviation.passed()) << describe(deviation);
    EXPECT_EQ(deviation.isa, to_string(GetParam()));
  }
}

// The checks must be able to fail: each kernel is replaced by one that is slightly wrong in one place.
const KernelTable* right = nullptr;  // source of the correct kernels; global, because a kernel is a plain function

constexpr double slightly = 1.0 + 1e-12;

bool cholesky_that_accepts_all(double* matrix, std::size_t rows) noexcept {
  right->panel_cholesky(matrix, rows);
  return true;
}
// A factor that is only slightly wrong still is one, which the other checks use.
bool wrong_cholesky(double* matrix, std::size_t rows) noexcept {
  const bool positive = right->panel_cholesky(matrix, rows);
  matrix[panel_offset(rows, rows - 1, rows - 1)] *= slightly;
  return positive;
}
bool cholesky_that_refuses_many_rows(double* matrix, std::size_t rows) noexcept {
  return right->panel_cholesky(matrix, rows) && rows < 200;
}
void gram_without_last_row(double* c, const double* w, std::size_t rows, std::size_t panel) noexcept {
  right->panel_subtract_gram(c, w, rows, panel);
  const std::size_t column = kernels::panel_width * panel;
  c[panel_offset(rows, 0, column)] += w[panel_offset(rows, rows - 1, 0)] * w[panel_offset(rows, rows - 1, column)];
}
void wrong_solve(const double* factor, double* panel, std::size_t rows) noexcept {
  right->panel_solve_transposed(factor, panel, rows);
  panel[(rows - 1) * kernels::panel_width] *= slightly;
}
void wrong_forward(const double* factor, double* x, std::size_t rows) noexcept {
  right->panel_forward(factor, x, rows);
  x[rows - 1] *= slightly;
}
void wrong_backward(const double* factor, double* x, std::size_t rows) noexcept {
  right->panel_backward(factor, x, rows);
  x[0] *= slightly;
}
TEST(PanelAlgebraChecks, FailForTheKernelThatIsWrongAndForNoOther) {
  right = &kernel_table(available_isas().back());
  const auto failed_with = [](auto KernelTable::*kernel, auto replacement) {
    return testing::failed_of(verify_panel_algebra(testing::with_kernel(*right, kernel, +replacement)));
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(testing::failed_of(verify_panel_algebra(*right)), Names{});
  EXPECT_EQ(failed_with(&KernelTable::panel_cholesky, cholesky_that_accepts_all), Names{"panel_cholesky"});
  EXPECT_EQ(failed_with(&KernelTable::panel_cholesky, wrong_cholesky), Names{"panel_cholesky"});
  EXPECT_EQ(failed_with(&KernelTable::panel_cholesky, cholesky_that_refuses_many_rows), Names{"panel_cholesky"});
  EXPECT_EQ(failed_with(&KernelTable::panel_subtract_gram, gram_without_last_row), Names{"panel_subtract_gram"});
  EXPECT_EQ(failed_with(&KernelTable::panel_solve_transposed, wrong_solve), Names{"panel_solve_transposed"});
  EXPECT_EQ(failed_with(&KernelTable::panel_forward, wrong_forward), Names{"panel_forward"});
  EXPECT_EQ(failed_with(&KernelTable::panel_backward, wrong_backward), Names{"panel_backward"});
}

}  // namespace
}  // namespace lanescape
