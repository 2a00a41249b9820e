#include <fmt/format.h>
#include <fmt/ostream.h>

#include "core/error.hpp"
#include "insert_runs.hpp"
#include "io/extended_xyz.hpp"
#include "run/densification_run.hpp"

namespace lanescape::program {

Json run_growth(InsertState& state, const Options& options, const PairModel& model, Isa isa, int& status) {
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
  FluidState start = fluid_on_lattice(model, state.particles, state.density.value_or(0.4), with.temperature, state.common.seed);
  if (!state.file.empty()) {
    start.configuration = read_first_frame(state.file, model);
    const FluidState velocities = fluid_on_lattice(model, start.configuration.size(), 0.1, with.temperature, state.common.seed);
    start.velocities = velocities.velocities;
  }
  check_cutoff(model, start.configuration.box);
  with.check(start);
  OutputFolder folder = open_folder(state.common);
  folder.write_run_file("insert", options.resolved());
  TerminalMonitor monitor(state.common.quiet);
  const DensificationResult run =
      run_densification(model, start, with, isa, {folder.checkpoints(), !state.common.resume.empty()}, monitor);
  Json result;
  result["densification"] = Json::array();
  for (const DensificationRow& row : run.rows)
    result["densification"].push_back({{"time", row.time},
                                       {"density", row.density},
                                       {"temperature", row.temperature},
                                       {"pressure", row.pressure},
                                       {"excess_energy", row.excess_energy},
                                       {"energy", row.energy},
                                       {"inserted_energy", row.inserted_energy},
                                       {"evaluations", row.evaluations},
                                       {"drift", row.drift}});
  result["inserted"] = run.inserted;
  result["failures"] = run.failures;
  result["particles"] = run.final_state.configuration.size();
  result["outcome"] = run.interrupted ? "interrupted" : run.failures > 0 ? "limit of trials" : "done";
  result["seconds"] = run.seconds;
  status = run.interrupted || run.failures > 0 ? goal_not_reached : done;
  if (folder.exists()) {
    folder.write("densification.csv", [&](std::ostream& out) {
      out << "time,density,temperature,pressure,excess_energy,energy,inserted_energy,evaluations,drift\n";
      for (const DensificationRow& r : run.rows)
        fmt::print(out, "{},{},{},{},{},{},{},{},{}\n", r.time, r.density, r.temperature, r.pressure, r.excess_energy, r.energy,
                   r.inserted_energy, r.evaluations, r.drift);
    });
    folder.write("inserted.extxyz", [&](std::ostream& out) { write_frame(out, run.final_state.configuration, model, {}); });
  }
  write_result(folder, "insert", options.resolved(), result);
  return result;
}

}  // namespace lanescape::program
