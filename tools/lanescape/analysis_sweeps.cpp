#include "analysis_sweeps.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "analysis_settings.hpp"

namespace lanescape::program {
namespace {

const std::vector<std::string> state_settings = {"packing_fraction", "temperature"};
const std::vector<std::string> settings_of_state = {"packing_fraction", "temperature", "interval", "longest_time"};

// Sweeps by their names, made of all settings but these.
std::map<std::string, Sweep> sweeps_without(const std::vector<const RunGroup*>& groups, const std::vector<std::string>& without) {
  std::map<std::string, Sweep> sweeps;
  for (const RunGroup* group : groups) {
    const std::string name = name_of_settings(group->settings, without);
    const auto [place, is_new] = sweeps.try_emplace(name, Sweep{name, !group->setting("packing_fraction").is_null(), {}});
    place->second.groups.push_back(group);
  }
  for (auto& [name, sweep] : sweeps)
    std::stable_sort(sweep.groups.begin(), sweep.groups.end(), [](auto* a, auto* b) { return state_of(*a) < state_of(*b); });
  return sweeps;
}

bool has_each_state_once(const Sweep& sweep) {
  std::set<double> states;
  for (const RunGroup* group : sweep.groups)
    if (!states.insert(*state_of(*group)).second) return false;
  return true;
}

}  // namespace

std::optional<double> state_of(const RunGroup& group) {
  for (const std::string& name : state_settings)
    if (const Json& state = group.setting(name); !state.is_null()) return state.get<double>();
  return std::nullopt;
}

bool is_diffusion(const Sweep& sweep) { return sweep.groups.front()->setting("kind") == "diffusion"; }

std::vector<Sweep> sweeps_of(const std::vector<RunGroup>& groups) {
  std::vector<const RunGroup*> placed;
  for (const RunGroup& group : groups)
    if (state_of(group)) placed.push_back(&group);
  std::vector<Sweep> sweeps;
  for (auto& [name, sweep] : sweeps_without(placed, settings_of_state)) {
    if (has_each_state_once(sweep))
      sweeps.push_back(std::move(sweep));
    else
      for (auto& [part, of_one_time] : sweeps_without(sweep.groups, state_settings)) sweeps.push_back(std::move(of_one_time));
  }
  return sweeps;
}

std::vector<std::string> fitted_quantities(const Sweep& sweep) {
  std::vector<std::string> quantities;
  for (const RunGroup* group : sweep.groups)
    for (const GroupMean& mean : group->means) {
      const std::string& name = mean.quantity;
      if (name != "ratio_squared" && !name.starts_with("diffusion_")) continue;
      if (std::find(quantities.begin(), quantities.end(), name) == quantities.end()) quantities.push_back(name);
    }
  return quantities;
}

}  // namespace lanescape::program
