#include <fmt/format.h>

#include "io/extended_xyz.hpp"
#include "plot.hpp"
#include "result_table.hpp"
#include "run/slab_run.hpp"

namespace lanescape::program {
namespace {

struct SlabState {
  SlabState() { system.model = "ucg"; }

  CommonOptions common;
  SystemOptions system;
  SlabOptions slab;
  bool plot = false;
};

ResultTable table_of(const SlabProfiles& profiles) {
  ResultTable table;
  for (std::size_t bin = 0; bin < profiles.z.size(); ++bin) {
    ResultRow& row = table.emplace_back();
    row = {{"z", profiles.z[bin]}, {"density", profiles.density[bin]}, {"local_density", profiles.local_density[bin]}};
    for (std::size_t a = 0; a < profiles.probability.size(); ++a)
      row.emplace_back(fmt::format("probability_{}", a), profiles.probability[a][bin]);
    row.emplace_back("sites", profiles.sites[bin]);
  }
  return table;
}

Json run_slab_command(SlabState& state, Options& options, int& status) {
  state.common.check();
  const Isa isa = state.common.resolve_isa();
  const StateMixtureModel model = state.system.resolve_state_mixture("slab");
  options.settle(joined({state.system.kinds(model, true), {state.common.folder_kind()}}));
  state.slab.seed = state.common.seed;
  state.slab.threads = state.common.threads;
  state.slab.check_against(model);
  if (state.plot) check_plots();
  OutputFolder folder = open_folder(state.common);
  folder.write_run_file("slab", options.resolved());
  TerminalMonitor monitor(state.common.quiet);
  const SlabRunResult run = run_slab(model, state.slab, isa, {folder.checkpoints(), !state.common.resume.empty()}, monitor);
  const ResultTable profiles = table_of(run.profiles);
  Json result;
  result["profiles"] = to_json(profiles);
  result["samples"] = run.profiles.samples;
  result["temperature"] = run.temperature;
  result["temperature_convention"] = "3N";
  result["outcome"] = run.interrupted ? "interrupted" : "done";
  result["seconds"] = run.seconds;
  result["model"] = model.name;
  result["particles"] = state.slab.particles;
  result["isa"] = to_string(isa);
  status = status_of_run(true, run.interrupted);
  write_table(folder, "profiles.csv", profiles);
  folder.write("last.extxyz", [&](std::ostream& out) {
    write_frame(out, run.last, model, {{"temperature", fmt::format("{}", state.slab.temperature)}});
  });
  write_result(folder, "slab", options.resolved(), result, status);
  if (state.plot) draw_plots(folder.path(), status);
  return result;
}

}  // namespace

Subcommand add_slab(CLI::App& app) {
  const auto options =
      std::make_shared<Options>(app, "slab", "Profiles of a liquid slab and its vapour, sites in states by Langevin dynamics");
  const auto state = std::make_shared<SlabState>();
  SlabOptions& slab = state->slab;
  options->add("--particles", slab.particles, "sites");
  options->add("--width", slab.width, "of the box along x and y [sigma]");
  options->add("--length", slab.length, "of the box along z [sigma]");
  options->add("--start-density", slab.start_density, "of the lattice in the middle; a lattice much thinner than the liquid tears");
  options->add("--temperature", slab.temperature, "[epsilon]");
  options->add("--friction", slab.friction, "of the thermostat");
  options->add("--time-step", slab.time_step, "of the dynamics");
  options->add("--equilibration-steps", slab.equilibration_steps, "before the first sample");
  options->add("--sampling-steps", slab.sampling_steps, "during which samples are taken");
  options->add("--interval", slab.interval, "steps between samples");
  options->add("--bins", slab.bins, "along z");
  options->add_flag("--plot", state->plot, "draw the profiles (needs --out)").only_for({runs_with_a_folder});
  state->system.add_to(*options);
  state->common.add_to(*options);
  return {&options->app(), [=](int& status) { return run_slab_command(*state, *options, status); }};
}

}  // namespace lanescape::program
