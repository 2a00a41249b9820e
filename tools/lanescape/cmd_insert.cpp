#include <fmt/format.h>
#include <fmt/ostream.h>

#include <chrono>

#include "configuration/lattice.hpp"
#include "core/error.hpp"
#include "insert_options.hpp"
#include "insertion/removal.hpp"
#include "interaction/probe_field.hpp"
#include "io/extended_xyz.hpp"
#include "plot.hpp"
#include "run/densification_run.hpp"
#include "run/insertion_scan.hpp"

namespace lanescape::program {
namespace {

struct InsertState {
  CommonOptions common;
  SystemOptions system;
  InsertionSetup setup;
  std::string file;
  std::uint64_t count = 1, remove = 0;
  std::string removal = "random";
  std::optional<double> temperature, density;
  std::uint64_t particles = 1000, equilibration_steps = 10'000;
  double time_step = 0.002;
  std::optional<double> densify;
  double rate = 0.005;
  std::uint64_t rows = 40;
  bool scan = false, plot = false;
  std::string states = "0.4:2.5,0.5:2.5,0.6:2.5,0.7:2.5,0.8:2.5", methods = "usher", tolerances, largest_steps = "default",
              iso_energies = "0";
  std::uint64_t configurations = 5, between_steps = 2000, widom_probes = 0, holes = 0, traced_searches = 0;
};

double mean_excess_energy(const LennardJonesModel& model, const Configuration& fluid, Isa isa) {
  const ParticleLayout layout = ParticleLayout::in_space_order(fluid, model.species.size());
  return LennardJones(model, fluid.box, layout, kernel_table(isa)).energy(layout.to_slots(fluid.positions)) /
         static_cast<double>(fluid.size());
}

// ---- Single insertions and removals ----

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

void insert_into(Configuration& fluid, const InsertState& state, const LennardJonesModel& model, const InsertionOptions& options,
                 Isa isa, RunMonitor& monitor, Exchange& exchange) {
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

void remove_from(Configuration& fluid, const InsertState& state, const LennardJonesModel& model, const InsertionOptions& options,
                 Isa isa, Exchange& exchange) {
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

Json run_exchange(InsertState& state, const Options& options, const LennardJonesModel& model, Isa isa, int& status) {
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

// ---- A growing density ----

Json run_growth(InsertState& state, const Options& options, const LennardJonesModel& model, Isa isa, int& status) {
  const double temperature = state.temperature.value_or(2.5);
  if (!(temperature > 0.0) || !std::isfinite(temperature))
    throw_bad_input(fmt::format("--temperature: {} is not allowed: it must be finite and above 0", temperature));
  if (!state.file.empty() && state.density) throw_bad_input("--density is not allowed with FILE, which has its own");
  DensificationOptions with;
  with.final_density = *state.densify;
  with.rate = state.rate;
  with.time_step = state.time_step;
  with.rows = state.rows;
  with.species = state.setup.species_index(model);
  with.threads = state.common.threads;
  with.insertion = state.setup.resolve(state.common.seed);
  if (state.setup.number({"mean"}))
    throw_bad_input("--energy: a number is not allowed with --densify: places have the mean excess energy per particle");
  FluidState start = fluid_on_lattice(model, state.particles, state.density.value_or(0.4), temperature, state.common.seed);
  if (!state.file.empty()) {
    start.configuration = read_first_frame(state.file, model);
    const FluidState velocities = fluid_on_lattice(model, start.configuration.size(), 0.1, temperature, state.common.seed);
    start.velocities = velocities.velocities;
  }
  check_cutoff(model, start.configuration.box);
  with.check(start, temperature);
  OutputFolder folder = open_folder(state.common);
  folder.write_run_file("insert", options.resolved());
  TerminalMonitor monitor(state.common.quiet);
  {
    MovingFluid fluid(model, start, state.time_step, isa, state.common.threads);
    equilibrate(fluid, temperature, state.equilibration_steps);
    start = fluid.state();
  }
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

// ---- A scan ----

InsertionScanOptions scan_options(const InsertState& state, const LennardJonesModel& model) {
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
  with.seed = state.common.seed;
  with.threads = state.common.threads;
  with.check(model);
  return with;
}

// Names and numbers of one row, for JSON and for the columns of a file alike.
using Row = std::vector<std::pair<const char*, Json>>;

Row row_of(const ScanCostRow& r) {
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

Row row_of(const ScanStateRow& r) {
  return {{"density", r.density},
          {"temperature", r.temperature},
          {"measured_temperature", r.measured_temperature},
          {"excess_energy", r.excess_energy},
          {"pressure", r.pressure},
          {"chemical_potential", r.chemical_potential},
          {"chemical_potential_error", r.chemical_potential_error}};
}

Row row_of(const ScanHoleRow& r) {
  return {{"density", r.density},       {"temperature", r.temperature}, {"iso_energy", r.iso_energy},
          {"holes", r.holes},           {"mean_radius", r.mean_radius}, {"semi_minor", r.semi_minor},
          {"semi_major", r.semi_major}, {"anisotropy", r.anisotropy},   {"eccentricity", r.eccentricity},
          {"open_directions", r.open}};
}

Row row_of(const ScanErrorPair& r) { return {{"density", r.density}, {"error", r.error}, {"next_error", r.next_error}}; }

template <class Rows>
void write_table(OutputFolder& folder, const std::string& name, const Rows& rows) {
  if (rows.empty()) return;
  folder.write(name, [&](std::ostream& out) {
    const char* comma = "";
    for (const auto& [column, value] : row_of(rows.front())) out << std::exchange(comma, ",") << column;
    out << '\n';
    for (const auto& row : rows) {
      comma = "";
      for (const auto& [column, value] : row_of(row))
        out << std::exchange(comma, ",") << (value.is_string() ? value.template get<std::string>() : value.dump());
      out << '\n';
    }
  });
}

template <class Rows>
Json table_json(const Rows& rows) {
  Json json = Json::array();
  for (const auto& row : rows) {
    Json object;
    for (const auto& [column, value] : row_of(row)) object[column] = value;
    json.push_back(std::move(object));
  }
  return json;
}

Json run_scan(InsertState& state, const Options& options, const LennardJonesModel& model, Isa isa, int& status) {
  if (!state.file.empty()) throw_bad_input("FILE is not allowed with --scan, which makes its fluids");
  const InsertionScanOptions with = scan_options(state, model);
  OutputFolder folder = open_folder(state.common);
  folder.write_run_file("insert", options.resolved());
  TerminalMonitor monitor(state.common.quiet);
  const InsertionScanResult run =
      run_insertion_scan(model, with, isa, {folder.checkpoints(), !state.common.resume.empty()}, monitor);
  double failures = 0.0;
  for (const ScanCostRow& row : run.costs) failures += row.failures;
  Json result;
  result["scan"] = table_json(run.costs);
  result["states"] = table_json(run.states);
  if (!run.holes.empty()) result["holes"] = table_json(run.holes);
  result["failures"] = failures;
  result["outcome"] = run.interrupted ? "interrupted" : failures > 0.0 ? "limit of trials" : "done";
  result["seconds"] = run.seconds;
  status = run.interrupted || failures > 0.0 ? goal_not_reached : done;
  if (folder.exists()) {
    write_table(folder, "scan.csv", run.costs);
    write_table(folder, "states.csv", run.states);
    write_table(folder, "holes.csv", run.holes);
    write_table(folder, "errors.csv", run.errors);
  }
  write_result(folder, "insert", options.resolved(), result);
  return result;
}

Json run_insert(InsertState& state, const Options& options, int& status) {
  state.common.check();
  const Isa isa = state.common.resolve_isa();
  const LennardJonesModel model = state.system.resolve_soft("insert");
  if (state.system.precision) throw_bad_input("--precision is not allowed with insert: probes are in double precision");
  if (state.plot && state.common.out.empty() && state.common.resume.empty())
    throw_bad_input("--plot needs --out: the plots are files");
  if (state.scan && state.densify) throw_bad_input("--scan and --densify are not allowed together");
  if (state.plot && !state.scan && !state.densify)
    throw_bad_input("--plot needs --scan or --densify: single insertions have no plot");
  Json result = state.scan      ? run_scan(state, options, model, isa, status)
                : state.densify ? run_growth(state, options, model, isa, status)
                                : run_exchange(state, options, model, isa, status);
  if (state.plot) draw_plots(state.common.out.empty() ? state.common.resume : state.common.out, state.common);
  return result;
}

}  // namespace

Subcommand add_insert(CLI::App& app) {
  CLI::App* sub = app.add_subcommand("insert", "Insert particles where their energy has a given value (USHER), and remove some");
  const auto options = std::make_shared<Options>(*sub);
  const auto state = std::make_shared<InsertState>();
  options->add_positional("FILE", state->file, "extended XYZ; of several frames the first is used");
  options->add("--count", state->count, "particles to insert; of a scan, places per configuration and combination");
  state->setup.add_to(*options);
  options->add("--remove", state->remove, "particles of the species to take out of the region afterwards");
  options->add("--removal", state->removal, "random, or least-disturbance: whose energy is nearest to --energy");
  options->add("--temperature", state->temperature, "gives inserted particles Maxwellian velocities; of --densify [2.5]");
  options->add("--densify", state->densify,
               "up to this density at constant energy per particle, by molecular dynamics and insertion");
  options->add("--rate", state->rate, "of --densify: density per time");
  options->add("--rows", state->rows, "of --densify: means over so many steps of density");
  options->add("--density", state->density, "of --densify without FILE: where it begins [0.4]");
  options->add_flag("--scan", state->scan, "what insertion costs at several densities and temperatures");
  options->add("--states", state->states, "of --scan: density:temperature,...");
  options->add("--methods", state->methods, "of --scan");
  options->add("--tolerances", state->tolerances, "of --scan [--tolerance]");
  options->add("--largest-steps", state->largest_steps, "of --scan, or default");
  options->add("--configurations", state->configurations, "of --scan, per state");
  options->add("--between-steps", state->between_steps, "of --scan, between configurations");
  options->add("--widom-probes", state->widom_probes, "of --scan, per configuration, for the chemical potential");
  options->add("--holes", state->holes, "of --scan, per configuration: regions of low energy to measure");
  options->add("--iso-energies", state->iso_energies, "of --holes: energies at their surface");
  options->add("--traced-searches", state->traced_searches, "of --scan, per configuration: how errors shrink, for errors.csv");
  options->add("--particles", state->particles, "of --scan and --densify without FILE");
  options->add("--equilibration-steps", state->equilibration_steps, "of --scan and --densify");
  options->add("--time-step", state->time_step, "of --scan and --densify");
  options->add_flag("--plot", state->plot, "draw the figures of --scan or --densify (needs --out)");
  state->system.add_to(*options);
  state->common.add_to(*options);
  return {sub, [=](int& status) { return run_insert(*state, *options, status); }};
}

}  // namespace lanescape::program
