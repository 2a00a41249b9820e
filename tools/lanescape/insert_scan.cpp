#include <fmt/format.h>

#include <utility>

#include "core/error.hpp"
#include "insert_runs.hpp"
#include "result_table.hpp"
#include "run/insertion_scan.hpp"

namespace lanescape::program {
namespace {

InsertionScanOptions scan_options(const InsertState& state, const PairModel& model) {
  InsertionScanOptions with;
  for (const std::string& text : list_of(state.states, "--states")) {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos)
      throw_bad_input(fmt::format("--states: '{}' is not allowed: density:temperature is needed", text));
    with.states.push_back({number_of(text.substr(0, colon), "--states"), number_of(text.substr(colon + 1), "--states")});
  }
  for (const std::string& word : list_of(state.methods, "--methods")) with.methods.push_back(parse_insertion_method(word));
  const std::string tolerances = state.tolerances.empty() ? fmt::format("{}", state.setup.tolerance) : state.tolerances;
  for (const std::string& text : list_of(tolerances, "--tolerances")) with.tolerances.push_back(number_of(text, "--tolerances"));
  for (const std::string& text : list_of(state.largest_steps, "--largest-steps"))
    with.largest_steps.push_back(text == "default" ? state.setup.largest_step : std::optional(number_of(text, "--largest-steps")));
  for (const std::string& text : list_of(state.iso_energies, "--iso-energies"))
    with.iso_energies.push_back(number_of(text, "--iso-energies"));
  with.insertion = state.setup.resolve(state.common.seed);
  if (const std::optional<double> number = state.setup.number({"mean", "mu"})) {
    with.target = ScanTarget::number;
    with.insertion.target = *number;
  } else if (state.setup.energy == "mu") {
    with.target = ScanTarget::chemical_potential;
  }
  with.species = state.setup.species_index(model);
  with.particles = state.particles;
  with.configurations = state.configurations;
  with.count = state.count;
  with.equilibration_steps = state.equilibration_steps;
  with.between_steps = state.between_steps;
  with.time_step = state.time_step;
  with.widom_probes = state.widom_probes;
  with.holes = state.holes;
  with.traced_searches = state.traced_searches;
  with.map_points = state.map_points;
  with.seed = state.common.seed;
  with.threads = state.common.threads;
  with.check(model);
  return with;
}

ResultRow row_of(const ScanCostRow& r) {
  const Json step = r.largest_step > 0.0 ? Json(r.largest_step) : Json("default");
  return {{"density", r.density},
          {"temperature", r.temperature},
          {"method", to_string(r.method)},
          {"tolerance", r.tolerance},
          {"largest_step", step},
          {"target", r.target},
          {"evaluations", r.evaluations},
          {"evaluations_error", r.evaluations_error},
          {"evaluations_deviation", r.evaluations_deviation},
          {"trials", r.trials},
          {"candidates", r.candidates},
          {"distance", r.distance},
          {"largest_distance", r.largest_distance},
          {"error", r.error},
          {"failures", r.failures},
          {"seconds", r.seconds}};
}

ResultRow row_of(const ScanStateRow& r) {
  return {{"density", r.density},
          {"temperature", r.temperature},
          {"measured_temperature", r.measured_temperature},
          {"excess_energy", r.excess_energy},
          {"pressure", r.pressure},
          {"chemical_potential", number_or_null(r.chemical_potential)},
          {"chemical_potential_error", number_or_null(r.chemical_potential_error)}};
}

ResultRow row_of(const ScanHoleRow& r) {
  return {{"density", r.density},       {"temperature", r.temperature}, {"iso_energy", r.iso_energy},
          {"holes", r.holes},           {"mean_radius", r.mean_radius}, {"semi_minor", r.semi_minor},
          {"semi_major", r.semi_major}, {"anisotropy", r.anisotropy},   {"eccentricity", r.eccentricity},
          {"open_directions", r.open}};
}

ResultRow row_of(const ScanMapPoint& r) {
  return {{"density", r.density}, {"temperature", r.temperature}, {"y", r.y}, {"z", r.z}, {"energy", r.energy}, {"target", r.target}};
}

ResultRow row_of(const ScanErrorPair& r) { return {{"density", r.density}, {"error", r.error}, {"next_error", r.next_error}}; }

}  // namespace

Json run_scan(InsertState& state, const Options& options, const PairModel& model, Isa isa, int& status) {
  const InsertionScanOptions with = scan_options(state, model);
  OutputFolder folder = open_folder(state.common);
  folder.write_run_file("insert", options.resolved());
  TerminalMonitor monitor(state.common.quiet);
  const InsertionScanResult run =
      run_insertion_scan(model, with, isa, {folder.checkpoints(), !state.common.resume.empty()}, monitor);
  const auto row = [](const auto& r) { return row_of(r); };
  const ResultTable costs = table_of(run.costs, row), states = table_of(run.states, row), holes = table_of(run.holes, row);
  double failures = 0.0;
  for (const ScanCostRow& cost : run.costs) failures += cost.failures;
  Json result;
  result["scan"] = to_json(costs);
  result["states"] = to_json(states);
  if (!run.holes.empty()) result["holes"] = to_json(holes);
  result["failures"] = failures;
  result["outcome"] = run.interrupted ? "interrupted" : failures > 0.0 ? "limit of trials" : "done";
  result["seconds"] = run.seconds;
  status = status_of_run(!(failures > 0.0), run.interrupted);
  write_table(folder, "scan.csv", costs);
  write_table(folder, "states.csv", states);
  write_table(folder, "holes.csv", holes);
  write_table(folder, "errors.csv", table_of(run.errors, row));
  write_table(folder, "map.csv", table_of(run.map, row));
  write_result(folder, "insert", options.resolved(), result, status);
  return result;
}

}  // namespace lanescape::program
