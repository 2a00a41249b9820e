#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>

#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "end_point_options.hpp"
#include "interaction/sphere/rounding_overlaps.hpp"
#include "io/extended_xyz.hpp"
#include "observables/statistics.hpp"
#include "plot.hpp"
#include "run/path_run.hpp"

namespace lanescape::program {
namespace {

constexpr Scope made_pairs{"pairs", "runs that make their end points, without --pair"};
// Options that depend on the method.
constexpr Scope direct_steps_of_a_length{"direct steps",
                                         "faithful contour, escape and avoidance: other steps have no given length"};
constexpr Scope collision_avoidance{"method", "faithful method avoidance"};

struct PathState {
  CommonOptions common;
  SystemOptions system;
  EndPointSetup setup;
  std::vector<std::string> pair_files;
  std::optional<std::string> method, fictitious;
  bool adaptive = false, reverse = false, plot = false;
  std::optional<double> step, avoidance_step, landscape_energy;
  std::uint64_t max_steps = FinderOptions{}.max_steps, frames = FinderOptions{}.frames;

  PathRunOptions run_options(const AnyModel& model) const {
    PathRunOptions options;
    options.method = method ? &path_method(*method) : &default_path_method(is_hard(model));
    check_method(*options.method, model);
    options.stepping = adaptive ? Stepping::adaptive : Stepping::faithful;
    options.direct_step = step;
    options.avoidance_step = avoidance_step;
    if (fictitious) options.fictitious = parse_contact_potential(*fictitious);
    options.landscape_energy = landscape_energy;
    options.reverse = reverse;
    options.finder.max_steps = max_steps;
    options.finder.frames = frames;
    options.threads = common.threads;
    options.precision = system.resolve_precision();
    return options;
  }

