#include "observables/fits/least_squares.hpp"

#include <Eigen/Dense>
#include <unsupported/Eigen/NonLinearOptimization>

#include <cmath>
#include <limits>

namespace lanescape {
namespace {

// What Eigen's solver calls.
struct EigenProblem {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const LeastSquaresProblem& problem;
  Eigen::Index parameters;

  Eigen::Index inputs() const { return parameters; }
  Eigen::Index values() const { return static_cast<Eigen::Index>(problem.residuals); }
  std::span<const double> span_of(const InputType& p) const { return {p.data(), static_cast<std::size_t>(p.size())}; }
  int operator()(const InputType& p, ValueType& r) const {
    problem.values(span_of(p), {r.data(), problem.residuals});
    return 0;
  }
  // The matrix is column-major, as the derivatives are.
  int df(const InputType& p, JacobianType& j) const {
    problem.derivatives(span_of(p), {j.data(), static_cast<std::size_t>(j.size())});
    return 0;
  }
};

}  // namespace

LeastSquaresSolution minimise_squares(const LeastSquaresProblem& problem, std::span<const double> start) {
  EigenProblem functor{problem, static_cast<Eigen::Index>(start.size())};
  Eigen::LevenbergMarquardt<EigenProblem> solver(functor);
  solver.parameters.ftol = solver.parameters.xtol = 1e-14;
  solver.parameters.maxfev = 2000;
  Eigen::VectorXd p = Eigen::Map<const Eigen::VectorXd>(start.data(), functor.parameters);
  const auto status = solver.minimize(p);
  Eigen::VectorXd residuals(functor.values());
  Eigen::MatrixXd jacobian(functor.values(), functor.parameters);
  functor(p, residuals);
  functor.df(p, jacobian);
  const Eigen::VectorXd variances = (jacobian.transpose() * jacobian).inverse().diagonal();
  LeastSquaresSolution solution;
  solution.parameters.assign(p.data(), p.data() + p.size());
  solution.variances.assign(variances.data(), variances.data() + variances.size());
  solution.squares = residuals.squaredNorm();
  // Tolerances below what rounding allows are no failure: the solver says so and stays at the least value.
  solution.converged = status >= 1 && status != 5 && p.allFinite() && variances.allFinite() && variances.minCoeff() >= 0.0;
  return solution;
}

}  // namespace lanescape
