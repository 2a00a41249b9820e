#include <fmt/format.h>

#include <chrono>

#include "core/error.hpp"
#include "insert_runs.hpp"
#include "insertion/removal.hpp"
#include "interaction/pair/probe_field.hpp"
#include "io/extended_xyz.hpp"
#include "plot.hpp"

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
    descents{"descent", "method descent"}, screened_starts{"screened", "method screened"};

RunKinds kinds_of(const InsertState& state) {
  const RunKind mode = state.scan      ? RunKind{scans, "with --scan"}
                       : state.densify ? RunKind{growth, "with --densify"}
                                       : RunKind{into_file, "without --scan and --densify"};
  // Searches besides those of a scan's own combinations.
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

double mean_excess_energy(const PairModel& model, const Configuration& fluid, Isa isa) {
  const ParticleLayout layout = ParticleLayout::in_space_order(fluid, model.species.size());
  return PairInteraction(model, fluid.box, layout, kernel_table(isa)).energy(layout.to_slots(fluid.positions)) /
         static_cast<double>(fluid.size());
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

struct Exchange {
  Json insertions = Json::array(), removals = Json::array();
  std::uint64_t evaluations = 0, failures = 0;
  bool interrupted = false;
};

void insert_into(Configuration& fluid, const InsertState& state, const PairModel& model, const InsertionOptions& options, Isa isa,
                 RunMonitor& monitor, Exchange& exchange) {
  constexpr std::uint64_t at_once = 64;
  const int species = state.setup.species_index(model);
  const double mass = model.species[static_cast<std::size_t>(species)].mass;
  ProbeField field(model, fluid, species, kernel_table(isa));
  InsertionHistory history;
  const CounterRandom random(options.seed, RandomStream::insertion);
  for (std::uint64_t done = 0; done < state.count && !exchange.interrupted;) {
    const std::uint64_t wanted = std::min(at_once, state.count - done);
    for (const Insertion& insertion : insert_particles(field, options, wanted, history, state.common.threads)) {
      exchange.evaluations += insertion.evaluations;
      if (!insertion.found) {
        ++exchange.failures;
        continue;
      }
      Json json = to_json(insertion);
      if (state.temperature) json["velocity"] = maxwellian_velocity(random, exchange.insertions.size(), *state.temperature, mass);
      exchange.insertions.push_back(std::move(json));
      fluid.species.push_back(species);
      fluid.positions.insert(fluid.positions.end(), insertion.position.begin(), insertion.position.end());
    }
    done += wanted;
    monitor.progress("insertion", static_cast<double>(done), static_cast<double>(state.count));
    exchange.interrupted = monitor.stop_requested() && done < state.count;
  }
}

void remove_from(Configuration& fluid, const InsertState& state, const PairModel& model, const InsertionOptions& options, Isa isa,
                 Exchange& exchange) {
  const RemovalRule rule = parse_removal_rule(state.removal);
  const CounterRandom random(options.seed, RandomStream::insertion);
  for (std::uint64_t k = 0; k < state.remove && !exchange.interrupted; ++k) {
    const auto removal =
        choose_removal(model, fluid, state.setup.species_index(model), rule, options.region, options.target, random, k, isa);
    if (!removal) {
      exchange.failures += state.remove - k;
      return;
    }
    const auto at = static_cast<std::ptrdiff_t>(removal->particle);
    exchange.removals.push_back({{"position", fluid.position(removal->particle)}, {"energy", removal->energy}});
    fluid.species.erase(fluid.species.begin() + at);
    fluid.positions.erase(fluid.positions.begin() + 3 * at, fluid.positions.begin() + 3 * at + 3);
  }
}

Json run_exchange(InsertState& state, Options& options, const PairModel& model, Isa isa, int& status) {
  if (state.file.empty()) throw_bad_input("FILE is needed: the fluid to insert into; without one, --scan or --densify");
  Configuration fluid = read_first_frame(state.file, model);
  if (fluid.size() == 0)
    throw_bad_input(fmt::format("{}: insertion into an empty fluid is not allowed: at least one particle is needed", state.file));
  if (state.temperature && (!(*state.temperature > 0.0) || !std::isfinite(*state.temperature)))
    throw_bad_input(fmt::format("--temperature: {} is not allowed: it must be finite and above 0", *state.temperature));
  parse_removal_rule(state.removal);
  InsertionOptions with = state.setup.resolve(state.common.seed);
  const std::optional<double> number = state.setup.number({"mean"});
  with.target = number ? *number : mean_excess_energy(model, fluid, isa);
  with.check(fluid.box);
  // Refuses what the box and the model do not allow before there is a folder.
  ProbeField(model, {fluid.box, {}, {}}, state.setup.species_index(model), kernel_table(isa));
  OutputFolder folder = open_folder(state.common);
  folder.write_run_file("insert", options.resolved());
  TerminalMonitor monitor(state.common.quiet);
  const auto start = std::chrono::steady_clock::now();
  Exchange exchange;
  insert_into(fluid, state, model, with, isa, monitor, exchange);
  remove_from(fluid, state, model, with, isa, exchange);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  Json result;
  result["insertions"] = exchange.insertions;
  if (state.remove > 0) result["removals"] = exchange.removals;
  result["mean_evaluations"] =
      exchange.insertions.empty()
          ? Json()
          : Json(static_cast<double>(exchange.evaluations) / static_cast<double>(exchange.insertions.size()));
  result["failures"] = exchange.failures;
  result["seconds"] = seconds.count();
  result["target"] = with.target;
  result["measure"] = to_string(with.measure_in_force());
  result["method"] = to_string(with.method);
  result["outcome"] = exchange.interrupted ? "interrupted" : exchange.failures > 0 ? "limit of trials" : "done";
  result["particles"] = fluid.size();
  status = exchange.interrupted || exchange.failures > 0 ? goal_not_reached : done;
  if (!exchange.insertions.empty() || !exchange.removals.empty())
    folder.write("inserted.extxyz", [&](std::ostream& out) { write_frame(out, fluid, model, {}); });
  write_result(folder, "insert", options.resolved(), result);
  return result;
}

Json run_insert(InsertState& state, Options& options, int& status) {
  state.common.check();
  const Isa isa = state.common.resolve_isa();
  const PairModel model = state.system.resolve_pair_model("insert");
  if (model.form->has_diameters)
    throw_bad_input(fmt::format("insert: model {} is not allowed: its particles have diameters of their own", model.name));
  if (state.scan && state.densify) throw_bad_input("--scan and --densify are not allowed together");
  options.settle(joined({state.system.kinds(model), kinds_of(state)}));
  Json result = state.scan      ? run_scan(state, options, model, isa, status)
                : state.densify ? run_growth(state, options, model, isa, status)
                                : run_exchange(state, options, model, isa, status);
  if (state.plot) draw_plots(state.common.out.empty() ? state.common.resume : state.common.out, state.common);
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
  options.end_group();
}

}  // namespace

Subcommand add_insert(CLI::App& app) {
  CLI::App* sub = app.add_subcommand("insert", "Insert particles where their energy has a given value (USHER), and remove some");
  const auto options = std::make_shared<Options>(*sub);
  const auto state = std::make_shared<InsertState>();
  options->add_positional("FILE", state->file, "extended XYZ; of several frames the first is used").only_for({into_file, growth});
  options->add("--count", state->count, "particles to insert; of --scan, places per configuration and combination")
      .only_for({into_file, scans});
  add_search_options(*options, *state);
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
  return {sub, [=](int& status) { return run_insert(*state, *options, status); }};
}

}  // namespace lanescape::program
