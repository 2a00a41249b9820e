#include "path/shortening/block_tridiagonal.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "dispatch/isa.hpp"
#include "every_isa.hpp"

namespace lanescape {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A block-tridiagonal matrix as blocks and as a dense matrix, with a right side.
class Problem {
 public:
  Problem(std::size_t blocks, std::size_t dimension) : blocks_(blocks), dimension_(dimension) {
    std::mt19937 engine(static_cast<unsigned>(100 * blocks + dimension));
    std::normal_distribution<double> normal;
    const auto d = static_cast<Index>(dimension), n = static_cast<Index>(blocks) * d;
    const auto random = [&](Index columns) { return MatrixXd::NullaryExpr(d, columns, [&] { return normal(engine); }).eval(); };
    dense_ = MatrixXd::Zero(n, n);
    // The sum of squares of differences between neighbours is positive; the unit matrix makes it definite.
    for (Index k = 0; k < static_cast<Index>(blocks); ++k) {
      const MatrixXd a = random(d), b = random(d);
      dense_.block(k * d, k * d, d, d) += MatrixXd::Identity(d, d) + a.transpose() * a;
      if (k == 0) continue;
      dense_.block((k - 1) * d, (k - 1) * d, d, d) += b.transpose() * b;
      dense_.block((k - 1) * d, k * d, d, d) -= b.transpose() * a;
      dense_.block(k * d, (k - 1) * d, d, d) -= a.transpose() * b;
    }
    right_ = VectorXd::NullaryExpr(n, [&] { return normal(engine); });
  }

  MatrixXd& dense() { return dense_; }
  double& diagonal(std::size_t block, std::size_t row, std::size_t column) {
    return dense_(index(block, row), index(block, column));
  }

  // Each element in two parts, and what is below the diagonal not at all or as something that is not a number.
  BlockTridiagonal::Source source(BlockTridiagonal& matrix, bool spoil_below = false) const {
    return {[this, &matrix, spoil_below](std::size_t k) { fill_diagonal(matrix, k, spoil_below); },
            [this](std::size_t k, BlockTridiagonal::Coupling& coupling) { fill_coupling(coupling, k); }};
  }
  BlockTridiagonal matrix(Isa isa, int threads) const { return {kernel_table(isa), blocks_, dimension_, threads}; }
  bool is_factored(Isa isa, int threads) const {
    BlockTridiagonal result = matrix(isa, threads);
    return result.factor(source(result));
  }

  VectorXd solved(const BlockTridiagonal& factor) const {
    std::vector<AlignedArray> x;
    for (std::size_t k = 0; k < blocks_; ++k) {
      const double* begin = right_.data() + k * dimension_;
      x.emplace_back(begin, begin + dimension_);
    }
    factor.solve(x);
    VectorXd result(right_.size());
    for (std::size_t k = 0; k < blocks_; ++k)
      for (std::size_t row = 0; row < dimension_; ++row) result(index(k, row)) = x[k][row];
    return result;
  }
  VectorXd solved(Isa isa, int threads, bool spoil_below = false) const {
    BlockTridiagonal factor = matrix(isa, threads);
    EXPECT_TRUE(factor.factor(source(factor, spoil_below)));
    return solved(factor);
  }
  VectorXd expected() const { return dense_.ldlt().solve(right_); }

