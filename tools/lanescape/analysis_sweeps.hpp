#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis_groups.hpp"
#include "observables/fits/critical_law.hpp"

namespace lanescape::program {

// Groups that differ in phi alone (hard spheres) or in T alone (soft models), in ascending order.
struct Sweep {
  std::string name;  // made of the settings that they share
  bool over_packing_fraction;
  std::vector<const RunGroup*> groups;
};
// Intervals and times of diffusion may differ along a sweep where no state has two of them. Groups at an unknown temperature are in
// none.
std::vector<Sweep> sweeps_of(const std::vector<RunGroup>& groups);
// phi or T of a group.
std::optional<double> state_of(const RunGroup& group);
bool is_diffusion(const Sweep& sweep);
// (DeltaR/g)^2 of paths, or D of each species by each way.
std::vector<std::string> fitted_quantities(const Sweep& sweep);

struct FitSettings {
  std::optional<double> mode_coupling, vogel_fulcher_tammann, berthier_witten;  // critical values that were given
  bool free_critical = false, weighted = false;
  std::optional<std::pair<double, double>> range;  // of phi or T
};

struct Fits {
  ResultTable rows;      // of fits.csv
  ResultTable refusals;  // fits that could not be made, and why
};
// Throws Error(bad_input) where critical values were given and the sweeps are of several models.
Fits fit_sweeps(const std::vector<Sweep>& sweeps, const FitSettings& settings);

// D against (DeltaR/g)^2, for each sweep of paths and each of diffusion in the same model.
struct ScalingTables {
  ResultTable rows, points;  // of scaling.csv and scaling_points.csv
};
ScalingTables scale_sweeps(const std::vector<Sweep>& sweeps);

}  // namespace lanescape::program
