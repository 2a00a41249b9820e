#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "analysis_sweeps.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "plot.hpp"
#include "program.hpp"

namespace lanescape::program {
namespace {

struct AnalyzeState {
  CommonOptions common;
  std::vector<std::string> folders;
  std::uint64_t bootstrap = 2000;
  FitSettings fits;
  std::string fit_range;
  bool plot = false;
};

// What follows from the groups and is printed and written.
struct Analysis {
  std::vector<RunGroup> groups;
  Fits fits;
  ScalingTables scaling;
};

void check_folders(const std::vector<std::string>& folders) {
  std::set<std::filesystem::path> known;
  for (const std::string& folder : folders) {
    std::error_code ignored;
    const auto place = std::filesystem::weakly_canonical(folder, ignored);
    if (!known.insert(place).second) throw_bad_input(fmt::format("{}: the run is named twice", folder));
  }
}

std::vector<AnalysedRun> read_runs(const AnalyzeState& state) {
  check_folders(state.folders);
  std::vector<AnalysedRun> runs(state.folders.size());
  for_each_block(state.common.threads, runs.size(), [&](std::size_t k) { runs[k] = read_analysed_run(state.folders[k]); });
  return runs;
}

void check(AnalyzeState& state) {
  state.common.check();
  state.common.resolve_isa();  // refuses unknown ones
  if (state.bootstrap < 100 || state.bootstrap > 1000000)
    throw_bad_input(fmt::format("--bootstrap: {} is not allowed: from 100 to 1000000", state.bootstrap));
  for (const auto& critical : {state.fits.mode_coupling, state.fits.vogel_fulcher_tammann, state.fits.berthier_witten})
    if (critical && !(*critical > 0.0 && std::isfinite(*critical)))
      throw_bad_input(fmt::format("critical value {}: finite and above 0 is needed", *critical));
  if (state.fit_range.empty()) return;
  const std::vector<std::string> ends = list_of(state.fit_range, "--fit-range");
  const auto end = [&](std::size_t k) { return number_of(ends[k], "--fit-range"); };
  if (ends.size() != 2 || !(end(0) < end(1)))
    throw_bad_input(
        fmt::format("--fit-range: {} is not allowed: two numbers in ascending order are needed, 0.53,0.57", state.fit_range));
  state.fits.range = {end(0), end(1)};
}

void write_files(OutputFolder& folder, const Analysis& analysis) {
  if (!folder.exists()) return;
  write_table(folder, "groups.csv", groups_table(analysis.groups), "");
  write_table(folder, "means.csv", means_table(analysis.groups), "");
  write_table(folder, "distributions.csv", distributions_table(analysis.groups), "");
  write_table(folder, "fits.csv", analysis.fits.rows, "");
  write_table(folder, "scaling.csv", analysis.scaling.rows, "");
  write_table(folder, "scaling_points.csv", analysis.scaling.points, "");
}

Analysis analyse(const AnalyzeState& state) {
  Analysis analysis;
  analysis.groups = group_runs(read_runs(state));
  const BootstrapOptions bootstrap{
      .resamples = static_cast<std::size_t>(state.bootstrap), .seed = state.common.seed, .threads = state.common.threads};
  for (RunGroup& group : analysis.groups) average(group, bootstrap);
  const std::vector<Sweep> sweeps = sweeps_of(analysis.groups);
  analysis.fits = fit_sweeps(sweeps, state.fits);
  analysis.scaling = scale_sweeps(sweeps);
  return analysis;
}

Json run_analyze(AnalyzeState& state, Options& options, int& status) {
  check(state);
  options.settle({state.common.folder_kind()});
  const Analysis analysis = analyse(state);
  if (state.plot) check_plots();
  OutputFolder folder = open_folder(state.common);
  Json result;
  result["groups"] = groups_json(analysis.groups);
  result["fits"] = to_json(analysis.fits.rows);
  result["refused_fits"] = to_json(analysis.fits.refusals);
  result["scaling"] = to_json(analysis.scaling.rows);
  result["scaling_points"] = to_json(analysis.scaling.points);
  result["bootstrap"] = state.bootstrap;
  status = done;
  write_files(folder, analysis);
  write_result(folder, "analyze", options.resolved(), result, status);
  if (state.plot) draw_plots(folder.path(), status);
  return result;
}

}  // namespace

Subcommand add_analyze(CLI::App& app) {
  const auto options = std::make_shared<Options>(
      app, "analyze", "Pool finished runs over a sweep: means with errors, distributions, fits, and D against (DeltaR/g)^2");
  const auto state = std::make_shared<AnalyzeState>();
  options->add_positional("RUN", state->folders, "folders of finished runs of endpoints, path, shorten and diffusion").required();
  options->add("--bootstrap", state->bootstrap, "resamples of the 95 % intervals of means");
  options->add("--critical-mct", state->fits.mode_coupling,
               "phi or T at which mode-coupling fits vanish [binary hard spheres 0.59]");
  options->add("--critical-vft", state->fits.vogel_fulcher_tammann,
               "likewise of Vogel-Fulcher-Tammann fits [binary hard spheres 0.6122]");
  options->add("--critical-bw", state->fits.berthier_witten, "likewise of Berthier-Witten fits [binary hard spheres 0.635]");
  options->add_flag("--free-critical", state->fits.free_critical, "also fit the critical values");
  options->add("--fit-range", state->fit_range, "lowest and highest phi or T of fits, 0.53,0.57 [all]");
  options->add_flag("--weighted", state->fits.weighted, "weight points of fits by their errors; else ln y counts alike at all");
  options->add_flag("--plot", state->plot, "draw the figures (needs --out)").only_for({runs_with_a_folder});
  state->common.add_to(*options);
  return {&options->app(), [=](int& status) { return run_analyze(*state, *options, status); }};
}

}  // namespace lanescape::program
