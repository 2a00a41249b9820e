#include <fmt/format.h>

#include <set>

#include "analysis_sweeps.hpp"
#include "core/error.hpp"

namespace lanescape::program {
namespace {

// Those that [G] holds, of binary hard spheres (Flenner, Zhang and Szamel, doi 10.1103/PhysRevE.83.051501).
constexpr const char* model_of_defaults = "hard-sphere-binary";
constexpr double default_critical[] = {0.59, 0.6122, 0.635};

std::optional<double> critical_of(CriticalForm form, const FitSettings& settings, const Sweep& sweep) {
  const std::optional<double> given[] = {settings.mode_coupling, settings.vogel_fulcher_tammann, settings.berthier_witten};
  const auto place = static_cast<std::size_t>(form);
  if (given[place]) return given[place];
  if (sweep.groups.front()->setting("model") == model_of_defaults) return default_critical[place];
  return std::nullopt;
}

std::vector<CriticalPoint> points_of(const Sweep& sweep, const std::string& quantity, const FitSettings& settings) {
  std::vector<CriticalPoint> points;
  for (const RunGroup* group : sweep.groups) {
    const GroupMean* mean = group->mean(quantity);
    const double state = *state_of(*group);
    if (mean == nullptr || (settings.range && (state < settings.range->first || state > settings.range->second))) continue;
    points.push_back({state, mean->mean.value, mean->mean.error});
  }
  return points;
}

ResultRow row_of(const CriticalFit& fit, const std::vector<CriticalPoint>& points, bool weighted) {
  return {{"points", points.size()},
          {"from", points.front().state},
          {"to", points.back().state},
          {"slope", fit.slope.value},
          {"slope_error", json_or_null(fit.slope.error)},
          {"intercept", fit.intercept.value},
          {"intercept_error", json_or_null(fit.intercept.error)},
          {"critical", fit.critical.value},
          {"critical_error", json_or_null(fit.critical.error)},
          {"r_squared", fit.r_squared},
          {"adjusted_r_squared", json_or_null(fit.adjusted_r_squared)},
          {"residual_deviation", fit.residual_deviation},
          {"weighted", weighted}};
}

// One fit of one quantity of a sweep, or why there is none.
void fit(Fits& fits, const Sweep& sweep, const std::string& quantity, const std::vector<CriticalPoint>& points,
         const CriticalFitOptions& options) {
  ResultRow row = {{"sweep", sweep.name}, {"quantity", quantity}, {"form", to_string(options.form)}};
  try {
    const CriticalFit fitted = fit_critical_law(points, options);
    for (auto& cell : row_of(fitted, points, options.weighted)) row.push_back(std::move(cell));
    fits.rows.push_back(std::move(row));
  } catch (const Error& error) {
    row.emplace_back("critical", json_or_null(options.critical));
    row.emplace_back("reason", error.what());
    fits.refusals.push_back(std::move(row));
  }
}

void refuse_several_models(const std::vector<Sweep>& sweeps, const FitSettings& settings) {
  if (!settings.mode_coupling && !settings.vogel_fulcher_tammann && !settings.berthier_witten) return;
  std::set<std::string> models;
  for (const Sweep& sweep : sweeps) models.insert(sweep.groups.front()->setting("model").get<std::string>());
  if (models.size() > 1)
    throw_bad_input(fmt::format("critical values are not allowed for runs of several models, {} and {}: name those of one model",
                                *models.begin(), *models.rbegin()));
}

}  // namespace

Fits fit_sweeps(const std::vector<Sweep>& sweeps, const FitSettings& settings) {
  refuse_several_models(sweeps, settings);
  Fits fits;
  for (const Sweep& sweep : sweeps)
    for (const std::string& quantity : fitted_quantities(sweep)) {
      const std::vector<CriticalPoint> points = points_of(sweep, quantity, settings);
      if (points.size() < 3) continue;  // no sweep to speak of
      for (const CriticalForm form : all_critical_forms) {
        CriticalFitOptions options{form, sweep.over_packing_fraction ? CriticalSide::above : CriticalSide::below,
                                   critical_of(form, settings, sweep), settings.weighted};
        if (options.critical) fit(fits, sweep, quantity, points, options);
        options.critical = std::nullopt;
        if (settings.free_critical) fit(fits, sweep, quantity, points, options);
      }
    }
  return fits;
}

}  // namespace lanescape::program
