#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace lanescape {

// Residuals r_k(p) whose sum of squares is to be least.
struct LeastSquaresProblem {
  std::size_t residuals = 0;
  std::function<void(std::span<const double> parameters, std::span<double> residuals)> values;
  // Derivatives dr_k/dp_j at [k + j * residuals].
  std::function<void(std::span<const double> parameters, std::span<double> derivatives)> derivatives;
};

struct LeastSquaresSolution {
  std::vector<double> parameters;
  std::vector<double> variances;  // diagonal of (J^T J)^-1: those of the parameters in units of the residuals' variance
  double squares = 0.0;           // the sum
  bool converged = false;
};

// By the method of Levenberg and Marquardt, Eigen's port of MINPACK's lmder.
LeastSquaresSolution minimise_squares(const LeastSquaresProblem& problem, std::span<const double> start);

}  // namespace lanescape
