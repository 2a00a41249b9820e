#include <algorithm>
#include <cmath>

#include "analysis_sweeps.hpp"
#include "core/error.hpp"
#include "observables/scaling.hpp"

namespace lanescape::program {
namespace {

// One state with D of a quantity and (DeltaR/g)^2.
struct CommonState {
  double state;
  Estimate diffusion, ratio_squared;
};

bool is_one_system(const Sweep& paths, const Sweep& diffusion) {
  for (const char* name : {"model", "density", "images", "truncation", "cutoff"})
    if (paths.groups.front()->setting(name) != diffusion.groups.front()->setting(name)) return false;
  return paths.over_packing_fraction == diffusion.over_packing_fraction;
}

// D over T where `over_temperature`. Without states where D is not above 0, as correlations of a few trajectories may give.
std::vector<CommonState> common_states(const Sweep& paths, const Sweep& diffusion, const std::string& quantity,
                                       bool over_temperature) {
  std::vector<CommonState> states;
  for (const RunGroup* group : paths.groups)
    for (const RunGroup* other : diffusion.groups) {
      const GroupMean *ratio = group->mean("ratio_squared"), *of = other->mean(quantity);
      if (ratio == nullptr || of == nullptr || state_of(*group) != state_of(*other) || !(of->mean.value > 0.0)) continue;
      CommonState state{*state_of(*group), of->mean, ratio->mean};
      const double divisor = over_temperature ? state.state : 1.0;
      state.diffusion.value /= divisor;
      if (state.diffusion.error) *state.diffusion.error /= divisor;
      states.push_back(state);
    }
  return states;
}

// Of the ratio of D and c (DeltaR/g)^2, from the errors of both.
std::optional<double> error_of_ratio(const CommonState& at, double ratio) {
  if (!at.diffusion.error || !at.ratio_squared.error) return std::nullopt;
  return ratio * std::hypot(*at.diffusion.error / at.diffusion.value, *at.ratio_squared.error / at.ratio_squared.value);
}

void add_rows(ScalingTables& tables, const ResultRow& names, const std::vector<CommonState>& states, const ResultRow& sizes) {
  std::vector<ScalingPoint> points;
  for (const CommonState& state : states) points.push_back({state.diffusion.value, state.ratio_squared.value});
  const Scaling scaling = scale(points);
  ResultRow row = names;
  row.insert(row.end(), {{"points", states.size()},
                         {"from", states.front().state},
                         {"to", states.back().state},
                         {"constant", scaling.constant.value},
                         {"constant_error", json_or_null(scaling.constant.error)},
                         {"slope", scaling.slope ? Json(scaling.slope->value) : Json()},
                         {"slope_error", scaling.slope ? json_or_null(scaling.slope->error) : Json()},
                         {"spread", json_or_null(scaling.spread)}});
  row.insert(row.end(), sizes.begin(), sizes.end());
  tables.rows.push_back(std::move(row));
  for (const CommonState& state : states) {
    const double scaled = scaling.constant.value * state.ratio_squared.value, ratio = state.diffusion.value / scaled;
    ResultRow point = names;
    point.insert(point.end(), {{"state", state.state},
                               {"ratio_squared", state.ratio_squared.value},
                               {"ratio_squared_error", json_or_null(state.ratio_squared.error)},
                               {"diffusion", state.diffusion.value},
                               {"diffusion_error", json_or_null(state.diffusion.error)},
                               {"scaled", scaled},
                               {"diffusion_over_scaled", ratio},
                               {"diffusion_over_scaled_error", json_or_null(error_of_ratio(state, ratio))}});
    tables.points.push_back(std::move(point));
  }
}

void scale_pair(ScalingTables& tables, const Sweep& paths, const Sweep& diffusion) {
  const ResultRow sizes = {{"particles", paths.groups.front()->setting("particles")},
                           {"diffusion_particles", diffusion.groups.front()->setting("particles")}};
  for (const std::string& quantity : fitted_quantities(diffusion))
    for (const bool over_temperature : {false, true}) {
      if (over_temperature && paths.over_packing_fraction) continue;
      const std::vector<CommonState> states = common_states(paths, diffusion, quantity, over_temperature);
      if (states.empty()) continue;
      add_rows(
          tables,
          {{"sweep", paths.name}, {"diffusion_sweep", diffusion.name}, {"quantity", quantity + (over_temperature ? "/T" : "")}},
          states, sizes);
    }
}

}  // namespace

ScalingTables scale_sweeps(const std::vector<Sweep>& sweeps) {
  ScalingTables tables;
  for (const Sweep& paths : sweeps) {
    const std::vector<std::string> quantities = fitted_quantities(paths);
    if (is_diffusion(paths) || quantities.empty()) continue;
    for (const Sweep& diffusion : sweeps)
      if (is_diffusion(diffusion) && is_one_system(paths, diffusion)) scale_pair(tables, paths, diffusion);
  }
  return tables;
}

}  // namespace lanescape::program
