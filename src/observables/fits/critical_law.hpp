#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "observables/statistics.hpp"

namespace lanescape {

// How D or (DeltaR/g)^2 vanish towards a critical state, with d the distance from it ([G] 4.7): ln y = slope X(d) + intercept.
enum class CriticalForm {
  mode_coupling,          // X = ln d: y = a d^gamma
  vogel_fulcher_tammann,  // X = -1/d: y = exp(-A/d - B)
  berthier_witten         // X = -1/d^2: y = exp(-A/d^2 - B)
};
inline constexpr CriticalForm all_critical_forms[] = {CriticalForm::mode_coupling, CriticalForm::vogel_fulcher_tammann,
                                                      CriticalForm::berthier_witten};
const char* to_string(CriticalForm form);  // "mode-coupling", ...

// The critical state lies above all others, as of hard spheres in phi, or below, as of temperatures.
enum class CriticalSide { above, below };

struct CriticalPoint {
  double state;                 // phi or T
  double value;                 // y
  std::optional<double> error;  // of y
};

struct CriticalFitOptions {
  CriticalForm form = CriticalForm::mode_coupling;
  CriticalSide side = CriticalSide::above;
  std::optional<double> critical;  // held there; without it, it is fitted too
  bool weighted = false;           // by the errors of the values, which all need one; else ln y counts alike at all points
};

struct CriticalFit {
  Estimate slope, intercept;  // of ln y against X
  Estimate critical;          // without an error where it was held
  double r_squared = 0.0;     // of ln y
  // 1 - (1 - R^2)(n - 1)/(n - m - 1) of n points and m parameters, as [G] counts them; none where n = m + 1.
  std::optional<double> adjusted_r_squared;
  double residual_deviation = 0.0;  // of ln y, over n - m degrees of freedom; weighted, in units of the errors
};

// By least squares in ln y. Errors of parameters follow from the residuals, of weighted fits from the errors of the values. Throws
// Error(bad_input) for fewer points than parameters + 1, values that are not above 0, points at the critical state or beyond it, a
// missing error, and where no finite critical state fits best.
CriticalFit fit_critical_law(std::span<const CriticalPoint> points, const CriticalFitOptions& options);

// X(d).
double critical_abscissa(CriticalForm form, double distance);

}  // namespace lanescape
