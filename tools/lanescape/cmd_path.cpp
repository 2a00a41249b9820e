#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>

#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "end_point_options.hpp"
#include "engine.hpp"
#include "observables/statistics.hpp"
#include "pair_files.hpp"
#include "path_options.hpp"
#include "path_report.hpp"
#include "plot.hpp"
#include "run/path_run.hpp"

namespace lanescape::program {
namespace {

constexpr Scope made_pairs{"pairs", "runs that make their end points, without --pair"};

struct PathState {
  CommonOptions common;
  SystemOptions system;
  EndPointSetup setup;
  std::vector<std::string> pair_files;
  PathOptions path;
  std::string landscape;
  bool reverse = false, plot = false;

  PathRunOptions run_options(const AnyModel& model) const {
    PathRunOptions options = path.run_options(model, common.threads, system.resolve_precision());
    options.reverse = reverse;
    return options;
  }

  RunKinds kinds(const AnyModel& model, const PathRunOptions& path_options) const {
    return joined({{kind_if(pair_files.empty(), made_pairs, "without --pair", "with --pair")},
                   setup.kinds(!pair_files.empty()),
                   system.kinds(model, pair_files.empty() && setup.generates_start()),
                   path.kinds(path_options),
                   {common.folder_kind()}});
  }
};

// Mean of (DeltaR/g)^2 over the paths that reached their goal, and its standard error from two paths on.
void add_mean(Json& json, const std::vector<PathResult>& paths) {
  std::vector<double> ratios;
  for (const PathResult& path : paths)
    if (path.outcome == Outcome::reached) ratios.push_back(path.ratio_squared());
  const Estimate estimate = estimate_mean(ratios);
  json["mean_ratio_squared"] = ratios.empty() ? Json() : Json(estimate.value);
  json["standard_error"] = estimate.error ? Json(*estimate.error) : Json();
}

// The share of direct steps since the row before is one of steps, or of their length where they are adaptive.
void write_trace(std::ostream& out, const PathResult& path, const PathRunOptions& options) {
  fmt::print(out, "step,length,distance_to_goal,{},direct_fraction,participation_ratio\n",
             options.method->is_hard ? "moved_particles" : "energy");
  const auto all = options.stepping == Stepping::adaptive ? PathRecorder::length : PathRecorder::step;
  const DecimatedTrace& trace = path.trace;
  double all_before = 0.0, direct_before = 0.0;
  for (std::size_t r = 0; r < trace.rows(); ++r) {
    const double direct = trace.at(r, PathRecorder::direct);
    fmt::print(out, "{:.0f},{},{},{},{},{}\n", trace.at(r, PathRecorder::step), trace.at(r, PathRecorder::length),
               trace.at(r, PathRecorder::distance), trace.at(r, PathRecorder::energy),
               (direct - direct_before) / (trace.at(r, all) - all_before),
               trace.at(r, PathRecorder::participation) / static_cast<double>(path.frames.front().size()));
    all_before = trace.at(r, all);
    direct_before = direct;
  }
}

void write_files(OutputFolder& folder, const std::vector<PathResult>& paths, const PathRunOptions& options, const Mixture& model) {
  folder.write("paths.csv", [&](std::ostream& out) {
    fmt::print(out,
               "path,outcome,length,distance,ratio_squared,participation_ratio,direct_steps,{0}_steps,direct_length,{0}_length,"
               "evaluations,seconds,landscape_energy,largest_violation,reversed\n",
               options.method->word);
    for (std::size_t k = 0; k < paths.size(); ++k) {
      const PathResult& p = paths[k];
      fmt::print(out, "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", k + 1, to_string(p.outcome), p.length, p.distance,
                 p.ratio_squared(), p.participation_number / static_cast<double>(p.frames.front().size()), p.direct_steps,
                 p.detour_steps, p.direct_length, p.detour_length, p.evaluations, p.seconds, p.landscape_energy,
                 p.largest_violation, p.reversed ? 1 : 0);
    }
  });
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const PathResult& p = paths[k];
    folder.write(fmt::format("path-{:04}-trace.csv", k + 1), [&](std::ostream& out) { write_trace(out, p, options); });
    write_path_files(folder, k, p, model);
  }
}

// The input of the searches, read and checked before anything is written. Pairs of an interrupted run come from its folder.
struct PathInput {
  std::vector<ConfigurationPair> pairs;  // from files
  Configuration start;                   // without files: what the end points are made from
  EndPointProtocol protocol;
};

PathInput read_input(PathState& state, const AnyModel& model, Isa isa) {
  PathInput input;
  if (!state.pair_files.empty()) {
    if (!state.common.resume.empty()) return input;
    for (const std::string& file : state.pair_files) input.pairs.push_back(read_pair(file, model, state.setup.overlap_tolerance()));
  } else {
    input.start = state.setup.start(model, state.common, isa);
    input.protocol = state.setup.resolve(model, input.start.size(), state.common.seed);
  }
  return input;
}

void add_paths(Json& json, const std::vector<PathResult>& paths, const PathMethod& method, const Mixture& mixture) {
  json["paths"] = Json::array();
  for (const PathResult& path : paths) json["paths"].push_back(path_json(path, method, mixture));
  add_mean(json, paths);
}

// The pairs to find paths between: made here, kept from an interrupted run, or from files, of which the folder keeps copies.
struct Ends {
  std::vector<ConfigurationPair> pairs;
  Json json;  // of end points made here
  bool all = true, interrupted = false;
};

ExitStatus status_of(const Ends& ends, const std::vector<PathResult>& paths) {
  const auto ended = [](Outcome outcome) { return [=](const PathResult& path) { return path.outcome == outcome; }; };
  return status_of_run(ends.all && std::all_of(paths.begin(), paths.end(), ended(Outcome::reached)),
                       ends.interrupted || std::any_of(paths.begin(), paths.end(), ended(Outcome::interrupted)));
}

Ends take_ends(const PathState& state, const AnyModel& model, PathInput&& input, Precision precision, Isa isa,
               OutputFolder& folder) {
  if (state.pair_files.empty()) {
    EndPoints made = make_end_points(model, input.start, input.protocol, isa, folder, state.common, precision);
    return {std::move(made.run.pairs), std::move(made.json), made.reached, made.run.interrupted};
  }
  if (!state.common.resume.empty()) return {read_kept_pairs(folder, model, state.setup.overlap_tolerance()), Json(), true};
  return {std::move(input.pairs), Json(), true};
}

// The factor that scaled radii of a file; none without a file of spheres.
std::optional<double> radius_factor(const PathState& state, const std::vector<ConfigurationPair>& pairs) {
  if (state.setup.radius_factor() || state.pair_files.empty()) return state.setup.radius_factor();
  return std::min_element(pairs.begin(), pairs.end(),
                          [](const auto& a, const auto& b) { return a.radius_factor < b.radius_factor; })
      ->radius_factor;
}

// Resolves and checks everything the run needs, before there is a folder.
PathInput prepare(PathState& state, Options& options, const AnyModel& model, const PathRunOptions& path_options, Isa isa) {
  options.settle(state.kinds(model, path_options));
  state.path.settle(path_options, model);
  const bool makes_pairs = state.pair_files.empty();
  if (makes_pairs) state.setup.settle(model);
  PathInput input = read_input(state, model, isa);
  if (makes_pairs) state.system.check_precision_in(model, input.start.box);
  for (const ConfigurationPair& pair : input.pairs) state.system.check_precision_in(model, pair.start.box, path_skin);
  return input;
}

// What computes energies in place of the model, which then tells species and masses.
std::unique_ptr<Engine> open_engine(const PathState& state) {
  const SystemOptions& system = state.system;
  if (state.pair_files.empty()) throw_bad_input("--landscape needs files with end points, --pair");
  if (system.cutoff || system.truncation || system.images || system.precision)
    throw_bad_input(
        "--cutoff, --truncation, --images and --precision are not allowed with --landscape: the engine has the energies");
  if (is_hard(system.resolve())) throw_bad_input("--landscape is not allowed with hard spheres, which have no energies");
  return Engine::open(state.landscape);
}

LandscapeOfPair landscape_of(Engine* engine, const AnyModel& model, Isa isa) {
  if (engine == nullptr) return {};
  return [=, &model](const ConfigurationPair& pair, const ParticleLayout& layout) {
    engine->check(pair, model, "--pair");
    return std::make_unique<EngineLandscape>(*engine, layout, isa);
  };
}

Json run_path(PathState& state, Options& options, int& status) {
  std::unique_ptr<Engine> engine;
  if (!state.landscape.empty()) {
    engine = open_engine(state);
    if (!engine) return {};  // another process has searched
    say(state.common, fmt::format("energies and lengths are in the engine's units: {}", engine->units()));
  }
  state.common.check();
  const Isa isa = state.common.resolve_isa();
  const AnyModel model = state.system.resolve();
  const PathRunOptions path_options = state.run_options(model);
  PathInput input = prepare(state, options, model, path_options, isa);

  if (state.plot) check_plots();
  OutputFolder folder = open_folder(state.common);
  // Before the run file, from which on the folder can be resumed.
  for (std::size_t k = 0; k < input.pairs.size(); ++k) {
    warn_if_wrapped(state.common, state.pair_files[k], input.pairs[k]);
    write_pair(folder, k, input.pairs[k], mixture_of(model), read_asked_distance(state.pair_files[k]));
  }
  folder.write_run_file("path", options.resolved());
  Ends ends = take_ends(state, model, std::move(input), path_options.precision, isa, folder);
  Json result;
  if (!ends.json.is_null()) result["endpoints"] = std::move(ends.json);
  std::vector<PathResult> paths;
  if (ends.all) {
    TerminalMonitor monitor(state.common.quiet);
    paths = run_paths(model, ends.pairs, path_options, isa, {folder.checkpoints(), !state.common.resume.empty()}, monitor,
                      landscape_of(engine.get(), model, isa));
  }
  add_paths(result, paths, *path_options.method, mixture_of(model));
  add_system(result, state.system, model, radius_factor(state, ends.pairs), isa);
  if (engine) result["landscape"] = {{"engine", state.landscape}, {"units", engine->units()}};
  status = status_of(ends, paths);
  if (folder.exists()) write_files(folder, paths, path_options, mixture_of(model));
  write_result(folder, "path", options.resolved(), result, status);
  if (state.plot) draw_plots(folder.path(), status);
  return result;
}

}  // namespace

Subcommand add_path(CLI::App& app) {
  const auto options = std::make_shared<Options>(app, "path", "Find geodesics between pairs of end points");
  const auto state = std::make_shared<PathState>();
  options->add(
      "--pair", state->pair_files,
      "files with two frames, the end points, unwrapped (with a warning if they look wrapped); without any, pairs are made as by "
      "endpoints");
  state->path.add_to(*options, "--method");
  options->add_flag("--reverse", state->reverse, "search from the far end too and keep the shorter path");
  options->add("--landscape", state->landscape,
               "an engine whose energies take the place of the model's, and its input: lammps:in.lmp (docs/HOSTS.md)");
  options->add("--frames", state->path.frames, "configurations of each path to write between its ends")
      .only_for({runs_with_a_folder});
  options->add_flag("--plot", state->plot, "draw the path and the equilibration (needs --out)").only_for({runs_with_a_folder});
  options->begin_group({made_pairs});
  state->setup.add_to(*options);
  options->end_group();
  state->setup.add_tolerance_to(*options);
  state->system.add_to(*options);
  state->common.add_to(*options);
  return {&options->app(), [=](int& status) { return run_path(*state, *options, status); }};
}

}  // namespace lanescape::program
