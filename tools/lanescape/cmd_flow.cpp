#include <fmt/format.h>

#include "flow_options.hpp"
#include "io/extended_xyz.hpp"
#include "plot.hpp"
#include "result_table.hpp"

namespace lanescape::program {
namespace {

ResultTable profile_table(const FlowResult& run) {
  ResultTable table;
  for (const FlowRow& row : run.rows)
    for (std::size_t k = 0; k < row.profile.x.size(); ++k) {
      const FlowProfile& means = row.profile;
      table.push_back({{"time", row.time},
                       {"x", means.x[k]},
                       {"density", means.density[k]},
                       {"velocity", number_or_null(means.velocity[k][0])},
                       {"velocity_y", number_or_null(means.velocity[k][1])},
                       {"velocity_z", number_or_null(means.velocity[k][2])},
                       {"temperature", number_or_null(means.temperature[k])},
                       {"energy", number_or_null(means.energy[k])},
                       {"mass_flux", means.mass_flux[k]},
                       {"pressure", number_or_null(means.pressure[k])}});
    }
  return table;
}

ResultRow balance_row(const FlowRow& row) {
  const FlowBalance& b = row.balance;
  ResultRow out = {{"time", row.time},
                   {"particles", b.now.particles},
                   {"particles_passed", b.passed.particles},
                   {"energy", b.now.energy},
                   {"energy_passed", b.passed.energy},
                   {"energy_error", b.energy_error()},
                   {"momentum", b.now.momentum[0]},
                   {"momentum_passed", b.passed.momentum[0]},
                   {"momentum_error", b.now.momentum[0] - b.start.momentum[0] - b.passed.momentum[0]}};
  for (std::size_t face = 0; face < 2; ++face) {
    const std::string at = face == 0 ? "inlet_" : "outlet_";
    const FaceExchange::Counts& counts = b.faces[face];
    out.emplace_back(at + "left", counts.left);
    out.emplace_back(at + "put_in", counts.put_in);
    out.emplace_back(at + "taken_out", counts.taken_out);
    out.emplace_back(at + "pressure", row.pressure[face]);
    out.emplace_back(at + "momentum_flux", row.momentum_flux[face]);
  }
  return out;
}

ResultTable insertion_table(const FlowResult& run) {
  ResultTable table;
  for (std::size_t face = 0; face < 2; ++face)
    for (const FlowInsertion& one : run.insertions[face])
      table.push_back({{"face", face == 0 ? "inlet" : "outlet"},
                       {"time", one.time},
                       {"density", one.density},
                       {"evaluations", one.evaluations},
                       {"energy", one.energy},
                       {"distance", one.distance}});
  return table;
}

void add_cells(ResultTable& table, double time, const std::vector<OutsideCell>& cells) {
  for (const OutsideCell& cell : cells)
    table.push_back(
        {{"time", time}, {"x", cell.x}, {"density", cell.density}, {"velocity", cell.velocity}, {"temperature", cell.temperature}});
}

// The continuum beside the slab, and what the solver alone does in the same time.
void write_continuum(OutputFolder& folder, const FlowResult& run, const ContinuumOptions& options) {
  ResultTable coupled, alone;
  CompressibleSolver solver = solver_alone(options);
  const FlowState reservoir = options.reservoir();
  double now = 0.0;
  for (const FlowRow& row : run.rows) {
    if (row.time <= 0.0) continue;
    add_cells(coupled, row.time, row.outside);
    solver.advance(row.time - now, {reservoir, reservoir});
    now = row.time;
    add_cells(alone, row.time, cells_of(solver));
  }
  write_table(folder, "continuum.csv", coupled);
  write_table(folder, "alone.csv", alone);
}

Json to_json(const FlowMean& mean) {
  const auto number = [](const std::optional<double>& value) { return value ? number_or_null(*value) : Json(); };
  return {{"mean", number_or_null(mean.mean.value)},
          {"error", number(mean.mean.error)},
          {"slope", number_or_null(mean.slope.value)},
          {"slope_error", number(mean.slope.error)}};
}

Json result_of(const FlowResult& run, const FlowSetup& setup, const PairModel& model) {
  Json result;
  result["outcome"] = run.interrupted ? "interrupted" : to_string(run.outcome);
  for (const auto& [name, mean] :
       {std::pair("density", &run.density), {"velocity", &run.velocity}, {"temperature", &run.temperature}})
    result[name] = to_json(*mean);
  result["pressure"] = run.pressure;
  if (!run.rows.empty()) {
    Json balance;
    for (const auto& [name, value] : balance_row(run.rows.back())) balance[name] = value;
    result["balance"] = balance;
  }
  double evaluations = 0.0, inserted = 0.0;
  for (const auto& at_face : run.insertions)
    for (const FlowInsertion& one : at_face) {
      evaluations += static_cast<double>(one.evaluations);
      inserted += 1.0;
    }
  result["insertions"] = inserted;
  result["mean_evaluations"] = inserted > 0.0 ? Json(evaluations / inserted) : Json();
  result["particles"] = run.last.configuration.size();
  result["rows"] = run.rows.size();
  result["outside"] = setup.outside;
  result["model"] = model.name;
  result["isa"] = setup.common.isa;
  result["seconds"] = run.seconds;
  return result;
}

void write_files(OutputFolder& folder, const FlowResult& run, const PairModel& model) {
  write_table(folder, "flow.csv", profile_table(run));
  write_table(folder, "balance.csv", table_of(run.rows, balance_row));
  write_table(folder, "insertions.csv", insertion_table(run));
  folder.write("last.extxyz", [&](std::ostream& out) { write_frame(out, run.last.configuration, model, {}); });
}

Json run_flow_command(FlowSetup& setup, Options& options, int& status) {
  setup.common.check();
  const Isa isa = setup.common.resolve_isa();
  const PairModel model = setup.system.resolve_pair_model("flow");
  options.settle(setup.kinds(model));
  const Configuration start = setup.start(model);
  const FlowOptions with = setup.resolve_flow(model, start, isa);
  const std::optional<ContinuumOptions> outer = setup.resolve_continuum(model, with, start);
  if (setup.plot) check_plots();
  OutputFolder folder = open_folder(setup.common);
  folder.write_run_file("flow", options.resolved());
  TerminalMonitor monitor(setup.common.quiet);
  std::optional<ContinuumOutside> continuum;
  if (outer) continuum.emplace(*outer);
  const FlowResult run = run_flow(model, start, with, continuum ? &*continuum : nullptr,
                                  {folder.checkpoints(), !setup.common.resume.empty()}, monitor);
  Json result = result_of(run, setup, model);
  status = status_of_run(run.outcome == FlowOutcome::followed, run.interrupted);
  write_files(folder, run, model);
  if (outer) write_continuum(folder, run, *outer);
  write_result(folder, "flow", options.resolved(), result, status);
  if (setup.plot) draw_plots(folder.path(), status);
  return result;
}

}  // namespace

Subcommand add_flow(CLI::App& app) {
  const auto options =
      std::make_shared<Options>(app, "flow", "Flow through a slab with open faces: insertion at one end, extraction at the other");
  const auto setup = std::make_shared<FlowSetup>();
  setup->add_to(*options);
  return {&options->app(), [=](int& status) { return run_flow_command(*setup, *options, status); }};
}

}  // namespace lanescape::program
