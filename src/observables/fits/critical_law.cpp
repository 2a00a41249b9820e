#include "observables/fits/critical_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "observables/fits/least_squares.hpp"
#include "observables/fits/line.hpp"

namespace lanescape {
namespace {

// dX/dd.
double abscissa_slope(CriticalForm form, double d) {
  switch (form) {
    case CriticalForm::mode_coupling:
      return 1.0 / d;
    case CriticalForm::vogel_fulcher_tammann:
      return 1.0 / (d * d);
    case CriticalForm::berthier_witten:
      return 2.0 / (d * d * d);
  }
  return 0.0;
}

// The points as the fit sees them.
struct Data {
  CriticalForm form;
  double nearest = 0.0;                  // state next to the critical one
  std::vector<double> inside;            // distance of each point from `nearest`, away from the critical state
  std::vector<double> logarithm, error;  // of ln y

  std::size_t size() const { return inside.size(); }
  double extent() const { return *std::max_element(inside.begin(), inside.end()); }
  // X of each point where the critical state lies so far from the nearest point.
  std::vector<double> abscissae(double gap) const {
    std::vector<double> x;
    for (const double d : inside) x.push_back(critical_abscissa(form, gap + d));
    return x;
  }
  Line line(double gap, bool weighted) const {
    return fit_line(abscissae(gap), logarithm, weighted ? std::span<const double>(error) : std::span<const double>());
  }
};

double sign_of(CriticalSide side) { return side == CriticalSide::above ? 1.0 : -1.0; }

Data prepare(std::span<const CriticalPoint> points, const CriticalFitOptions& options) {
  const std::size_t parameters = options.critical ? 2 : 3;
  if (points.size() < parameters + 1)
    throw_bad_input(fmt::format("{} points: {} or more are needed for {} parameters", points.size(), parameters + 1, parameters));
  Data data{options.form, points[0].state, {}, {}, {}};
  const double sign = sign_of(options.side);
  for (const CriticalPoint& point : points)
    if (sign * point.state > sign * data.nearest) data.nearest = point.state;
  for (const CriticalPoint& point : points) {
    if (!(point.value > 0.0)) throw_bad_input(fmt::format("the value {} at {}: above 0 is needed", point.value, point.state));
    if (options.weighted && !(point.error.value_or(0.0) > 0.0))
      throw_bad_input(fmt::format("the value at {} has no error, which a weighted fit needs", point.state));
    data.inside.push_back(sign * (data.nearest - point.state));
    data.logarithm.push_back(std::log(point.value));
    data.error.push_back(options.weighted ? *point.error / point.value : 1.0);
  }
  return data;
}

// The distance of the critical state from the nearest point at which a line fits best, of some over five decades.
double start_gap(const Data& data, bool weighted) {
  double best = data.extent(), least = data.line(best, weighted).squares;
  for (double gap = 1e-3 * data.extent(); gap < 20.0 * data.extent(); gap *= 1.5)
    if (const double squares = data.line(gap, weighted).squares; squares < least) {
      least = squares;
      best = gap;
    }
  return best;
}

// The least squares of ln y. The parameters are slope, intercept and, where the critical state is free, the logarithm of the gap
// between it and the nearest point, which is above 0 then.
LeastSquaresProblem problem_of(const Data& data, std::optional<double> held_gap) {
  const auto gap_of = [=](std::span<const double> p) { return held_gap ? *held_gap : std::exp(p[2]); };
  LeastSquaresProblem problem;
  problem.residuals = data.size();
  problem.values = [&data, gap_of](std::span<const double> p, std::span<double> r) {
    for (std::size_t k = 0; k < r.size(); ++k) {
      const double x = critical_abscissa(data.form, gap_of(p) + data.inside[k]);
      r[k] = (p[0] * x + p[1] - data.logarithm[k]) / data.error[k];
    }
  };
  problem.derivatives = [&data, gap_of](std::span<const double> p, std::span<double> derivatives) {
    const std::size_t n = data.size();
    for (std::size_t k = 0; k < n; ++k) {
      const double d = gap_of(p) + data.inside[k];
      derivatives[k] = critical_abscissa(data.form, d) / data.error[k];
      derivatives[k + n] = 1.0 / data.error[k];
      if (p.size() == 3) derivatives[k + 2 * n] = p[0] * abscissa_slope(data.form, d) * gap_of(p) / data.error[k];
    }
  };
  return problem;
}

// The weighted sum of squares of ln y about its mean.
double total_squares(const Data& data) {
  double weight = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < data.size(); ++k) {
    weight += 1.0 / (data.error[k] * data.error[k]);
    sum += data.logarithm[k] / (data.error[k] * data.error[k]);
  }
  for (std::size_t k = 0; k < data.size(); ++k) squares += std::pow((data.logarithm[k] - sum / weight) / data.error[k], 2);
  return squares;
}

CriticalFit fit_of(const LeastSquaresSolution& solution, const Data& data, const CriticalFitOptions& options) {
  const auto n = static_cast<double>(data.size()), m = static_cast<double>(solution.parameters.size());
  const double variance = solution.squares / (n - m), of_values = options.weighted ? 1.0 : variance;
  const auto error = [&](std::size_t p) { return std::sqrt(of_values * solution.variances[p]); };
  CriticalFit fit;
  fit.slope = {solution.parameters[0], error(0)};
  fit.intercept = {solution.parameters[1], error(1)};
  fit.residual_deviation = std::sqrt(variance);
  fit.r_squared = 1.0 - solution.squares / total_squares(data);
  if (n > m + 1.0) fit.adjusted_r_squared = 1.0 - (1.0 - fit.r_squared) * (n - 1.0) / (n - m - 1.0);
  if (options.critical) {
    fit.critical = {*options.critical, std::nullopt};
  } else {
    const double gap = std::exp(solution.parameters[2]);
    fit.critical = {data.nearest + sign_of(options.side) * gap, gap * error(2)};
  }
  return fit;
}

}  // namespace

