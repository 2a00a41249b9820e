#include <fmt/format.h>

#include "core/error.hpp"
#include "insert_runs.hpp"
#include "io/extended_xyz.hpp"
#include "result_table.hpp"
#include "run/densification_run.hpp"

namespace lanescape::program {

namespace {

DensificationOptions growth_options(const InsertState& state, const PairModel& model) {
  DensificationOptions with;
  with.temperature = state.temperature.value_or(with.temperature);
  with.equilibration_steps = state.equilibration_steps;
  with.final_density = *state.densify;
  with.rate = state.rate;
  with.time_step = state.time_step;
  with.rows = state.rows;
  with.species = state.setup.species_index(model);
  with.threads = state.common.threads;
  with.insertion = state.setup.resolve(state.common.seed);
  return with;
}

FluidState growth_start(const InsertState& state, const PairModel& model, double temperature) {
  FluidState start = fluid_on_lattice(model, state.particles, state.density.value_or(0.4), temperature, state.common.seed);
  if (!state.file.empty()) {
    start.configuration = read_first_frame(state.file, model);
    start.velocities = fluid_on_lattice(model, start.configuration.size(), 0.1, temperature, state.common.seed).velocities;
  }
  check_cutoff(model, start.configuration.box);
  return start;
}

// Means over density steps are undefined in a row without any.
ResultRow row_of(const DensificationRow& r) {
  return {{"time", number_or_null(r.time)},
          {"density", number_or_null(r.density)},
          {"temperature", number_or_null(r.temperature)},
          {"pressure", number_or_null(r.pressure)},
          {"excess_energy", number_or_null(r.excess_energy)},
          {"energy", number_or_null(r.energy)},
          {"inserted_energy", r.inserted_energy},
          {"evaluations", r.evaluations},
          {"drift", r.drift}};
}

}  // namespace

Json run_growth(InsertState& state, const Options& options, const PairModel& model, Isa isa, int& status) {
  const DensificationOptions with = growth_options(state, model);
  const FluidState start = growth_start(state, model, with.temperature);
  with.check(start);
  OutputFolder folder = open_folder(state.common);
  folder.write_run_file("insert", options.resolved());
  TerminalMonitor monitor(state.common.quiet);
  const DensificationResult run =
      run_densification(model, start, with, isa, {folder.checkpoints(), !state.common.resume.empty()}, monitor);
  const ResultTable rows = table_of(run.rows, row_of);
  Json result;
  result["densification"] = to_json(rows);
  result["inserted"] = run.inserted;
  result["failures"] = run.failures;
  result["particles"] = run.final_state.configuration.size();
  result["outcome"] = run.interrupted ? "interrupted" : run.failures > 0 ? "limit of trials" : "done";
  result["seconds"] = run.seconds;
  status = status_of_run(run.failures == 0, run.interrupted);
  write_table(folder, "densification.csv", rows);
  folder.write("inserted.extxyz", [&](std::ostream& out) { write_frame(out, run.final_state.configuration, model, {}); });
  write_result(folder, "insert", options.resolved(), result, status);
  return result;
}

}  // namespace lanescape::program
