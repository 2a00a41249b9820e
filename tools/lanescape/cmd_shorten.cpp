#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "end_point_options.hpp"
#include "io/extended_xyz.hpp"
#include "pair_files.hpp"
#include "path_check_report.hpp"
#include "path_options.hpp"
#include "path_report.hpp"
#include "plot.hpp"
#include "run/given_path.hpp"
#include "run/path_nodes.hpp"
#include "run/shorten_run.hpp"

namespace lanescape::program {
namespace {

// The path that the run starts from, kept so that it can be resumed.
constexpr const char* kept_path = "given-path.extxyz";

constexpr Scope shortening_runs{"check", "runs that shorten, without --check"};
constexpr Scope own_models{"whole path", "runs without a path of HDF5, which holds its model"};

struct ShortenState {
  CommonOptions common;
  SystemOptions system;
  std::string pair_file, path_file, checked_file;
  std::string method = default_shorten_method().word;
  PathOptions path;
  std::uint64_t starts = 1;
  double overlap_tolerance = default_overlap_tolerance;
  bool plot = false;

  ShortenOptions run_options(const AnyModel& model) const {
    return {&shorten_method(method), path.run_options(model, common.threads, system.resolve_precision()), starts, common.seed};
  }
  RunKinds kinds(const AnyModel& model, const PathRunOptions& search) const {
    return joined({system.kinds(model, false),
                   path.kinds(search),
                   {common.folder_kind(), kind_if(checked_file.empty(), shortening_runs, "without --check", "with --check"),
                    kind_if(checked_file.empty() || !is_path_file(checked_file), own_models, "with frames or without --check",
                            fmt::format("with {}", checked_file))}});
  }
};

struct ShortenInput {
  ConfigurationPair pair;
  std::vector<Configuration> nodes;  // of a given path
};

std::vector<Configuration> read_path(const std::filesystem::path& file, const AnyModel& model, const ConfigurationPair& pair,
                                     const PathRunOptions& options, Isa isa) {
  PathFile path = read_whole_path(file, model);
  const auto named = [](const Species& a, const Species& b) { return a.name == b.name; };
  if (!std::ranges::equal(mixture_of(path.model).species, mixture_of(model).species, named))
    throw_bad_input(fmt::format("{}: its species are those of {}, not of model {}", file.string(), mixture_of(path.model).name,
                                mixture_of(model).name));
  return fit_path(std::move(path.nodes), model, pair, file.string(), options, isa);
}

// From the files named by the options; of an interrupted run, from its folder.
ShortenInput read_input(const ShortenState& state, const AnyModel& model, const PathRunOptions& options, Isa isa) {
  const std::filesystem::path resumed = state.common.resume;
  ShortenInput input;
  input.pair = resumed.empty() ? read_pair(state.pair_file, model, state.overlap_tolerance)
                               : read_kept_pair(resumed / pair_file_name(0), model, state.overlap_tolerance);
  if (!state.path_file.empty())
    input.nodes =
        read_path(resumed.empty() ? std::filesystem::path(state.path_file) : resumed / kept_path, model, input.pair, options, isa);
  return input;
}

void keep_input(OutputFolder& folder, const ShortenInput& input, const std::string& pair_file, const Mixture& mixture) {
  write_pair(folder, 0, input.pair, mixture, read_asked_distance(pair_file));
  if (input.nodes.empty()) return;
  folder.write(kept_path, [&](std::ostream& out) {
    for (const Configuration& node : input.nodes) write_frame(out, node, mixture, {});
  });
}

Json to_json(const ShortenResult& result, const PathMethod& method, const Mixture& mixture) {
  const ShortenedPath& shortest = result.shortest;
  Json json;
  json["outcome"] = to_string(result.outcome);
  if (!result.reason.empty()) json["reason"] = result.reason;
  json["length_before"] = result.length_before;
  const bool found = !shortest.path.frames.empty();
  if (found) {
    Json path = path_json(shortest.path, method, mixture);
    for (const char* other : {"outcome", "seconds", "reversed"}) path.erase(other);
    json.update(path);
  } else {
    for (const char* key : {"length", "ratio_squared", "largest_violation"}) json[key] = nullptr;
  }
  json["kuhn_tucker_residual"] = shortest.check ? Json(shortest.check->kuhn_tucker_residual) : Json();
  json["nodes"] = shortest.path.frames.size();
  if (shortest.curve) {
    json["length_change"] = shortest.curve->length_change;
    json["levels"] = shortest.curve->levels;
    json["iterations"] = shortest.curve->iterations;
    for (const char* of_searches : {"steps", "lengths", "corrections"}) json.erase(of_searches);
  } else {
    json["trials"] = shortest.trials.size();
    json["accepted"] =
        std::count_if(shortest.trials.begin(), shortest.trials.end(), [](const ShortenTrial& t) { return t.accepted; });
  }
  json["start_lengths"] = result.start_lengths;
  json["seconds"] = result.seconds;
  return json;
}

void write_trials(std::ostream& out, const std::vector<ShortenTrial>& trials) {
  out << "trial,distance_to_goal,length,accepted\n";
  for (std::size_t k = 0; k < trials.size(); ++k)
    fmt::print(out, "{},{},{},{}\n", k + 1, trials[k].distance_left, trials[k].length.value_or(std::nan("")),
               trials[k].accepted ? 1 : 0);
}

// Of the nodes, about that many between the ends, equally spaced in their number.
std::vector<Configuration> some_of(const std::vector<Configuration>& nodes, std::size_t frames) {
  const std::size_t last = nodes.size() - 1, parts = std::min(frames + 1, last);
  std::vector<Configuration> chosen;
  for (std::size_t k = 0; k <= parts; ++k) chosen.push_back(nodes[k * last / parts]);
  return chosen;
}

// Of a few points of a path, which may be fewer than the 3 that a certificate needs: that is no reason to lose a result. Between
// two of them the path may touch the boundary: they count as on it from farther away.
std::optional<PathCheck> coarse_check(const std::vector<Configuration>& points, const AnyModel& model,
                                      std::optional<double> landscape_energy, Isa isa, int threads) {
  try {
    return check_path(model, points, landscape_energy, isa,
                      {.boundary_tolerance = 0.1, .contact_tolerance = 1e-2, .threads = threads})
        .check;
  } catch (const Error&) {
    return std::nullopt;
  }
}

void write_files(OutputFolder& folder, const ShortenResult& result, const ShortenState& state, const AnyModel& model, Isa isa) {
  if (result.shortest.path.frames.empty()) return;
  PathResult path = result.shortest.path;
  const std::optional<double> landscape_energy = is_hard(model) ? std::nullopt : std::optional(path.landscape_energy);
  const auto write_nodes = [&](const char* name, const std::vector<Configuration>& nodes, const std::optional<PathCheck>& check) {
    if (check) folder.write(name, [&](std::ostream& out) { write_node_table(out, model, nodes, *check, isa); });
  };
  const auto points = [&](const std::vector<Configuration>& of) {
    return coarse_check(of, model, landscape_energy, isa, state.common.threads);
  };
  if (result.shortest.check)
    write_whole_path(folder, 0, model, path.frames, landscape_energy, *result.shortest.check, state.method, isa);
  write_nodes("initial-0001-nodes.csv", result.initial, points(result.initial));
  write_nodes("path-0001-nodes.csv", path.frames, result.shortest.check ? result.shortest.check : points(path.frames));
  path.frames = some_of(path.frames, state.path.frames);
  write_path_files(folder, 0, path, mixture_of(model));
  if (!result.shortest.trials.empty())
    folder.write("path-0001-trials.csv", [&](std::ostream& out) { write_trials(out, result.shortest.trials); });
}

Json run_path_check(ShortenState& state, Options& options, Isa isa) {
  const PathFile path = read_whole_path(state.checked_file, state.system.resolve());
  PathRunOptions unused;  // paths are found by none of them
  unused.method = &default_path_method(is_hard(path.model));
  options.settle(state.kinds(path.model, unused));
  const Json result = check_file(state.checked_file, path, state.pair_file, state.overlap_tolerance, isa, state.common.threads);
  OutputFolder folder = open_folder(state.common);
  write_result(folder, "shorten", options.resolved(), result);
  return result;
}

Json run_shortening(ShortenState& state, Options& options, int& status) {
  state.common.check();
  const Isa isa = state.common.resolve_isa();
  if (!state.checked_file.empty()) return run_path_check(state, options, isa);
  if (state.pair_file.empty()) throw_bad_input("--pair: a file with the two end points is needed, or --check with a path");
  const AnyModel model = state.system.resolve();
  const ShortenOptions shorten_options = state.run_options(model);
  const PathMethod& path_method = *shorten_options.search.method;
  options.settle(state.kinds(model, shorten_options.search));
  shorten_options.check(model);
  state.path.settle(shorten_options.search, model);
  const ShortenInput input = read_input(state, model, shorten_options.search, isa);
  state.system.check_precision_in(model, input.pair.start.box, path_skin);

  if (state.plot) check_plots();
  OutputFolder folder = open_folder(state.common);
  if (state.common.resume.empty()) {
    warn_if_wrapped(state.common, state.pair_file, input.pair);
    keep_input(folder, input, state.pair_file, mixture_of(model));  // before the run file, from which on the folder can be resumed
  }
  folder.write_run_file("shorten", options.resolved());
  TerminalMonitor monitor(state.common.quiet);
  const ShortenResult shortened = run_shorten(model, input.pair, input.nodes, shorten_options, isa,
                                              {folder.checkpoints(), !state.common.resume.empty()}, monitor);
  Json result = to_json(shortened, path_method, mixture_of(model));
  add_system(result, state.system, model, input.pair.radius_factor, isa);
  status = status_of_run(shortened.outcome == Outcome::reached, shortened.outcome == Outcome::interrupted);
  if (folder.exists()) write_files(folder, shortened, state, model, isa);
  write_result(folder, "shorten", options.resolved(), result, status);
  if (state.plot) draw_plots(folder.path(), status);
  return result;
}

}  // namespace

Subcommand add_shorten(CLI::App& app) {
  const auto options = std::make_shared<Options>(app, "shorten", "Shorten the path between two end points");
  const auto state = std::make_shared<ShortenState>();
  options->add("--pair", state->pair_file, "file with two frames, the end points, unwrapped (with a warning if they look wrapped)");
  options->add("--check", state->checked_file,
               "instead, check this path from its nodes alone: HDF5, or all nodes as frames; with --pair also its ends");
  options->begin_group({shortening_runs});
  options->add("--path", state->path_file,
               "file with the frames of a path between them, as path writes it; without it the path method finds one");
  options->add("--method", state->method, fmt::format("how to shorten: {}", shorten_method_words()));
  options->add("--starts", state->starts,
               "independent runs, from other paths or with other random numbers; the shortest path is kept");
  state->path.add_to(*options, "--path-method");
  options->add("--frames", state->path.frames, "configurations of the path to write between its ends")
      .only_for({runs_with_a_folder});
  options->add_flag("--plot", state->plot, "draw both paths and the lengths that were found (needs --out)")
      .only_for({runs_with_a_folder});
  options->end_group();
  options
      ->add("--overlap-tolerance", state->overlap_tolerance,
            "of hard spheres in files, in units of s_ij: up to it radii are scaled")
      .only_for({hard_spheres});
  state->system.add_to(*options);
  for (const char* of_the_model : {"--model", "--model-file", "--cutoff", "--images", "--truncation", "--composition"})
    options->at(of_the_model).only_for({own_models});
  options->at("--precision").only_for({shortening_runs});
  state->common.add_to(*options);
  return {&options->app(), [=](int& status) { return run_shortening(*state, *options, status); }};
}

}  // namespace lanescape::program