const char* to_string(CriticalForm form) {
  switch (form) {
    case CriticalForm::mode_coupling:
      return "mode-coupling";
    case CriticalForm::vogel_fulcher_tammann:
      return "vogel-fulcher-tammann";
    case CriticalForm::berthier_witten:
      return "berthier-witten";
  }
  return "";
}

double critical_abscissa(CriticalForm form, double distance) {
  switch (form) {
    case CriticalForm::mode_coupling:
      return std::log(distance);
    case CriticalForm::vogel_fulcher_tammann:
      return -1.0 / distance;
    case CriticalForm::berthier_witten:
      return -1.0 / (distance * distance);
  }
  return 0.0;
}

CriticalFit fit_critical_law(std::span<const CriticalPoint> points, const CriticalFitOptions& options) {
  const Data data = prepare(points, options);
  std::optional<double> held_gap;
  if (options.critical) {
    held_gap = sign_of(options.side) * (*options.critical - data.nearest);
    if (!(*held_gap > 0.0))
      throw_bad_input(fmt::format("the point at {} is not {} the critical value {}", data.nearest,
                                  options.side == CriticalSide::above ? "below" : "above", *options.critical));
  }
  const double gap = held_gap ? *held_gap : start_gap(data, options.weighted);
  const Line line = data.line(gap, options.weighted);
  std::vector<double> start{line.slope.value, line.intercept.value};
  if (!held_gap) start.push_back(std::log(gap));
  const LeastSquaresSolution solution = minimise_squares(problem_of(data, held_gap), start);
  const bool bounded = held_gap || (std::exp(solution.parameters[2]) < 100.0 * data.extent() &&
                                    std::exp(solution.parameters[2]) > 1e-6 * data.extent());
  if (!solution.converged || !bounded) throw_bad_input("no finite critical value fits best");
  return fit_of(solution, data, options);
}

}  // namespace lanescape
