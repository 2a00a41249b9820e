#include <fmt/format.h>

#include <utility>

#include "core/error.hpp"
#include "insert_runs.hpp"
#include "io/extended_xyz.hpp"
#include "plot.hpp"
#include "run/insertion_run.hpp"

namespace lanescape::program {
namespace {

// Modes.
constexpr Scope into_file{"mode", "insertions into FILE without --scan and --densify"}, scans{"mode", "--scan"},
    growth{"mode", "--densify"};
// Parts of a mode.
constexpr Scope made_fluids{"fluid", "fluids that are made, without FILE"}, removals{"removal", "--remove"},
    holes{"holes", "--holes"}, regions{"region", "--region"},
    searches_by_method{"search", "FILE, --densify and --holes; --methods is for scans"},
    searches_by_tolerance{"tolerance", "FILE, --densify, --holes, and scans without --tolerances"},
    own_diameters{"diameters", "models whose particles have diameters, such as polydisperse"},
    descents{"descent", "method descent"}, screened_starts{"screened", "method screened"};

RunKinds kinds_of(const InsertState& state) {
  const RunKind mode = state.scan      ? RunKind{scans, "with --scan"}
                       : state.densify ? RunKind{growth, "with --densify"}
                                       : RunKind{into_file, "without --scan and --densify"};
  // Whether there are searches besides those of a scan's combinations.
  const bool others = !state.scan || state.holes > 0 || state.traced_searches > 0;
  const auto uses = [&](const char* method) {
    bool used = others && state.setup.method == method;
    if (state.scan)
      for (const std::string& name : list_of(state.methods, "--methods")) used = used || name == method;
    return used;
  };
  return {mode,
          state.common.folder_kind(),
          kind_if(state.file.empty(), made_fluids, "without FILE", "with FILE"),
          kind_if(state.remove > 0, removals, "with --remove", "without --remove"),
          kind_if(state.holes > 0, holes, "with --holes", "without --holes"),
          kind_if(!state.setup.region.empty(), regions, "with --region", "without --region"),
          kind_if(others, searches_by_method, "without --scan", "with --scan"),
          kind_if(others || state.tolerances.empty(), searches_by_tolerance, "without --tolerances", "with --tolerances"),
          kind_if(uses("descent"), descents, "with method descent", "without method descent"),
          kind_if(uses("screened"), screened_starts, "with method screened", "without method screened")};
}

Json to_json(const Insertion& insertion) {
  Json json;
  json["position"] = insertion.position;
  json["energy"] = insertion.energy;
  json["error"] = insertion.error;
  json["evaluations"] = insertion.evaluations;
  json["trials"] = insertion.trials;
  json["distance"] = insertion.distance;
  if (insertion.candidates > 0) json["candidates"] = insertion.candidates;
  return json;
}

InsertionRunOptions run_options(const InsertState& state, const PairModel& model) {
  InsertionRunOptions options;
  options.insertion = state.setup.resolve(state.common.seed);
  const std::optional<double> number = state.setup.number({"mean"});
  options.mean_target = !number;
  options.insertion.target = number.value_or(0.0);
  options.count = state.count;
  options.removals = state.remove;
  options.removal = parse_removal_rule(state.removal);
  options.species = state.setup.species_index(model);
  options.diameter = state.diameter;
  options.temperature = state.temperature;
  options.threads = state.common.threads;
  return options;
}

Json to_json(const InsertionRunResult& run, const InsertionRunOptions& options) {
  InsertionOptions with = options.insertion;
  with.target = run.target;
  Json json;
  json["insertions"] = Json::array();
  for (std::size_t k = 0; k < run.insertions.size(); ++k) {
    json["insertions"].push_back(to_json(run.insertions[k]));
    if (!run.velocities.empty()) json["insertions"].back()["velocity"] = run.velocities[k];
  }
  if (options.removals > 0) json["removals"] = Json::array();
  for (const auto& removed : run.removals) json["removals"].push_back({{"position", removed.position}, {"energy", removed.energy}});
  const double inserted = static_cast<double>(run.insertions.size());
  json["mean_evaluations"] = run.insertions.empty() ? Json() : Json(static_cast<double>(run.evaluations) / inserted);
  json["failures"] = run.failures;
  json["seconds"] = run.seconds;
  json["target"] = run.target;
  json["measure"] = to_string(with.measure_in_force());
  json["method"] = to_string(with.method);
  json["outcome"] = run.interrupted ? "interrupted" : run.failures > 0 ? "limit of trials" : "done";
  json["particles"] = run.fluid.size();
  return json;
}

Json run_into_file(InsertState& state, Options& options, const PairModel& model, Isa isa, int& status) {
  if (state.file.empty()) throw_bad_input("FILE is needed: the fluid to insert into; without one, --scan or --densify");
  Configuration fluid = read_first_frame(state.file, model, OpenAxes::allowed);
  const InsertionRunOptions with = run_options(state, model);
  with.check(model, fluid);
  OutputFolder folder = open_folder(state.common);
  folder.write_run_file("insert", options.resolved());
  TerminalMonitor monitor(state.common.quiet);
  const InsertionRunResult run = run_insertion(model, std::move(fluid), with, isa, monitor);
  Json result = to_json(run, with);
  status = status_of_run(run.failures == 0, run.interrupted);
  if (!run.insertions.empty() || !run.removals.empty())
    folder.write("inserted.extxyz", [&](std::ostream& out) { write_frame(out, run.fluid, model, {}); });
  write_result(folder, "insert", options.resolved(), result, status);
  return result;
}

Json run_insert(InsertState& state, Options& options, int& status) {
  state.common.check();
  const Isa isa = state.common.resolve_isa();
  const PairModel model = state.system.resolve_pair_model("insert");
  if (model.form->has_diameters && (state.scan || state.densify))
    throw_bad_input(
        fmt::format("{} is not allowed with model {}: its particles have diameters; only insertion into FILE is allowed",
                    state.scan ? "--scan" : "--densify", model.name));
  if (state.scan && state.densify) throw_bad_input("--scan and --densify are not allowed together");
  const std::string with_model = fmt::format("with model {}", model.name);
  options.settle(joined({state.system.kinds(model, state.file.empty()),
                         kinds_of(state),
                         {kind_if(model.form->has_diameters, own_diameters, with_model, with_model)}}));
  if (state.plot) check_plots();
  Json result = state.scan      ? run_scan(state, options, model, isa, status)
                : state.densify ? run_growth(state, options, model, isa, status)
                                : run_into_file(state, options, model, isa, status);
  if (state.plot) draw_plots(state.common.out.empty() ? state.common.resume : state.common.out, status);
  return result;
}

void add_search_options(Options& options, InsertState& state) {
  state.setup.add_to(options);
  options.at("--energy").only_for({into_file, scans});
  options.at("--tolerance").only_for({searches_by_tolerance});
  options.at("--method").only_for({searches_by_method});
  options.at("--traverse-step").only_for({descents});
  options.at("--clear-energy").only_for({screened_starts});
  options.at("--wall").only_for({regions});
}

void add_growth_options(Options& options, InsertState& state) {
  options.add("--densify", state.densify,
              "up to this density at constant energy per particle, by molecular dynamics and insertion");
  options.begin_group({growth});
  options.add("--rate", state.rate, "of --densify: density per time");
  options.add("--rows", state.rows, "of --densify: means over so many steps of density");
  options.add("--density", state.density, "of --densify without FILE: where it begins [0.4]").only_for({made_fluids});
  options.end_group();
}

void add_scan_options(Options& options, InsertState& state) {
  options.add_flag("--scan", state.scan, "what insertion costs at several densities and temperatures");
  options.begin_group({scans});
  options.add("--states", state.states, "of --scan: density:temperature,...");
  options.add("--methods", state.methods, "of --scan: words of --method between commas");
  options.add("--tolerances", state.tolerances, "of --scan: numbers between commas [--tolerance]");
  options.add("--largest-steps", state.largest_steps, "of --scan: numbers between commas, or default");
  options.add("--configurations", state.configurations, "of --scan, per state");
  options.add("--between-steps", state.between_steps, "of --scan, between configurations");
  options.add("--widom-probes", state.widom_probes, "of --scan, per configuration, for the chemical potential");
  options.add("--holes", state.holes, "of --scan, per configuration: regions of low energy to measure");
  options.add("--iso-energies", state.iso_energies, "of --holes: energies at their surface").only_for({holes});
  options.add("--traced-searches", state.traced_searches, "of --scan, per configuration: how errors shrink, for errors.csv")
      .only_for({runs_with_a_folder});
  options.add("--map-points", state.map_points, "of --scan, per edge: a map of the energy in the plane x = 0 of each state, for map.csv")
      .only_for({runs_with_a_folder});
  options.end_group();
}

}  // namespace

Subcommand add_insert(CLI::App& app) {
  const auto options =
      std::make_shared<Options>(app, "insert", "Insert particles where their energy has a given value (USHER), and remove some");
  const auto state = std::make_shared<InsertState>();
  options->add_positional("FILE", state->file, "extended XYZ; of several frames the first is used").only_for({into_file, growth});
  options->add("--count", state->count, "particles to insert; of --scan, places per configuration and combination")
      .only_for({into_file, scans});
  add_search_options(*options, *state);
  options->add("--diameter", state->diameter, "of inserted particles, in models that give each its own [sigma]")
      .only_for({into_file})
      .only_for({own_diameters});
  options->add("--remove", state->remove, "particles of the species to take out of the region afterwards").only_for({into_file});
  options->add("--removal", state->removal, "random, or least-disturbance: whose energy is nearest to --energy")
      .only_for({into_file})
      .only_for({removals});
  options->add("--temperature", state->temperature, "gives inserted particles Maxwellian velocities; of --densify [2.5]")
      .only_for({into_file, growth});
  add_growth_options(*options, *state);
  add_scan_options(*options, *state);
  options->add("--particles", state->particles, "of --scan and --densify without FILE")
      .only_for({scans, growth})
      .only_for({made_fluids});
  options->add("--equilibration-steps", state->equilibration_steps, "of --scan and --densify").only_for({scans, growth});
  options->add("--time-step", state->time_step, "of --scan and --densify").only_for({scans, growth});
  options->add_flag("--plot", state->plot, "draw the figures of --scan or --densify (needs --out)")
      .only_for({scans, growth})
      .only_for({runs_with_a_folder});
  state->system.add_to(*options);
  options->at("--precision").refused("with insert: probes are in double precision");
  state->common.add_to(*options);
  return {&options->app(), [=](int& status) { return run_insert(*state, *options, status); }};
}

}  // namespace lanescape::program