 private:
  void fill_diagonal(BlockTridiagonal& matrix, std::size_t k, bool spoil_below) const {
    for (std::size_t row = 0; row < dimension_; ++row)
      for (std::size_t column = 0; column < dimension_; ++column) {
        if (row <= column)
          for (const double part : {0.25, 0.75}) matrix.add(k, row, column, part * dense_(index(k, row), index(k, column)));
        else if (spoil_below)
          matrix.add(k, row, column, std::numeric_limits<double>::quiet_NaN());
      }
  }
  // The unit matrix, and squares for the rest, the last one in two parts.
  void fill_coupling(BlockTridiagonal::Coupling& coupling, std::size_t k) const {
    coupling.unit = 0.5;
    coupling.x = nullptr;
    coupling.terms.clear();
    for (std::size_t row = 0; row < dimension_; row += 3)
      for (std::size_t column = 0; column < dimension_; column += 3) {
        const bool halved = row + 3 == dimension_ && column + 3 == dimension_;
        BlockTridiagonal::Square square;
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = 0; b < 3; ++b) {
            const double x = dense_(index(k, row + a), index(k + 1, column + b)) - (row + a == column + b ? 0.5 : 0.0);
            square[a][b] = halved ? 0.5 * x : x;
          }
        for (int part = 0; part < (halved ? 2 : 1); ++part) coupling.terms.push_back({row, column, square});
      }
  }
  Index index(std::size_t block, std::size_t row) const { return static_cast<Index>(block * dimension_ + row); }

  std::size_t blocks_, dimension_;
  MatrixXd dense_;
  VectorXd right_;
};

double distance(const VectorXd& a, const VectorXd& b) { return (a - b).norm() / b.norm(); }

// Fewer than a vector, whole tiles and panels, parts of them.
const std::pair<std::size_t, std::size_t> shapes[] = {{1, 3},  {1, 30}, {2, 6},  {3, 24}, {5, 6},   {8, 6},
                                                      {8, 42}, {5, 54}, {3, 72}, {2, 51}, {1, 267}, {3, 150}};

class BlockTridiagonalOnEveryIsa : public testing::EveryIsa {};
INSTANTIATE_TEST_SUITE_P(Isas, BlockTridiagonalOnEveryIsa, testing::all_isas(), testing::isa_name);

TEST_P(BlockTridiagonalOnEveryIsa, SolvesWhatADenseFactorSolves) {
  for (const auto& [blocks, dimension] : shapes) {
    const Problem problem(blocks, dimension);
    EXPECT_LT(distance(problem.solved(GetParam(), 1), problem.expected()), 1e-11) << blocks << " blocks of " << dimension;
  }
}

TEST_P(BlockTridiagonalOnEveryIsa, HasTheSameBitsOnAnyNumberOfThreads) {
  for (const auto& [blocks, dimension] : shapes) {
    const Problem problem(blocks, dimension);
    const VectorXd one = problem.solved(GetParam(), 1);
    for (const int threads : {2, 3}) EXPECT_EQ(problem.solved(GetParam(), threads), one) << blocks << " blocks of " << dimension;
  }
}

TEST_P(BlockTridiagonalOnEveryIsa, IgnoresWhatIsBelowTheDiagonal) {
  for (const auto& [blocks, dimension] : shapes) {
    const Problem problem(blocks, dimension);
    EXPECT_EQ(problem.solved(GetParam(), 1, true), problem.solved(GetParam(), 1)) << blocks << " blocks of " << dimension;
  }
}

TEST_P(BlockTridiagonalOnEveryIsa, AddsProductsOfAVectorWithItself) {
  for (const auto& [blocks, dimension] : shapes)
    for (const std::size_t coupled : {std::size_t{0}, blocks < 2 ? 0 : blocks - 2}) {  // of either side
      Problem problem(blocks, dimension);
      BlockTridiagonal factor = problem.matrix(GetParam(), 1);
      const auto d = static_cast<Index>(dimension), first = static_cast<Index>(coupled) * d;
      const VectorXd x = VectorXd::LinSpaced(d, -1.0, 1.5);
      const double little = -0.1 / x.squaredNorm();
      const BlockTridiagonal::Source rest = problem.source(factor);
      ASSERT_TRUE(factor.factor({[&](std::size_t k) {
                                   rest.diagonal(k);
                                   if (k == coupled) factor.add_product(k, 0.3, x.data());
                                 },
                                 [&](std::size_t k, BlockTridiagonal::Coupling& coupling) {
                                   rest.coupling(k, coupling);
                                   if (k != coupled) return;
                                   coupling.factor = little;
                                   coupling.x = x.data();
                                 }}));
      const VectorXd solution = problem.solved(factor);
      problem.dense().block(first, first, d, d) += 0.3 * x * x.transpose();
      if (coupled + 1 < blocks) {
        problem.dense().block(first, first + d, d, d) += little * x * x.transpose();
        problem.dense().block(first + d, first, d, d) += little * x * x.transpose();
      }
      EXPECT_LT(distance(solution, problem.expected()), 1e-11) << blocks << " blocks of " << dimension;
    }
}

