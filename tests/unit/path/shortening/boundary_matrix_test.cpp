#include "path/shortening/boundary_matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dispatch/isa.hpp"
#include "kernel_table.hpp"

namespace lanescape {
namespace {

constexpr std::size_t dimension = 24;

double number(std::size_t k, std::size_t q) {
  return std::sin(1.0 + 0.7 * static_cast<double>(k) + 1.9 * static_cast<double>(q * q));
}

// Any vectors do: the matrix is that of the fields they make.
Polyline vectors(std::size_t nodes) {
  Polyline field(nodes, AlignedArray(dimension, 0.0));
  for (std::size_t k = 1; k + 1 < nodes; ++k)
    for (std::size_t q = 0; q < dimension; ++q) field[k][q] = number(k, q);
  return field;
}

const VectorAlgebra& algebra() {
  static const VectorAlgebra instance(kernel_table(choose_isa("auto")));
  return instance;
}

// (L + shift) x - f of the inner nodes, the largest element.
double defect(const Polyline& x, const Polyline& f, double shift) {
  double largest = 0.0;
  for (std::size_t k = 1; k + 1 < x.size(); ++k)
    for (std::size_t q = 0; q < dimension; ++q) {
      const double pull = 2.0 * x[k][q] - x[k - 1][q] - x[k + 1][q];
      largest = std::max(largest, std::abs(pull + shift * x[k][q] - f[k][q]));
    }
  return largest;
}

TEST(StringLaplacian, SolvesByBlocksOfNodes) {
  for (const std::size_t nodes : {3u, 4u, 17u, 40u, 700u})
    for (const double shift : {0.0, 1e-4, 0.3, 50.0}) {
      const Polyline right = vectors(nodes);
      const NodeBlocks blocks(nodes, 2);
      StringLaplacian laplacian;
      laplacian.prepare(nodes, shift);
      Polyline solution(nodes, AlignedArray(dimension, 7.0));
      std::vector<int> ended(nodes, 0);
      laplacian.solve(
          algebra(), solution, blocks, [&](std::size_t k) { solution[k] = right[k]; }, [&](std::size_t k) { ++ended[k]; });
      const double scale = shift > 0.0 ? 1.0 : static_cast<double>(nodes * nodes);
      EXPECT_LT(defect(solution, right, shift), 1e-13 * scale) << nodes << " " << shift;
      for (std::size_t k = 1; k + 1 < nodes; ++k) EXPECT_EQ(ended[k], 1);
    }
}

TEST(BoundaryMatrix, IsTheStringsInverseBetweenTheNormalsOfItsNodes) {
  constexpr std::size_t nodes = 300;
  const Polyline normals = vectors(nodes);
  const NodeBlocks blocks(nodes, 2);
  for (const double shift : {0.01, 0.4, 3.0}) {
    StringLaplacian laplacian;
    laplacian.prepare(nodes, shift);
    BoundaryMatrix matrix;
    matrix.prepare(laplacian, nodes);
    std::vector<char> on(nodes, 0);
    std::vector<double> weights(nodes, 0.0), product(nodes, 1.0);
    // Nodes join in two turns.
    for (const std::size_t every : {3u, 2u}) {
      for (std::size_t k = 1; k + 1 < nodes; ++k) on[k] = on[k] || k % every == 0;
      matrix.include(algebra(), normals, on, blocks);
    }
    for (std::size_t k = 1; k + 1 < nodes; ++k) weights[k] = on[k] ? number(k, 3) : 0.0;
    matrix.multiply(weights, on, product, blocks);
    Polyline field(nodes, AlignedArray(dimension, 0.0));
    for (std::size_t k = 1; k + 1 < nodes; ++k) algebra().axpy(field[k], field[0], weights[k], normals[k]);
    const auto nothing = [](std::size_t) {};
    laplacian.solve(algebra(), field, blocks, nothing, nothing);
    for (std::size_t k = 0; k < nodes; ++k) EXPECT_NEAR(product[k], on[k] ? algebra().dot(field[k], normals[k]) : 0.0, 1e-10);
  }
}

TEST(BoundaryMatrix, ReachesFurtherWhereTheStringIsFreer) {
  StringLaplacian stiff, soft;
  stiff.prepare(1000, 0.4);
  soft.prepare(1000, 0.01);
  BoundaryMatrix narrow, wide;
  narrow.prepare(stiff, 1000);
  wide.prepare(soft, 1000);
  EXPECT_NEAR(static_cast<double>(narrow.reach()), 13.0 * std::log(10.0) / std::acosh(1.2), 1.0);
  EXPECT_NEAR(static_cast<double>(wide.reach()), 13.0 * std::log(10.0) / std::acosh(1.005), 1.0);
}

}  // namespace
}  // namespace lanescape