  RunKinds kinds(const AnyModel& model, const PathRunOptions& path) const {
    const std::string with = fmt::format("with method {}{}", path.method->word, adaptive ? " and --adaptive" : "");
    const bool avoids = path.stepping == Stepping::faithful && path.method->word == std::string_view("avoidance");
    return joined({{kind_if(pair_files.empty(), made_pairs, "without --pair", "with --pair")},
                   setup.kinds(!pair_files.empty()),
                   system.kinds(model, pair_files.empty() && setup.generates_start()),
                   {common.folder_kind(), kind_if(avoids, collision_avoidance, with, with),
                    kind_if(path.has_step_length(), direct_steps_of_a_length, with, with)}});
  }
};

// Scales the radii of both frames by one factor if the file's rounding makes spheres overlap.
void scale_radii(ConfigurationPair& pair, double tolerance, const std::string& where) {
  try {
    const double factor = std::min(rounding_overlap_factor(pair.start, tolerance), rounding_overlap_factor(pair.finish, tolerance));
    for (Configuration* end : {&pair.start, &pair.finish})
      for (double& radius : end->radii) radius *= factor;
    pair.radius_factor *= factor;
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", where, error.what()));
  }
}

ConfigurationPair read_pair(const std::filesystem::path& file, const AnyModel& model, double tolerance) {
  const bool hard = is_hard(model);
  ExtendedXyzReader reader(file, mixture_of(model), traits_of(model).sizes);
  ConfigurationPair pair;
  pair.start = reader.next()->configuration;
  std::optional<Frame> second = reader.next();
  if (!second || reader.another_begins())
    throw_bad_input(fmt::format("{}: holds {}: a pair of end points is two frames", file.string(),
                                second ? "more than two frames" : "one frame"));
  pair.finish = std::move(second->configuration);
  if (hard) scale_radii(pair, tolerance, file.string());
  check_end_points(pair, model, file.string());
  for (std::size_t k = 0; k < pair.start.positions.size(); ++k)
    pair.distance = std::hypot(pair.distance, pair.finish.positions[k] - pair.start.positions[k]);
  return pair;
}

// The factor of scale_radii() when the pair was kept.
double kept_radius_factor(const std::filesystem::path& file, const AnyModel& model) {
  const auto info = ExtendedXyzReader(file, mixture_of(model)).next()->info;
  const auto found = info.find(radius_factor_key);
  return found == info.end() ? 1.0 : std::stod(found->second);
}

// The pairs a resumed run was started with: its folder holds a copy of each, with radii scaled already.
std::vector<ConfigurationPair> read_kept_pairs(const OutputFolder& folder, const AnyModel& model, double tolerance) {
  std::vector<ConfigurationPair> pairs;
  for (std::filesystem::path file; std::filesystem::exists(file = folder.path() / pair_file_name(pairs.size()));) {
    pairs.push_back(read_pair(file, model, tolerance));
    pairs.back().radius_factor *= kept_radius_factor(file, model);
  }
  return pairs;
}

Json to_json(const PathResult& path, const PathMethod& method, const Mixture& mixture) {
  const auto particles = static_cast<double>(path.frames.front().size());
  const bool complete = path.outcome == Outcome::reached;
  Json json;
  json["outcome"] = to_string(path.outcome);
  if (!path.reason.empty()) json["reason"] = path.reason;
  json["length"] = path.length;
  json["distance"] = path.distance;
  json["ratio_squared"] = complete ? Json(path.ratio_squared()) : Json();
  json["participation_ratio"] = path.participation_number / particles;
  json["steps"] = {{"direct", path.direct_steps}, {method.word, path.detour_steps}};
  json["lengths"] = {{"direct", path.direct_length}, {method.word, path.detour_length}};
  json["corrections"] = path.corrections;
  json["evaluations"] = path.evaluations;
  json["seconds"] = path.seconds;
  json["landscape_energy"] = method.is_hard ? Json() : Json(path.landscape_energy);
  json["largest_violation"] = path.largest_violation;
  for (const StepHistogram& h : path.histograms) json["mean_over_steps"][h.quantity] = h.mean();
  for (std::size_t s = 0; complete && s < path.heterogeneity.size(); ++s)
    json["heterogeneity"][mixture.species[s].name] = path.heterogeneity[s];
  json["reversed"] = path.reversed;
  return json;
}

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

void write_histograms(std::ostream& out, const PathResult& path) {
  out << "quantity,value,steps\n";
  for (const StepHistogram& h : path.histograms)
    for (std::size_t k = 0; k < h.counts.size(); ++k)
      if (h.counts[k] > 0.0)
        fmt::print(out, "{},{:.10g},{}\n", h.quantity, h.first + static_cast<double>(k) * h.width, h.counts[k]);
}

void write_particles(std::ostream& out, const PathResult& path, const Mixture& model) {
  out << "particle,species,path_length,displacement\n";
  for (std::size_t j = 0; j < path.particle_lengths.size(); ++j)
    fmt::print(out, "{},{},{},{}\n", j, model.species[static_cast<std::size_t>(path.frames.front().species[j])].name,
               path.particle_lengths[j], path.particle_displacements[j]);
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
    folder.write(fmt::format("path-{:04}.extxyz", k + 1), [&](std::ostream& out) {
      for (const Configuration& frame : p.frames) write_frame(out, frame, model, {});
    });
    folder.write(fmt::format("path-{:04}-trace.csv", k + 1), [&](std::ostream& out) { write_trace(out, p, options); });
    folder.write(fmt::format("path-{:04}-steps.csv", k + 1), [&](std::ostream& out) { write_histograms(out, p); });
    folder.write(fmt::format("path-{:04}-particles.csv", k + 1), [&](std::ostream& out) { write_particles(out, p, model); });
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

void warn_of_wrapped_pairs(const PathState& state, const std::vector<ConfigurationPair>& pairs) {
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (looks_wrapped(pairs[k]))
      say(state.common, fmt::format("{}: warning: both end points lie in one box, and a particle moves by more than half an edge: "
                                    "they look wrapped, and the distance {} is then wrong; unwrapped positions are needed",
                                    state.pair_files[k], pairs[k].distance));
}

// The paths found, in JSON; whether all reached their goal.
bool add_paths(Json& json, const std::vector<PathResult>& paths, const PathMethod& method, const Mixture& mixture) {
  json["paths"] = Json::array();
  for (const PathResult& path : paths) json["paths"].push_back(to_json(path, method, mixture));
  add_mean(json, paths);
  return std::all_of(paths.begin(), paths.end(), [](const PathResult& path) { return path.outcome == Outcome::reached; });
}

// The pairs to find paths between: made here, kept from an interrupted run, or from files, of which the folder keeps copies.
struct Ends {
  std::vector<ConfigurationPair> pairs;
  Json json;  // of end points made here
  bool all = true;
};

Ends take_ends(const PathState& state, const AnyModel& model, PathInput&& input, Precision precision, Isa isa,
               OutputFolder& folder) {
  if (state.pair_files.empty()) {
    EndPoints made = make_end_points(model, input.start, input.protocol, isa, folder, state.common, precision);
    return {std::move(made.run.pairs), std::move(made.json), made.reached};
  }
  if (!state.common.resume.empty()) return {read_kept_pairs(folder, model, state.setup.overlap_tolerance()), Json(), true};
  for (std::size_t k = 0; k < input.pairs.size(); ++k) write_pair(folder, k, input.pairs[k], mixture_of(model));
  return {std::move(input.pairs), Json(), true};
}

// Adds the model, its images or radii, instruction set and precision.
void add_system(Json& json, const PathState& state, const AnyModel& model, const std::vector<ConfigurationPair>& pairs, Isa isa) {
  json["model"] = mixture_of(model).name;
  if (!is_hard(model))
    json["images"] = to_string(traits_of(model).images);
  else if (state.setup.radius_factor())
    json["radius_factor"] = *state.setup.radius_factor();
  else if (!state.pair_files.empty())
    json["radius_factor"] = std::min_element(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) {
                              return a.radius_factor < b.radius_factor;
                            })->radius_factor;
  json["isa"] = to_string(isa);
  if (traits_of(model).has_precision) json["precision"] = to_string(state.system.resolve_precision());
}

// Resolves and checks everything the run needs, before there is a folder.
PathInput prepare(PathState& state, Options& options, const AnyModel& model, const PathRunOptions& path_options, Isa isa) {
  options.settle(state.kinds(model, path_options));
  path_options.check(model);
  state.method = path_options.method->word;
  if (path_options.has_step_length()) state.step = path_options.step_length(model);
  const bool makes_pairs = state.pair_files.empty();
  if (makes_pairs) state.setup.settle(model);
  PathInput input = read_input(state, model, isa);
  if (makes_pairs) state.system.check_precision_in(model, input.start.box);
  for (const ConfigurationPair& pair : input.pairs) state.system.check_precision_in(model, pair.start.box, path_skin);
  return input;
}

Json run_path(PathState& state, Options& options, int& status) {
  state.common.check();
  const Isa isa = state.common.resolve_isa();
  const AnyModel model = state.system.resolve();
  const PathRunOptions path_options = state.run_options(model);
  PathInput input = prepare(state, options, model, path_options, isa);

  if (state.plot) check_plots();
  OutputFolder folder = open_folder(state.common);
  folder.write_run_file("path", options.resolved());
  warn_of_wrapped_pairs(state, input.pairs);
  Ends ends = take_ends(state, model, std::move(input), path_options.precision, isa, folder);
  Json result;
  if (!ends.json.is_null()) result["endpoints"] = std::move(ends.json);
  std::vector<PathResult> paths;
  if (ends.all) {
    TerminalMonitor monitor(state.common.quiet);
    paths = run_paths(model, ends.pairs, path_options, isa, {folder.checkpoints(), !state.common.resume.empty()}, monitor);
  }
  const bool all_reached = add_paths(result, paths, *path_options.method, mixture_of(model)) && ends.all;
  add_system(result, state, model, ends.pairs, isa);
  status = all_reached ? done : goal_not_reached;
  if (folder.exists()) write_files(folder, paths, path_options, mixture_of(model));
  write_result(folder, "path", options.resolved(), result);
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
  options->add("--method", state->method,
               fmt::format("{}; {} for hard spheres [{}, {}]", path_method_words(false, " or "), path_method_words(true, " or "),
                           default_path_method(false).word, default_path_method(true).word));
  options->add_synonym_of_default("--faithful", "steps exactly as published (the default)");
  options
      ->add_flag("--adaptive", state->adaptive,
                 fmt::format("steps as long as an estimate of their error allows, the same path in less time: {}",
                             adaptive_method_words()))
      .excludes("--faithful");
  options
      ->add("--step", state->step, "length of a direct step in 3N space [sigma] [0.001; hard spheres 0.01; see FORMATS.md, Units]")
      .only_for({direct_steps_of_a_length});
  options
      ->add("--avoidance-step", state->avoidance_step, "of each particle that moves in a collision-avoidance step [sigma] [0.0001]")
      .only_for({collision_avoidance});
  options->add("--fictitious", state->fictitious, "potential between overlapping spheres: harmonic, linear or cubic [harmonic]")
      .only_for({collision_avoidance});
  options->add("--landscape-energy", state->landscape_energy, "E_L [the higher energy of the two end points]")
      .only_for({soft_models});
  options->add_flag("--reverse", state->reverse, "search from the far end too and keep the shorter path");
  options->add("--max-steps", state->max_steps, "steps of one path before giving up");
  options->add("--frames", state->frames, "configurations of each path to write between its ends").only_for({runs_with_a_folder});
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