TEST_P(BlockTridiagonalOnEveryIsa, FindsOutWhereverItIsNotPositiveDefinite) {
  for (const std::size_t block : {0u, 1u, 2u, 3u, 4u})
    for (const std::size_t row : {0u, 8u, 29u}) {
      for (const double wrong : {-1e-3, 0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Problem problem(5, 30);
        problem.diagonal(block, row, row) = wrong;
        EXPECT_FALSE(problem.is_factored(GetParam(), 1)) << wrong << " in row " << row << " of block " << block;
      }
    }
}

TEST(BlockTridiagonal, IsRefusedBySeveralThreadsToo) {
  for (const std::size_t block : {0u, 2u, 4u})
    for (const int threads : {2, 3}) {
      Problem problem(5, 30);
      problem.diagonal(block, 29, 29) = -1.0;
      EXPECT_FALSE(problem.is_factored(available_isas().back(), threads)) << block << " on " << threads;
    }
}

TEST_P(BlockTridiagonalOnEveryIsa, FindsOutThatCouplingsAreTooStrong) {
  for (const std::size_t blocks : {2u, 3u, 8u}) {
    BlockTridiagonal matrix(kernel_table(GetParam()), blocks, 6, 1);
    for (const double unit : {0.49, 1.01}) {  // eigenvalues 1 - 2 x 0.49 cos, 1 - 1.01 at most
      const auto add_unit = [&](std::size_t k) {
        for (std::size_t i = 0; i < 6; ++i) matrix.add(k, i, i, 1.0);
      };
      EXPECT_EQ(matrix.factor({add_unit, [&](std::size_t, BlockTridiagonal::Coupling& coupling) { coupling.unit = unit; }}),
                unit < 0.5)
          << blocks;
    }
  }
}

TEST_P(BlockTridiagonalOnEveryIsa, BeginsAnewAfterAFailureAsIfNothingHadHappened) {
  Problem problem(5, 30);
  const VectorXd expected = problem.solved(GetParam(), 1);
  BlockTridiagonal matrix = problem.matrix(GetParam(), 1);
  const BlockTridiagonal::Source source = problem.source(matrix);
  EXPECT_FALSE(matrix.factor({[&](std::size_t k) {
                                source.diagonal(k);
                                if (k == 1) matrix.add(1, 3, 3, -1e6);
                              },
                              source.coupling}));
  EXPECT_TRUE(matrix.factor(source));
  EXPECT_EQ(problem.solved(matrix), expected);
  EXPECT_EQ(problem.solved(matrix), expected);  // solve() leaves the factor alone
}

TEST(BlockTridiagonal, IsSolvedEquallyByAllInstructionSets) {
  for (const auto& [blocks, dimension] : shapes) {
    const Problem problem(blocks, dimension);
    const VectorXd best = problem.solved(available_isas().back(), 1);
    for (const Isa isa : available_isas()) EXPECT_LT(distance(problem.solved(isa, 1), best), 1e-11) << to_string(isa);
  }
}

TEST(BlockTridiagonal, KnowsItsShape) {
  const BlockTridiagonal matrix(kernel_table(available_isas().back()), 7, 13, 1);
  EXPECT_EQ(matrix.blocks(), 7u);
  EXPECT_EQ(matrix.dimension(), 13u);
}

}  // namespace
}  // namespace lanescape
