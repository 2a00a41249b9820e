#include "observables/fits/critical_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/random.hpp"

namespace lanescape {
namespace {

const std::vector<double> source_fractions{0.53, 0.54, 0.55, 0.56, 0.57};

struct Law {
  CriticalForm form;
  double slope, intercept, critical;
  CriticalSide side = CriticalSide::above;

  double logarithm(double state) const {
    const double d = side == CriticalSide::above ? critical - state : state - critical;
    return slope * critical_abscissa(form, d) + intercept;
  }
};

// The values that [G] fits: figures 4.20 to 4.25.
const Law source_laws[] = {{CriticalForm::mode_coupling, 1.450393, -1.404044, 0.59},
                           {CriticalForm::vogel_fulcher_tammann, 0.159643, -2.836295, 0.6122},
                           {CriticalForm::berthier_witten, 0.0125595, -3.653602, 0.635}};

std::vector<CriticalPoint> points_on(const Law& law, const std::vector<double>& states, double noise = 0.0,
                                     std::uint64_t seed = 1) {
  const CounterRandom random(seed, RandomStream::monte_carlo);
  std::vector<CriticalPoint> points;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const double value = std::exp(law.logarithm(states[k]) + noise * random.normal(k, 0));
    points.push_back({states[k], value, noise * value});
  }
  return points;
}

std::vector<double> spaced(double from, double to, int count) {
  std::vector<double> states;
  for (int k = 0; k < count; ++k) states.push_back(from + (to - from) * k / (count - 1));
  return states;
}

TEST(CriticalLaw, PointsOfTheSourcesFitsGiveItsParametersBack) {
  for (const Law& law : source_laws) {
    const CriticalFit fit = fit_critical_law(points_on(law, source_fractions), {.form = law.form, .critical = law.critical});
    EXPECT_NEAR(fit.slope.value, law.slope, 1e-9) << to_string(law.form);
    EXPECT_NEAR(fit.intercept.value, law.intercept, 1e-8);
    EXPECT_EQ(fit.critical.value, law.critical);
    EXPECT_FALSE(fit.critical.error.has_value());
    EXPECT_NEAR(fit.r_squared, 1.0, 1e-12);
    EXPECT_NEAR(fit.residual_deviation, 0.0, 1e-8);
  }
}

TEST(CriticalLaw, TheSourcesFormulaForTheRatioGivesItsPublishedValues) {
  // [G] figure 4.20: 4.15e-3, 2.31e-3 and 8.4e-4 at 0.53, 0.55 and 0.57.
  EXPECT_NEAR(std::exp(source_laws[0].logarithm(0.53)), 4.15e-3, 1e-5);
  EXPECT_NEAR(std::exp(source_laws[0].logarithm(0.55)), 2.31e-3, 1e-5);
  EXPECT_NEAR(std::exp(source_laws[0].logarithm(0.57)), 8.4e-4, 1e-5);
}

TEST(CriticalLaw, RSquaredIsThatOfTheLogarithmAndAdjustedAsInTheSource) {
  const Law& law = source_laws[0];
  const std::vector<CriticalPoint> points = points_on(law, source_fractions, 0.1);
  const CriticalFit fit = fit_critical_law(points, {.form = law.form, .critical = law.critical});
  double mean = 0.0, about_mean = 0.0, about_fit = 0.0;
  for (const CriticalPoint& point : points) mean += std::log(point.value) / 5.0;
  for (const CriticalPoint& point : points) {
    about_mean += std::pow(std::log(point.value) - mean, 2);
    about_fit += std::pow(std::log(point.value) - fit.slope.value * std::log(0.59 - point.state) - fit.intercept.value, 2);
  }
  EXPECT_NEAR(fit.r_squared, 1.0 - about_fit / about_mean, 1e-12);
  EXPECT_NEAR(fit.residual_deviation, std::sqrt(about_fit / 3.0), 1e-12);
  // [G] prints 0.999301 and 0.998602 for five points: (n - 1)/(n - m - 1) = 2.
  EXPECT_NEAR(1.0 - fit.adjusted_r_squared.value(), 2.0 * (1.0 - fit.r_squared), 1e-12);
}

// Shares of seeds in which a parameter lies within one error of the truth, and its mean.
struct Calibration {
  double slope = 0.0, intercept = 0.0, critical = 0.0;                 // shares
  double mean_slope = 0.0, mean_intercept = 0.0, mean_critical = 0.0;  // of (value - truth)/error
};

Calibration calibrate(const Law& law, const std::vector<double>& states, double noise, CriticalFitOptions options, int seeds) {
  Calibration result;
  const auto add = [&](const Estimate& estimate, double truth, double& share, double& mean) {
    if (!estimate.error) return;
    const double pull = (estimate.value - truth) / *estimate.error;
    share += (std::abs(pull) < 1.0) / static_cast<double>(seeds);
    mean += pull / seeds;
  };
  for (int seed = 1; seed <= seeds; ++seed) {
    const CriticalFit fit = fit_critical_law(points_on(law, states, noise, static_cast<std::uint64_t>(seed)), options);
    add(fit.slope, law.slope, result.slope, result.mean_slope);
    add(fit.intercept, law.intercept, result.intercept, result.mean_intercept);
    add(fit.critical, law.critical, result.critical, result.mean_critical);
  }
  return result;
}

TEST(CriticalLaw, ErrorsOfFitsToNoiseHoldTheTruthInTwoOfThreeCases) {
  const std::vector<double> states = spaced(0.45, 0.575, 16);
  for (const Law& law : source_laws)
    for (const bool weighted : {false, true}) {
      const Calibration got =
          calibrate(law, states, 0.05, {.form = law.form, .critical = law.critical, .weighted = weighted}, 1000);
      // Of Student's distribution with 14 degrees of freedom 0.666 lies within one deviation; of the normal one 0.683.
      EXPECT_NEAR(got.slope, weighted ? 0.683 : 0.666, 0.045) << to_string(law.form);
      EXPECT_NEAR(got.intercept, weighted ? 0.683 : 0.666, 0.045);
      EXPECT_NEAR(got.mean_slope, 0.0, 3.3 / std::sqrt(1000.0));
      EXPECT_NEAR(got.mean_intercept, 0.0, 3.3 / std::sqrt(1000.0));
    }
}

TEST(CriticalLaw, AFreeCriticalValueIsFoundWithAnHonestError) {
  const std::vector<double> states = spaced(0.45, 0.575, 24);
  for (const Law& law : source_laws)
    for (const bool weighted : {false, true}) {
      const Calibration got = calibrate(law, states, 0.005, {.form = law.form, .critical = {}, .weighted = weighted}, 500);
      EXPECT_NEAR(got.critical, weighted ? 0.683 : 0.67, 0.07) << to_string(law.form);
      EXPECT_NEAR(got.slope, weighted ? 0.683 : 0.67, 0.07);
      EXPECT_NEAR(got.mean_critical, 0.0, 0.2);
    }
}

TEST(CriticalLaw, TemperaturesLieAboveTheirCriticalValue) {
  const Law law{CriticalForm::mode_coupling, 2.0, -3.0, 0.435, CriticalSide::below};
  const std::vector<CriticalPoint> points = points_on(law, {0.5, 0.6, 0.8, 1.0, 2.0});
  const CriticalFit held = fit_critical_law(points, {.form = law.form, .side = law.side, .critical = 0.435});
  EXPECT_NEAR(held.slope.value, 2.0, 1e-9);
  const CriticalFit free = fit_critical_law(points, {.form = law.form, .side = law.side, .critical = {}});
  EXPECT_NEAR(free.critical.value, 0.435, 1e-7);
  EXPECT_NEAR(free.slope.value, 2.0, 1e-6);
}

void refused(const std::vector<CriticalPoint>& points, const CriticalFitOptions& options, const char* says) {
  try {
    fit_critical_law(points, options);
    ADD_FAILURE() << "accepted: " << says;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
  }
}

TEST(CriticalLaw, WhatCannotBeFittedIsRefused) {
  const Law& law = source_laws[0];
  refused(points_on(law, {0.5, 0.55}), {.critical = 0.59}, "2 points: 3 or more are needed for 2 parameters");
  refused(points_on(law, {0.5, 0.53, 0.55}), {.critical = {}}, "3 points: 4 or more are needed for 3 parameters");
  refused(points_on(law, {0.5, 0.53, 0.55}), {.critical = 0.55}, "0.55 is not below the critical value 0.55");
  refused(points_on(law, {0.5, 0.53, 0.55}), {.side = CriticalSide::below, .critical = 0.52}, "0.5 is not above");
  refused({{0.5, 0.1, {}}, {0.53, -0.1, {}}, {0.55, 0.05, {}}}, {.critical = 0.59}, "above 0 is needed");
  refused({{0.5, 0.1, 0.01}, {0.53, 0.08, {}}, {0.55, 0.05, 0.01}}, {.critical = 0.59, .weighted = true}, "0.53 has no error");
  // A power of the state itself has no critical value beyond the points.
  std::vector<CriticalPoint> rising;
  for (const double state : {0.3, 0.4, 0.5, 0.55}) rising.push_back({state, std::exp(-state), {}});
  refused(rising, {.critical = {}}, "no finite critical value");
}

TEST(CriticalLaw, ThreePointsHaveNoAdjustedRSquared) {
  const CriticalFit fit = fit_critical_law(points_on(source_laws[0], {0.5, 0.53, 0.55}, 0.1), {.critical = 0.59});
  EXPECT_FALSE(fit.adjusted_r_squared.has_value());
}

}  // namespace
}  // namespace lanescape
