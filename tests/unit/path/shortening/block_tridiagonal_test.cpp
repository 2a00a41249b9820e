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
  void fill(BlockTridiagonal& matrix, bool spoil_below) const {
    for (std::size_t k = 0; k < blocks_; ++k)
      for (std::size_t row = 0; row < dimension_; ++row)
        for (std::size_t column = 0; column < dimension_; ++column) {
          if (row <= column) {
            matrix.add(k, row, column, 0.25 * dense_(index(k, row), index(k, column)));
            matrix.add(k, row, column, 0.75 * dense_(index(k, row), index(k, column)));
          } else if (spoil_below) {
            matrix.add(k, row, column, std::numeric_limits<double>::quiet_NaN());
          }
          if (k + 1 < blocks_) matrix.add_coupling(k, row, column, dense_(index(k, row), index(k + 1, column)));
        }
  }
  BlockTridiagonal matrix(Isa isa, int threads, bool spoil_below = false) const {
    BlockTridiagonal result(kernel_table(isa), blocks_, dimension_, threads);
    fill(result, spoil_below);
    return result;
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
    BlockTridiagonal factor = matrix(isa, threads, spoil_below);
    EXPECT_TRUE(factor.factor());
    return solved(factor);
  }
  VectorXd expected() const { return dense_.ldlt().solve(right_); }

 private:
  Index index(std::size_t block, std::size_t row) const { return static_cast<Index>(block * dimension_ + row); }

  std::size_t blocks_, dimension_;
  MatrixXd dense_;
  VectorXd right_;
};

double distance(const VectorXd& a, const VectorXd& b) { return (a - b).norm() / b.norm(); }

// Fewer than a vector, whole tiles and panels, parts of them.
const std::pair<std::size_t, std::size_t> shapes[] = {{1, 1},  {1, 30}, {2, 7},  {3, 24}, {5, 6},   {8, 6},
                                                      {8, 41}, {5, 53}, {3, 72}, {2, 50}, {1, 267}, {3, 150}};

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

TEST_P(BlockTridiagonalOnEveryIsa, AddsSquaresOfVectorsToWholeBlocks) {
  for (const auto& [blocks, dimension] : shapes) {
    Problem problem(blocks, dimension);
    BlockTridiagonal factor = problem.matrix(GetParam(), 1);
    const auto d = static_cast<Index>(dimension), last = static_cast<Index>(blocks - 1);
    const VectorXd x = VectorXd::LinSpaced(d, -1.0, 1.5);
    factor.add_square(blocks - 1, 0.3, x.data());
    problem.dense().block(last * d, last * d, d, d) += 0.3 * x * x.transpose();
    if (blocks > 1) {
      const double little = -0.1 / x.squaredNorm();
      factor.add_coupling_square(blocks - 2, little, x.data());
      problem.dense().block((last - 1) * d, last * d, d, d) += little * x * x.transpose();
      problem.dense().block(last * d, (last - 1) * d, d, d) += little * x * x.transpose();
    }
    ASSERT_TRUE(factor.factor());
    EXPECT_LT(distance(problem.solved(factor), problem.expected()), 1e-11) << blocks << " blocks of " << dimension;
  }
}

TEST_P(BlockTridiagonalOnEveryIsa, FindsOutWhereverItIsNotPositiveDefinite) {
  for (const std::size_t block : {0u, 1u, 2u, 3u, 4u})
    for (const std::size_t row : {0u, 8u, 28u}) {
      for (const double wrong : {-1e-3, 0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Problem problem(5, 29);
        problem.diagonal(block, row, row) = wrong;
        EXPECT_FALSE(problem.matrix(GetParam(), 1).factor()) << wrong << " in row " << row << " of block " << block;
      }
    }
}

TEST(BlockTridiagonal, IsRefusedBySeveralThreadsToo) {
  for (const std::size_t block : {0u, 2u, 4u})
    for (const int threads : {2, 3}) {
      Problem problem(5, 29);
      problem.diagonal(block, 28, 28) = -1.0;
      EXPECT_FALSE(problem.matrix(available_isas().back(), threads).factor()) << block << " on " << threads;
    }
}

TEST_P(BlockTridiagonalOnEveryIsa, FindsOutThatCouplingsAreTooStrong) {
  for (const std::size_t blocks : {2u, 3u, 8u}) {
    BlockTridiagonal matrix(kernel_table(GetParam()), blocks, 6, 1);
    for (const double coupling : {0.49, 1.01}) {  // eigenvalues 1 - 2 x 0.49 cos, 1 - 1.01 at most
      matrix.set_zero();
      for (std::size_t k = 0; k < blocks; ++k)
        for (std::size_t i = 0; i < 6; ++i) {
          matrix.add(k, i, i, 1.0);
          if (k + 1 < blocks) matrix.add_coupling(k, i, i, coupling);
        }
      EXPECT_EQ(matrix.factor(), coupling < 0.5) << blocks;
    }
  }
}

TEST_P(BlockTridiagonalOnEveryIsa, BeginsAnewAfterAFailureAsIfNothingHadHappened) {
  Problem problem(5, 29);
  const VectorXd expected = problem.solved(GetParam(), 1);
  BlockTridiagonal matrix = problem.matrix(GetParam(), 1);
  matrix.add(1, 3, 3, -1e6);
  EXPECT_FALSE(matrix.factor());
  matrix.set_zero();
  problem.fill(matrix, false);
  EXPECT_TRUE(matrix.factor());
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
